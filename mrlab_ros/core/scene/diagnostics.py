"""What is said of scenes: their files, the robots in them and the places where they stand."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

# files of scenes and cells

CELL_NOT_SCENE = Code(
    "cell_not_scene",
    "{place:problem} is a cell, not a scene.",
    "Create a system from it.",
    meaning="A file with the members of one system was given for a whole scene.",
)
SCENE_NOT_CELL = Code(
    "scene_not_cell",
    "{place:problem} holds {parts:list}; a cell has systems alone.",
    "Load it as a scene.",
    meaning="A whole scene was given where a cell was expected.",
)
NO_SYSTEM_IN_CELL = Code(
    "no_system_in_cell",
    "{place:problem} holds no system; expected members, or a list of systems.",
    meaning="A cell without a system.",
)
NAMED_TWICE = Code(
    "named_twice",
    "{place:problem} names the {what:choice robot=robot|object=object|system=system"
    "|surface=surface} {name} twice.",
    "Rename one.",
    meaning="Two entries of a scene have the same name.",
)
ROBOT_NOT_AMONG = Code(
    "robot_not_among",
    "{place:problem}: {name} names the robot '{robot}', which the scene does not have"
    "[; its robots: {known:list}].",
    meaning="An object or a system of a scene names a robot that the scene does not have.",
)
HOLDS_TWO = Code(
    "holds_two",
    "{place:problem}: {robot} holds two objects.",
    "Leave one out.",
    meaning="Two objects of a scene are in the hand of one robot.",
)
MEMBER_TWICE = Code(
    "member_twice",
    "{place:problem}: {robot} is a member twice.",
    "Leave one out.",
    meaning="A robot is a member of two systems of a scene, or twice of one.",
)
HELD_IN_PART = Code(
    "held_in_part",
    "held_by and in_hand belong together.",
    "Leave out both or none.",
    meaning="An object of a scene has only one of the two fields of what is held.",
)
