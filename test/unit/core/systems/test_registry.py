"""Systems in the coordinator's journal: as they were, PAUSED where they were under way."""

from __future__ import annotations

import json

import pytest
from fakes import SECOND

from mrlab_ros.core.systems import registry
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.systems.states import Policy, SystemState
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import parse


def make() -> RobotSystem:
    wait = parse("frame 10: after a.frame 20")
    members = [
        Member("a", "one", duration=1.0, frame_rate=100.0),
        Member("b", "two", 0.5, (wait,), duration=2.0, frame_rate=50.0, start=0.25, met={wait}),
    ]
    return RobotSystem("cell", members, None, Mode.PARALLEL, Policy.HALT_MEMBER, loop=True)  # type: ignore[arg-type]


def again(content: dict) -> RobotSystem | None:
    ((name, robots, entry),) = registry.read(json.loads(json.dumps(content)))
    assert (name, robots) == ("cell", ["a", "b"])
    return registry.restore(entry, None, lambda: None, 9 * SECOND)  # type: ignore[arg-type]


def test_a_standing_system_comes_back_as_it_was():
    before = make()
    before.rate = 0.5
    after = again(registry.plain([before], SECOND))
    assert after is not None
    assert after.state is SystemState.READY
    assert (after.mode, after.policy, after.loop, after.rate) == (
        Mode.PARALLEL, Policy.HALT_MEMBER, True, 0.5,
    )  # fmt: skip
    assert list(after.members.values()) == list(before.members.values())


@pytest.mark.parametrize("state", ["PLAYING", "STAGING", "PAUSED", "COLLISION_HALT"])
def test_a_system_that_was_under_way_stands_where_it_was(state):
    content = registry.plain([make()], SECOND)
    content["systems"][0] |= {"state": state, "position": 0.75}
    after = again(content)
    assert after is not None
    assert (after.state, after.clock.position, after.clock.rate) == (SystemState.PAUSED, 0.75, 0.0)
    assert {m.robot: m.position for m in after.members.values()} == {"a": 0.75, "b": 0.5}


@pytest.mark.parametrize(
    "broken", [{"mode": "SIDEWAYS"}, {"rate": "x"}, {"members": [{"robot": 1}]}]
)
def test_an_entry_that_cannot_be_read_is_no_system(broken):
    content = registry.plain([make()], SECOND)
    entry = content["systems"][0] | broken
    assert registry.restore(entry, None, lambda: None, SECOND) is None  # type: ignore[arg-type]
