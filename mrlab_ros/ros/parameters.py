"""ROS parameters from records: descriptor, check at start and check of changes.

The parameters of a node are a dataclass whose fields are made with `core.records.field`. From
each record come the declaration with its descriptor (`ros2 param describe`), the check of what
the node was started with, the check of a change at run time, and docs/parameters.md.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Generic, TypedDict, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import Integer, Number, Range, Words, checked
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import PARAMETERS_OF_RCLPY
from mrlab_ros.core.base.records import Field
from mrlab_ros.ros.diagnostics import PARAMETER_FIXED, PARAMETERS_REFUSED
from mrlab_ros.ros.node import HiddenNode, LeanNode

if TYPE_CHECKING:
    from typing_extensions import Unpack

P = TypeVar("P")

# The ends of a range that has none, as the descriptor's types allow them.
LARGEST_DOUBLE = 1.7976931348623157e308
LARGEST_INTEGER = 2**63 - 1


class WrongParameters(BadInput):
    """A node was started with parameters that it cannot take."""


class NodeArguments(TypedDict, total=False):
    """Arguments of rclpy's Node that tests and hosts give."""

    context: Context | None
    parameter_overrides: list[Parameter]


class ParameterNode(LeanNode, Generic[P]):
    """A node whose parameters are the fields of a dataclass.

    A subclass declares its name, the dataclass `kind`, and `others`: the dataclasses of the lab's
    other nodes, whose parameters reach this node too where they are given for all nodes (/**).
    `parameters` holds the present values. Raises WrongParameters that names all mistakes in the
    values that the node was started with. Parameters that rclpy declares itself are not checked.
    """

    _name: str
    _kind: type[Any]
    _others: tuple[type[Any], ...]

    def __init_subclass__(
        cls, *, name: str, kind: type[P], others: Iterable[type[Any]] = ()
    ) -> None:
        super().__init_subclass__()
        cls._name, cls._kind, cls._others = name, kind, tuple(others)

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        name, kind = self._name, self._kind
        ros.setdefault("parameter_overrides", [])
        super().__init__(name, **ros)
        self._records = records.fields_of(kind)
        foreign = {f.name for other in self._others for f in records.fields_of(other).values()}
        own = {f.name for f in self._records.values()}
        given = {
            name: plain(parameter.value)
            for name, parameter in self._parameter_overrides.items()
            if name in own or not (name in foreign or name.startswith(PARAMETERS_OF_RCLPY))
        }
        try:
            self.parameters: P = records.read(kind, given, name)
        except BadInput as error:
            super().destroy_node()
            raise WrongParameters(PARAMETERS_REFUSED(mistakes=error, node=name)) from None
        for attribute, record in self._records.items():
            value = to_ros(getattr(self.parameters, attribute))
            self.declare_parameter(record.name, value, descriptor(record), ignore_override=True)

    def hidden_node(self, part: str, *, remapped: bool = False) -> Node:
        """Return a node without parameters and log for a part of this one, in its context.

        remapped: the names that the process was started with apply to it.
        """
        return HiddenNode(f"_{self.get_name()}_{part}", self.context, remapped=remapped)

    def parameters_changed(self) -> None:
        """Put `self.parameters` into effect after a change; called once for each change."""

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        return [self.set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Change parameters, all or none; a refusal says why.

        rclpy checks type, range and read_only itself, but its reasons name neither what was
        expected nor what to do, and a whole number is no number to it. So the check is here.
        """
        by_name = {f.name: (attribute, f) for attribute, f in self._records.items()}
        changes: dict[str, Any] = {}
        mistakes: list[Words] = []
        accepted = []
        for parameter in parameter_list:
            name = parameter.name
            if name not in by_name:
                if not self.has_parameter(name):
                    mistakes.append(records.unknown_field(self.get_name(), name, by_name))
                accepted.append(parameter)
                continue
            attribute, record = by_name[name]
            if not record.changeable:
                mistakes.append(PARAMETER_FIXED(parameter=name, node=self.get_name()))
                continue
            try:
                value = checked(name, plain(parameter.value), record.check)
            except BadInput as error:
                mistakes.append(error.diagnostic)
                continue
            changes[attribute] = value
            accepted.append(Parameter(name, value=to_ros(value)))
        if mistakes:
            return SetParametersResult(successful=False, reason="; ".join(map(str, mistakes)))
        result = super().set_parameters_atomically(accepted)
        if result.successful and changes:
            self.parameters = dataclasses.replace(self.parameters, **changes)  # type: ignore[type-var]
            self.parameters_changed()
        return result


def plain(value: Any) -> Any:
    """Return a parameter's value as a YAML file has it: arrays as lists."""
    return value if value is None or isinstance(value, bool | int | float | str) else list(value)


def to_ros(value: Any) -> Any:
    """Return a field's value as rclpy takes it.

    rclpy cannot tell the type of an empty list, so a list of no texts is [''].
    """
    return (list(value) or [""]) if isinstance(value, tuple) else value


def descriptor(record: Field) -> ParameterDescriptor:
    """Return what `ros2 param describe` shows. An open end is named in additional_constraints."""
    limits = getattr(record.check, "limits", None)
    result = ParameterDescriptor(
        name=record.name,
        description=record.about,
        additional_constraints=f"expected {record.check.expected}; "
        + ("a change takes effect at once" if record.changeable else "read at the start only"),
        read_only=not record.changeable,
    )
    if isinstance(limits, Range) and isinstance(record.check, Integer):
        low = -LARGEST_INTEGER if math.isinf(limits.low) else int(limits.low)
        high = LARGEST_INTEGER if math.isinf(limits.high) else int(limits.high)
        result.integer_range = [IntegerRange(from_value=low, to_value=high)]
    elif isinstance(limits, Range) and isinstance(record.check, Number):
        result.floating_point_range = [
            FloatingPointRange(
                # rosidl sends another number where a whole one stands here.
                from_value=float(max(limits.low, -LARGEST_DOUBLE)),
                to_value=float(min(limits.high, LARGEST_DOUBLE)),
            )
        ]
    return result
