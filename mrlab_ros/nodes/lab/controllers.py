"""The controller manager that clients of ros2_control look for: each robot is a controller."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    LoadController,
    ReloadControllerLibraries,
    SwitchController,
    UnloadController,
)
from rclpy.node import Node

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.robots.controllers import BASE_CLASS, TYPE, Controller, check_switch
from mrlab_ros.messages.controllers import controller_to_message
from mrlab_ros.ros.services import create_service


class ControllerManager:
    """Offers /controller_manager/list_controllers and what rqt and MoveIt expect beside it.

    A robot is the controller of its name: its topics and its action are in its namespace, where
    ros2_control has those of a controller.
    """

    def __init__(self, node: Node, controllers: Callable[[], list[Controller]]) -> None:
        self._controllers = controllers
        for kind, name, callback in (
            (ListControllers, "list_controllers", self._list),
            (ListControllerTypes, "list_controller_types", self._list_types),
            (SwitchController, "switch_controller", self._switch),
            (LoadController, "load_controller", _refuse),
            (UnloadController, "unload_controller", _refuse),
            (ReloadControllerLibraries, "reload_controller_libraries", _refuse),
        ):
            create_service(node, kind, f"/controller_manager/{name}", callback)

    def _list(self, request: Any, response: ListControllers.Response) -> Any:
        response.controller = [controller_to_message(each) for each in self._controllers()]
        return response

    def _list_types(self, request: Any, response: ListControllerTypes.Response) -> Any:
        response.types, response.base_classes = [TYPE], [BASE_CLASS]
        return response

    def _switch(
        self, request: SwitchController.Request, response: SwitchController.Response
    ) -> Any:
        try:
            check_switch(
                self._controllers(), request.activate_controllers, request.deactivate_controllers
            )
            response.ok = True
        except Misuse as error:
            response.message = str(error)
        return response


def _refuse(request: Any, response: Any) -> Any:
    """Answer that nothing was done, for which these services have no words."""
    response.ok = False
    return response
