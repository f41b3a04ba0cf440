"""Diagnostics of scenes: their files, the robots in them and their places."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, Code

BAD_SOURCE = Code(
    "bad_source",
    "The source {source} has {count:integer} characters; expected at most {most:integer} that can "
    "be printed, such as an id of the headset.",
    meaning="The name of who measured the surfaces of a room.",
)
SURFACES_OF_ONE_NAME = Code(
    "surfaces_of_one_name",
    "Two surfaces have the name {name}.",
    "Give each its own.",
    meaning="Surfaces of a room are told apart by their names.",
)
SURFACE_WITHOUT_NAME = Code(
    "surface_without_name",
    "A surface has no name.",
    "Give each its own, such as table_1.",
    meaning="Surfaces of a room are told apart by their names.",
)
SURFACE_HALF_TRIANGLE = Code(
    "surface_half_triangle",
    "Surface {surface} has {count:integer} triangle indices; expected three a triangle.",
    meaning="The triangles of a surface are not whole.",
)

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

# places of robots

NO_LEVEL_SURFACE = Code(
    "no_level_surface",
    "No level surface '{surface}' is in the room; there are: {known:list}.",
    "[Did you mean '{close}'?]",
    meaning="A robot was to stand on a surface that the room does not have.",
)
NO_PLACE_ON_SURFACE = Code(
    "no_place_on_surface",
    "There is no free place on {surface}.",
    "Remove a robot or an object there, or give a pose.",
    meaning="A surface has no room for another robot.",
)
NO_PLACE_BEFORE_VIEWER = Code(
    "no_place_before_viewer",
    "There is no free place within {distance:length} before the viewer.",
    "Turn around, remove a robot or an object there, or give a pose.",
    meaning="No surface in front of a viewer has room for another robot.",
)
NO_PLACE_ON_FLOOR = Code(
    "no_place_on_floor",
    "There is no free place within {distance:length} of the origin.",
    "Remove a robot, or give a pose.",
    meaning="The floor has no room for another robot.",
)

# loading a scene, and bringing it back: steps, which are parts of other texts

GO_TO_PLACE = Code("go_to_place", "go to the place {place}", severity=INFO)
DISSOLVE_SYSTEMS = Code("dissolve_systems", "dissolve {systems:list}", severity=INFO)
REMOVE_ROBOTS = Code("remove_robots", "remove {robots:list}", severity=INFO)
SET_CONTENTS = Code(
    "set_contents",
    "set {objects:count object|objects} and {surfaces:count surface|surfaces}",
    severity=INFO,
)
ADD_OBJECTS = Code("add_objects", "put {objects:list} back", severity=INFO)
SPAWN_ROBOTS = Code("spawn_robots", "spawn {robots:list}", severity=INFO)
LOAD_TRAJECTORY = Code("load_trajectory", "load {trajectory} into {robot}", severity=INFO)
CREATE_SYSTEM = Code("create_system", "create the system {system}", severity=INFO)
GRIP_OBJECTS = Code("grip_objects", "let {robots:list} grip {objects:list}", severity=INFO)
STEP_FAILED = Code(
    "step_failed",
    "Failed to {step:problem}: {why:problem}.",
    meaning="A step of loading a scene, or of bringing back the last one, failed.",
)
LOADED_IN_PART = Code(
    "loaded_in_part",
    "The scene is loaded in part: {why:problem}. Load it again.[\nDone:{done:problems}]"
    "[\nNot tried:{rest:problems}]",
    meaning="A step of loading a scene failed after others had been made.",
)
CONTENTS_LEFT_OUT = Code(
    "contents_left_out",
    "{objects:count object|objects} and {surfaces:count surface|surfaces} are left out: no "
    "physics runs.",
    severity=INFO,
    meaning="Objects and surfaces of a scene are not loaded in a lab without physics.",
)
TRAJECTORY_NOT_FITTING = Code(
    "trajectory_not_fitting",
    "The scene wants {robot} to play '{trajectory}', which the catalogue does not have for it"
    "[; there are: {known:list}].",
    "Convert the file, then load again.",
    meaning="A scene names a trajectory that is not in the catalogue, or is made for another "
    "robot or end effector.",
)
POSITION_BEYOND = Code(
    "position_beyond",
    "The scene wants {robot} at {position:time} of '{trajectory}', which lasts {duration:time}.",
    "Set 'at' to {most:exact} at most.",
    meaning="A scene sets a robot to a position that its trajectory does not have.",
)
NO_TRAJECTORY_NAMED = Code(
    "no_trajectory_named",
    "The system {system} names no trajectory for {robot}.",
    "Name one of the catalogue.",
    meaning="A member of a system has nothing to play.",
)

# undoing

NO_ACT_TO_UNDO = Code(
    "no_act_to_undo",
    "There is nothing to undo: loading, removing and dissolving can be undone for {limit:time}.",
    meaning="An act was to be undone that is older, or was undone already.",
)
UNDONE = Code(
    "undone",
    "Undone: {act:problem}[\n{missing:problem}]",
    severity=INFO,
    meaning="What an act removed is there again.",
)
NOT_BACK = Code(
    "not_back",
    "Not back: {names:list}. Another has the name, or what it needs is not there.",
    meaning="Some of what an act removed cannot come back as it is undone.",
)
UNDONE_IN_PART = Code(
    "undone_in_part",
    "Undone in part: {why:problem}. Undo it again.[\nDone:{done:problems}]"
    "[\nNot tried:{rest:problems}]",
    meaning="A step of undoing failed after others had been made. It can be tried again.",
)
OBJECTS_TAKEN_OUT = Code(
    "objects_taken_out",
    "Removed from the scene: {objects:list}.",
    severity=INFO,
    meaning="Somebody removed objects; they can be brought back for a while.",
)

# places

PLACE_SET = Code(
    "place_set",
    "The robots stand in {place}.",
    severity=INFO,
    meaning="The place of the lab was named, or the lab went to another one.",
    page=False,
)
BAD_PLACE_NAME = Code(
    "bad_place_name",
    "The name or id {name} of a place has {count:integer} characters; expected 1 to "
    "{most:integer} that can be printed, and not blanks alone.",
    meaning="A place cannot be called so.",
    page=False,
)
NO_SUCH_PLACE = Code(
    "no_such_place",
    "The lab has never been in a place with the id {place}.",
    "Leave the id out for a new place.",
    meaning="The lab was to go back to a place that it does not know.",
    page=False,
)
