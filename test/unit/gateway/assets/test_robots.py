"""Robots that only the lab has, fetched from it as any client does."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import anyio
import pytest
from anyio import to_thread
from fake_lab import FakeLab
from refusals import refused

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.assets import Described
from mrlab_ros.gateway.assets.cache import AssetCache
from mrlab_ros.gateway.assets.routes import Robots
from mrlab_ros.gateway.diagnostics import ROBOT_NOWHERE
from mrlab_ros.gateway.lab.connection import Refused, Sample

ROBOTS = Path(__file__).parents[4] / "robots"


class Lab(FakeLab):
    """A lab with a robot of its own; `asked` counts the queries for files."""

    def __init__(self) -> None:
        super().__init__()
        lab = RobotLibrary(ROBOTS, Path("none"))
        robots = {"robots": [{"id": "handmade", "tip_link": "tool0"}]}
        self.files = {
            "assets/robots.json": json.dumps(robots).encode(),
            "assets/robots/handmade.urdf": lab.description("ur5e").encode(),
            "assets/robots/handmade+parallel_gripper.urdf": lab.description(
                "ur5e", "parallel_gripper"
            ).encode(),
        }
        self.asked = 0

    async def get(self, selector: str, timeout_s: float = 5.0) -> Sample | None:
        key = selector.partition("?")[0].replace("%2B", "+")
        if key not in self.files:
            raise Refused(f"there is no asset {key}")
        self.asked += 1
        data = self.files[key]
        whole = Described(len(data), hashlib.sha256(data).hexdigest(), "application/xml")
        return Sample(key, data, attachment=whole.attachment(0))


@pytest.fixture
def lab():
    return Lab()


def shown(lab, *asked):
    """Return the robots that a gateway without imported robots shows, one after the other."""

    async def ask():
        assets = None if lab is None else AssetCache(lab)
        robots = Robots(RobotLibrary(ROBOTS, Path("none")), assets)
        return [await to_thread.run_sync(robots.shown, *each) for each in asked]

    return anyio.run(ask)


def test_a_robot_of_the_lab_is_fetched_once(lab):
    bare, again, held = shown(
        lab, ("handmade", None), ("handmade", ""), ("handmade", "parallel_gripper")
    )
    (known,) = shown(None, ("ur5e", None))
    assert (bare.model, bare.joints) == ("handmade", known.joints)
    assert again == bare
    assert "parallel_gripper" in held.urdf
    assert lab.asked == 3


def test_a_robot_of_this_machine_needs_no_lab(lab):
    shown(lab, ("ur5e", None))
    assert lab.asked == 0


def test_a_robot_that_neither_has_is_refused(lab):
    with refused(ROBOT_NOWHERE, BadInput):
        shown(lab, ("nobody", None))
    with pytest.raises(BadInput):
        shown(None, ("nobody", None))
