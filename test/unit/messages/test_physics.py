from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from shape_msgs.msg import SolidPrimitive

from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.world_state import SceneObject
from mrlab_ros.messages.physics import object_to_message, type_to_message

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def types():
    document = yaml.safe_load((ROOT / "config" / "objects.yaml").read_text())
    return catalogue.parse(document, ObjectMeshes(ROOT, 20_000))


@pytest.mark.parametrize(
    ("name", "kind", "dimensions"),
    [
        ("block", SolidPrimitive.BOX, [0.12, 0.06, 0.04]),
        ("rod", SolidPrimitive.CYLINDER, [0.16, 0.02]),  # height, then radius
        ("ball", SolidPrimitive.SPHERE, [0.033]),
        ("peg", SolidPrimitive.CYLINDER, [0.1, 0.015]),  # one part, and a mesh
        ("cup", 0, []),
        ("table", 0, []),
    ],
)
def test_an_object_says_its_shape(types, name, kind, dimensions):
    message = type_to_message(types.get(name))
    assert (message.primitive.type, list(message.primitive.dimensions)) == (kind, dimensions)
    thing = SceneObject("it", types.get(name))
    assert object_to_message(thing, BodyState(Pose())).primitive == message.primitive


def test_every_type_can_be_drawn(types):
    for name in types.ids:
        message = type_to_message(types.get(name))
        assert message.primitive.type or message.mesh, name


def test_what_lies_off_its_origin_is_no_primitive():
    part = {"shape": "box", "size": [0.1, 0.1, 0.1], "at": [0, 0, 0.1]}
    document = {"objects": {"off": {"mass": 1.0, "parts": [part]}}}
    message = type_to_message(catalogue.parse(document).get("off"))
    assert message.primitive.type == 0
    assert message.mesh == "package://mrlab_ros/objects/off.glb"
