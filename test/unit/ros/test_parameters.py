"""Parameters from records: declaration, descriptor, check at start and at run time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import pytest
import rclpy
from hypothesis import given
from hypothesis import strategies as st
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.context import Context
from rclpy.parameter import Parameter
from rclpy.serialization import deserialize_message, serialize_message

from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import (
    FLAG,
    TEXT,
    Choice,
    Integer,
    Number,
    Range,
    Texts,
    above,
    between,
    checked,
)
from mrlab_ros.core.base.diagnostic import plain as as_json
from mrlab_ros.core.base.records import field
from mrlab_ros.nodes.parameters import NODES
from mrlab_ros.ros.parameters import (
    LARGEST_DOUBLE,
    LARGEST_INTEGER,
    ParameterNode,
    WrongParameters,
    descriptor,
    plain,
    to_ros,
)


@dataclass(frozen=True)
class Sample:
    rate: float = field(Number(above(0, 100), "Hz"), "Rate.", 10.0, changeable=True)
    count: int = field(Integer(between(1, 7)), "Count.", 3, changeable=True)
    loud: bool = field(FLAG, "Loud.", False, changeable=True)
    folder: str = field(TEXT, "Folder.", "")
    mode: str = field(Choice({"a": "a", "b": "b"}), "Mode.", "a", changeable=True)
    names: tuple[str, ...] = field(Texts(skip_empty=True), "Names.", (), changeable=True)
    jerk: float = field(Number(above(0)), "Jerk.", 1.0, name="staging.jerk", changeable=True)


@dataclass(frozen=True)
class Other:
    size: int = field(Integer(), "Size.", 1)


class SampleNode(ParameterNode[Sample], name="sample", kind=Sample, others=(Other,)):
    def __init__(self, context: Context, **overrides: object) -> None:
        given = [Parameter(name.replace("__", "."), value=v) for name, v in overrides.items()]
        super().__init__(context=context, parameter_overrides=given)
        self.changes: list[Sample] = []

    def parameters_changed(self) -> None:
        self.changes.append(self.parameters)


@pytest.fixture(scope="module")
def context() -> Iterator[Context]:
    context = Context()
    rclpy.init(args=[], context=context)
    yield context
    context.try_shutdown()


@pytest.fixture(scope="module")
def shared(context: Context) -> Iterator[SampleNode]:
    node = SampleNode(context)
    yield node
    node.destroy_node()


def started(context: Context, **overrides: object) -> Sample:
    node = SampleNode(context, **overrides)
    try:
        return node.parameters
    finally:
        node.destroy_node()


def test_a_node_without_values_has_the_defaults(shared: SampleNode) -> None:
    assert shared.parameters == Sample()
    assert shared.get_parameter("rate").value == 10.0
    assert shared.get_parameter("staging.jerk").value == 1.0
    assert shared.get_parameter("names").value == [""]


def test_values_are_taken_in_the_type_of_their_record(context: Context) -> None:
    values = started(context, rate=5, names=["a", "", "b"], staging__jerk=2, loud=True)
    assert values == Sample(rate=5.0, names=("a", "b"), jerk=2.0, loud=True)
    assert type(values.rate) is float


def test_parameters_of_other_nodes_and_of_rclpy_are_no_mistakes(context: Context) -> None:
    assert started(context, size=4, use_sim_time=False) == Sample()


def test_all_mistakes_are_named_at_once(context: Context) -> None:
    with pytest.raises(WrongParameters) as caught:
        started(context, rate=-5.0, count=2.5, folder=5, mode="c", rat=1, staging__jerk=math.nan)
    said = as_json(caught.value)
    assert (said["code"], said["values"]["node"]) == ("parameters_refused", "sample")
    mistakes = said["values"]["mistakes"]["values"]["all"]
    assert [(each["code"], each["values"].get("found")) for each in mistakes] == [
        ("unknown_field", None),
        ("bad_value", "-5.0"),
        ("bad_value", "2.5"),
        ("bad_value", "5"),
        ("bad_value", "'c'"),
        ("bad_value", "nan"),
    ]


def test_a_refused_node_leaves_the_graph(context: Context, shared: SampleNode) -> None:
    before = len(shared.get_node_names())
    with pytest.raises(WrongParameters):
        started(context, rate=0)
    assert len(shared.get_node_names()) <= before


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("rate", 0.0, "rate is 0.0; expected a number above 0 and at most 100 (Hz)"),
        ("rate", math.nan, "rate is nan"),
        ("rate", math.inf, "rate is inf"),
        ("rate", "fast", "rate is 'fast'; expected a number"),
        ("rate", None, "rate is empty"),
        ("count", 8, "count is 8; expected a whole number from 1 to 7"),
        ("loud", 1, "loud is 1; expected true or false"),
        ("names", "x", "names is 'x'; expected a list of texts. Write [x]"),
        ("folder", "/tmp", "folder is read when sample starts and cannot change while it runs"),
        ("ratee", 1.0, "'ratee' is unknown"),
    ],
)
def test_a_bad_change_is_refused_with_the_reason(
    shared: SampleNode, name: str, value: object, reason: str
) -> None:
    before, changes = shared.parameters, len(shared.changes)
    result = shared.set_parameters([Parameter(name, value=value)])[0]
    assert not result.successful
    assert reason in result.reason
    assert (shared.parameters, len(shared.changes)) == (before, changes)


def test_a_change_takes_effect_once_and_keeps_the_declared_type(context: Context) -> None:
    node = SampleNode(context)
    changes = [Parameter("rate", value=20), Parameter("names", value=["x"])]
    assert node.set_parameters_atomically(changes).successful
    assert node.changes == [Sample(rate=20.0, names=("x",))]
    assert node.get_parameter("rate").type_ is Parameter.Type.DOUBLE
    assert node.set_parameters([Parameter("names", value=[""])])[0].successful
    assert node.parameters.names == ()
    assert node.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
    node.destroy_node()


def test_changes_are_all_or_none(shared: SampleNode) -> None:
    bad = [Parameter("count", value=5), Parameter("rate", value=-1.0), Parameter("mode", value=1)]
    result = shared.set_parameters_atomically(bad)
    assert not result.successful
    assert "rate is -1.0" in result.reason
    assert "mode is 1" in result.reason
    assert shared.parameters.count == 3


@pytest.mark.parametrize("node", NODES)
def test_the_ranges_arrive_as_they_are_written(node: str) -> None:
    """`limits` of whole numbers arrived as 5e-324."""
    for record in records.fields_of(NODES[node]).values():
        sent = serialize_message(descriptor(record))
        for found in deserialize_message(sent, ParameterDescriptor).floating_point_range:
            limits = record.check.limits  # type: ignore[attr-defined]
            assert (found.from_value, found.to_value) == (limits.low, limits.high), record.name


def test_a_descriptor_teaches(shared: SampleNode) -> None:
    rate, count, folder = shared.describe_parameters(["rate", "count", "folder"])
    assert (rate.type, rate.read_only) == (ParameterType.PARAMETER_DOUBLE, False)
    assert rate.description == "Rate."
    assert rate.additional_constraints == (
        "expected a number above 0 and at most 100 (Hz); a change takes effect at once"
    )
    assert rate.floating_point_range[0].from_value == 0.0
    assert rate.floating_point_range[0].to_value == 100.0
    assert (count.integer_range[0].from_value, count.integer_range[0].to_value) == (1, 7)
    assert folder.read_only
    assert folder.additional_constraints == "expected a text; read at the start only"


@given(st.floats(-1e300, 1e300) | st.just(-math.inf), st.floats(-1e300, 1e300))
def test_a_range_without_an_end_reaches_as_far_as_the_type(low: float, high: float) -> None:
    record = records.Field("x", Number(Range(low, high)), 0.0, "", True)
    found = descriptor(record).floating_point_range[0]
    assert found.from_value == (-LARGEST_DOUBLE if math.isinf(low) else low)
    assert found.to_value == high
    whole = descriptor(records.Field("x", Integer(), 0, "", True)).integer_range[0]
    assert (whole.from_value, whole.to_value) == (-LARGEST_INTEGER, LARGEST_INTEGER)


@pytest.mark.parametrize("node", NODES)
def test_every_default_of_the_lab_passes_its_own_check(node: str) -> None:
    for record in records.fields_of(NODES[node]).values():
        value = checked(record.name, plain(to_ros(record.default)), record.check)
        assert value == record.default, record.name
        assert record.about.endswith("."), record.name
