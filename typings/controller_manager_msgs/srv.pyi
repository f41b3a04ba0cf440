# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import controller_manager_msgs.msg
from typing import ClassVar
from message_bases import Service

class ListControllerTypes(Service[ListControllerTypes.Request, ListControllerTypes.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        types: list[str]
        base_classes: list[str]
        def __init__(self, *, types: Sequence[str] = ..., base_classes: Sequence[str] = ...) -> None: ...

class ListControllers(Service[ListControllers.Request, ListControllers.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        controller: list[controller_manager_msgs.msg.ControllerState]
        def __init__(self, *, controller: Sequence[controller_manager_msgs.msg.ControllerState] = ...) -> None: ...

class LoadController(Service[LoadController.Request, LoadController.Response]):
    class Request:
        name: str
        def __init__(self, *, name: str = ...) -> None: ...
    class Response:
        ok: bool
        def __init__(self, *, ok: bool = ...) -> None: ...

class ReloadControllerLibraries(Service[ReloadControllerLibraries.Request, ReloadControllerLibraries.Response]):
    class Request:
        force_kill: bool
        def __init__(self, *, force_kill: bool = ...) -> None: ...
    class Response:
        ok: bool
        def __init__(self, *, ok: bool = ...) -> None: ...

class SwitchController(Service[SwitchController.Request, SwitchController.Response]):
    class Request:
        AUTO: ClassVar[int]
        BEST_EFFORT: ClassVar[int]
        FORCE_AUTO: ClassVar[int]
        STRICT: ClassVar[int]
        activate_controllers: list[str]
        deactivate_controllers: list[str]
        strictness: int
        activate_asap: bool
        timeout: builtin_interfaces.msg.Duration
        def __init__(self, *, activate_controllers: Sequence[str] = ..., deactivate_controllers: Sequence[str] = ..., strictness: int = ..., activate_asap: bool = ..., timeout: builtin_interfaces.msg.Duration = ...) -> None: ...
    class Response:
        ok: bool
        message: str
        def __init__(self, *, ok: bool = ..., message: str = ...) -> None: ...

class UnloadController(Service[UnloadController.Request, UnloadController.Response]):
    class Request:
        name: str
        def __init__(self, *, name: str = ...) -> None: ...
    class Response:
        ok: bool
        def __init__(self, *, ok: bool = ...) -> None: ...
