"""The one document of the lab: what is written is read, what is wrong is named."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.diagnostics import (
    A_MAPPING,
    BAD_VALUE,
    EMPTY_VALUE,
    ENTRY,
    FINITE_NUMBERS,
    IN_PLACE,
    LIMITS_BETWEEN,
    RESERVED_NAME,
    UNKNOWN_FIELD,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.diagnostics import (
    BAD_PLACE_NAME,
    HELD_IN_PART,
    HOLDS_TWO,
    MEMBER_TWICE,
    NAMED_TWICE,
    ROBOT_NOT_AMONG,
)
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
    parse,
    parse_intact,
    plain,
)
from mrlab_ros.core.systems.states import Policy
from mrlab_ros.core.systems.timeline import Mode


def test_a_scene_is_the_same_after_it_was_written_and_read():
    turned = Pose((0.1, 0.2, 0.3), (0.0, 0.0, 0.6, 0.8))
    scene = SceneDocument(
        robots=(
            RobotEntry("a", "ur5e", "parallel_gripper", turned, "run", 1.25, 0.5, True),
            RobotEntry("b", "ur5e", "", Pose((1.0, 0.0, 0.0))),
        ),
        objects=(
            ObjectEntry("cube_1", "cube", turned, held_by="a", in_hand=Pose((0.0, 0.0, 0.17))),
            ObjectEntry("cube_2", "cube", turned, automatic=True),
        ),
        systems=(
            SystemEntry(
                "cell",
                (MemberEntry("a", "run", 0.5), MemberEntry("b", "go", 0.0, ("frame 3: object "
                 "cube_1 held by a",))),
                mode=Mode.SEQUENTIAL,
                policy=Policy.HALT_MEMBER,
                loop=True,
                rate=0.5,
                at=2.5,
            ),
        ),
    )  # fmt: skip
    assert parse(plain(scene), "scene") == scene


ROBOT = {"name": "a", "model": "ur5e"}


@pytest.mark.parametrize(
    ("document", "code", "values"),
    [
        ({"robots": [{**ROBOT, "at": -1}]}, BAD_VALUE, {"found": "-1"}),
        (
            {"robots": [{**ROBOT, "position": [0, 1e6, 0]}]},
            LIMITS_BETWEEN,
            {"low": -100, "high": 100},
        ),
        ({"robots": [{**ROBOT, "position": [float("nan"), 0, 0]}]}, FINITE_NUMBERS, {}),
        (None, EMPTY_VALUE, {"what": "scene"}),
        ([], EMPTY_VALUE, {"what": "scene"}),
        ([{"cow": 1}], A_MAPPING, {}),
        ({"robots": [{**ROBOT, "speed": 1}]}, UNKNOWN_FIELD, {"key": "speed"}),
        ({"robots": [{**ROBOT, "speed": 1}]}, ENTRY, {"one": "robot", "number": 1}),
        ({"robots": [{**ROBOT, "name": "lab"}]}, RESERVED_NAME, {"name": "lab"}),
        (
            {"robots": [ROBOT], "objects": [{"name": "a", "type": "cube"}]},
            NAMED_TWICE,
            {"what": "object", "name": "a"},
        ),
        (
            {"surfaces": [{"name": "Wall 7"}] * 2},
            NAMED_TWICE,
            {"what": "surface", "name": "Wall 7"},
        ),
        ({"objects": [{"name": "c", "type": "cube", "held_by": "a"}]}, HELD_IN_PART, {}),
        (
            {"objects": [{"name": "c", "type": "cube", "held_by": "a", "in_hand": {}}]},
            ROBOT_NOT_AMONG,
            {"name": "c", "robot": "a", "known": []},
        ),
        (
            {
                "robots": [ROBOT],
                "objects": [
                    {"name": n, "type": "cube", "held_by": "a", "in_hand": {}} for n in "cd"
                ],
            },
            HOLDS_TWO,
            {"robot": "a"},
        ),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {"name": n, "members": [{"robot": "a", "trajectory": "t"}]} for n in "st"
                ],
            },
            MEMBER_TWICE,
            {"robot": "a"},
        ),
        *(
            ({"place": {"id": id, "name": name}}, BAD_PLACE_NAME, {"most": 64})
            for id, name in (
                ("a\0b", "Lab"),
                ("  ", "Lab"),
                ("a" * 65, "Lab"),
                ("a", "  "),
                ("a", "x" * 65),
                ("a", "\u200b"),
                ("a", "Lab\u202eB"),
            )
        ),
        ({"systems": [{"name": "s"}]}, ENTRY, {"one": "system", "number": 1}),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {
                        "name": "s",
                        "members": [{"robot": "a", "trajectory": "t", "waits": ["tea"]}],
                    }
                ],
            },
            IN_PLACE,
            {},
        ),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {"name": "s", "rate": 9, "members": [{"robot": "a", "trajectory": "t"}]}
                ],
            },
            BAD_VALUE,
            {"found": "9"},
        ),
    ],
)
def test_a_scene_that_contradicts_itself_is_refused(document, code, values):
    with refused(code, BadInput, **values):
        parse(document, "scene")


def test_an_empty_mapping_is_an_empty_scene():
    assert parse({}, "scene") == parse({"robots": []}, "scene") == SceneDocument()


def test_all_mistakes_are_named_at_once_and_what_is_intact_can_be_had():
    document = {
        "robots": [ROBOT, {**ROBOT, "name": "b", "rate": 0}, 5],
        "objects": [{"name": "c", "type": "cube", "held_by": "b", "in_hand": {}}],
        "cows": [],
    }
    with pytest.raises(BadInput) as caught:
        parse(document, "scene")
    for words in ("4 mistakes", "'cows' is unknown", "rate is 0", "robot 3 is 5", "the robot 'b'"):
        assert words in str(caught.value)
    scene, mistakes = parse_intact(document, "scene")
    assert scene == SceneDocument((RobotEntry("a", "ur5e", "", Pose()),))
    assert len(mistakes) == 4


def test_a_part_of_a_document_may_name_robots_of_elsewhere():
    held = {"name": "c", "type": "cube", "held_by": "a", "in_hand": {}}
    scene = parse({"objects": [held]}, "physics", whole=False)
    assert scene.objects[0].held_by == "a"
    assert parse({}, "physics", whole=False) == SceneDocument()
