"""Diagnostics of physics: of grasps, objects and surfaces, of the catalogue, of joint states."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# grasps: why nothing is held, why it slips or was lost

TOO_WIDE = Code(
    "too_wide",
    "{object} is wider than the gripper opens.",
    severity=WARNING,
    meaning="Fingers stalled at their open end on what lies between them.",
)
LOOSE_BETWEEN = Code(
    "loose_between",
    "Between the fingers, and not held: {objects:list}.",
    severity=WARNING,
    meaning="More than one object lies between closed fingers; a gripper holds one.",
)
SIDE_OF_CUP = Code(
    "side_of_cup",
    "The cup touches {object} with its side.",
    severity=WARNING,
    meaning="A vacuum cup reached an object, but not with its lip.",
)
SIDE_OF_MAGNET = Code(
    "side_of_magnet",
    "The magnet touches {object} with its side.",
    severity=WARNING,
    meaning="A magnet reached an object, but not with its face.",
)
NO_SEAL_AT_EDGE = Code(
    "no_seal_at_edge",
    "The cup does not seal: {share:share} of its lip is on {object}; an edge, a hole or a rim "
    "lies under it.",
    severity=WARNING,
    meaning="A part of a cup's lip has nothing under it.",
)
NO_SEAL_TILTED = Code(
    "no_seal_tilted",
    "The cup does not seal: {object} is tilted by {tilt:angle} to it; expected {most:angle} at "
    "most.",
    severity=WARNING,
    meaning="The surface under a cup is tilted further than the bellows give way.",
)
NO_SEAL_CURVED = Code(
    "no_seal_curved",
    "The cup does not seal: {object} is too curved under its lip.",
    severity=WARNING,
    meaning="The surface under a cup is more curved than its lip follows.",
)
SLIPS = Code(
    "slips",
    "It slips: holding {mass:mass} needs a friction of {friction_needed:number}, there is "
    "{friction:number}.",
    severity=WARNING,
    meaning="The load on a grasp needs more friction than there is.",
)
OVER_PAYLOAD = Code(
    "over_payload",
    "{mass:mass} is more than the {payload:mass} that {robot} may carry with this end effector.",
    severity=WARNING,
    meaning="A held object is heavier than the payload that is stated for the robot, less its "
    "end effector.",
)
CAME_OFF_CUP = Code(
    "came_off_cup",
    "{object} came off the cup: {mass:mass}, friction {friction:number}, needed "
    "{friction_needed:number}.",
    severity=WARNING,
    meaning="Suction did not hold an object any longer.",
)
CAME_OFF_MAGNET = Code(
    "came_off_magnet",
    "{object} came off the magnet: {mass:mass}, friction {friction:number}, needed "
    "{friction_needed:number}.",
    severity=WARNING,
    meaning="A magnet did not hold an object any longer.",
)
SLIPPED_OUT = Code(
    "slipped_out",
    "{object} slipped out of the fingers: {mass:mass}, friction {friction:number}, needed "
    "{friction_needed:number}.",
    severity=WARNING,
    meaning="Friction did not hold an object any longer.",
)
PULLED_THROUGH = Code(
    "pulled_through",
    "{other} pulls {object} through the closed fingers of {robot}: it slid {way:length} "
    "against {force:number} N, and {other} holds it with a margin of {margin:share}.",
    severity=WARNING,
    meaning="Two hands hold one object and move apart.",
)
TORN_OFF = Code(
    "torn_off",
    "{other} tore {object} from the closed fingers of {robot}: it slid {way:length} against "
    "{force:number} N, and {other} holds it with a margin of {margin:share}.",
    severity=WARNING,
    meaning="An object was pulled out of a hand that had not opened.",
)
LET_GO = Code(
    "let_go",
    "{object} was let go: {robot} was given another end effector.",
    severity=INFO,
    meaning="A change of the end effector dropped what it held.",
)
OPENED_UNSEEN = Code(
    "opened_unseen",
    "{object} was let go: {robot} was told to open while the physics did not run.",
    severity=WARNING,
    meaning="The physics stood still or was started again, and a gripper opened meanwhile; what "
    "it held lies where it was opened.",
)
CLOSED_UNSEEN = Code(
    "closed_unseen",
    "{robot} was told to close while the physics did not run, and closes where it is now.",
    "Play it from before it closes.",
    WARNING,
    meaning="The physics stood still, and a gripper closed meanwhile; what it was to take lies "
    "where it was.",
)

# why the lab itself removed an object

MADE_ROOM = Code(
    "made_room",
    "The oldest of {limit:integer} objects made room for a new one.",
    severity=INFO,
    meaning="As many objects were active as may be at once.",
)
LEFT_ROOM = Code(
    "left_room", "It left the room.", severity=INFO, meaning="An object fell out of the room."
)

# attaching and detaching

FIXED_OBJECT = Code(
    "fixed_object",
    "{object} is fixed to the room.",
    "Choose an object that moves.",
    meaning="An object that never moves cannot be held.",
)
HOLDS_ALREADY = Code(
    "holds_already",
    "{robot} holds {object} already.",
    "Detach that first.",
    meaning="A robot holds one object at a time.",
)
NOT_MOVED_YET = Code(
    "not_moved_yet",
    "{robot} has not moved yet.",
    "Wait for its first joint state.",
    meaning="Physics does not know yet where the arm is.",
)
OUT_OF_ATTACH_REACH = Code(
    "out_of_attach_reach",
    "{object} is {distance:length} away from the hand of {robot}; expected {limit:length} at "
    "most (attach_reach).",
    "Bring the hand to the object, or the object to the hand, and attach it then.",
    meaning="An object is too far from a robot's hand to be attached to it.",
)
HOLDS_NOTHING = Code(
    "holds_nothing", "{robot} holds nothing.", meaning="There is nothing that could be detached."
)

# objects

NO_OBJECT_IN_SCENE = Code(
    "no_object_in_scene",
    "No object {object} is in the scene[; there are: {known:list}].",
    "[Did you mean '{close}'?]",
    meaning="An object was named that the scene does not have.",
)
NO_OBJECT_TYPE = Code(
    "no_object_type",
    "There is no object '{type}' in the catalogue; there are: {known:list}.",
    "[Did you mean '{close}'?]",
    meaning="An id that the catalogue of objects does not have.",
)
ALL_HELD = Code(
    "all_held",
    "All {count:integer} objects are held, so none makes room for a new one.",
    "Let one go or remove one first.",
    meaning="As many objects are active as may be at once, and none of them is free.",
)
NO_SURFACE_BELOW = Code(
    "no_surface_below",
    "There is no surface below {place:position}.",
    "Give a pose above one.",
    meaning="An object was to be put on the surface below a pose, and there is none.",
)
NO_FREE_PLACE = Code(
    "no_free_place",
    "There is no free place for {type} within {distance:length}.",
    "Move or remove something.",
    meaning="An object was to be put beside others, and there is no room.",
)
ALREADY_IN_WORLD = Code(
    "already_in_world",
    "{name} is in the world already.",
    "Remove it first.",
    meaning="A robot, an object or a surface was added twice.",
)

# the catalogue of objects

CATALOGUE = Code(
    "object_catalogue", "the catalogue of objects", severity=INFO, meaning="A place of a mistake."
)
OBJECT_ID = Code(
    "object_id",
    "an object's id in the catalogue",
    severity=INFO,
    meaning="A place of a mistake.",
)
OBJECT_ENTRY = Code(
    "object_entry", "object '{object}'", severity=INFO, meaning="An entry of the catalogue."
)
MASS_OR_FIXED = Code(
    "mass_or_fixed",
    "a number {limits:problem} (kg), or fixed: true for an object that never moves",
    severity=INFO,
    meaning="The mass of an object was expected.",
)
FIXED_WITH_MASS = Code(
    "fixed_with_mass",
    "fixed is true and a mass is given.",
    "Leave one of the two out.",
    meaning="An object of the catalogue is fixed and has a mass.",
)
SHAPE_AND_PARTS = Code(
    "shape_and_parts",
    "It has a shape and parts.",
    "Leave one of the two out.",
    meaning="An object of the catalogue is described twice.",
)

# surfaces

SURFACE_BEYOND = Code(
    "surface_beyond",
    "Surface {surface} has a vertex that is not finite or beyond 1 km.",
    meaning="A surface of a room reaches further than any room.",
)
SURFACE_TOO_FINE = Code(
    "surface_too_fine",
    "Surface {surface} has {count:integer} triangles; expected {most:integer} at most.",
    "Simplify the mesh, or send the planes of the room instead.",
    meaning="A surface has more triangles than the lab takes.",
)
SURFACE_NO_VERTEX = Code(
    "surface_no_vertex",
    "Surface {surface} names vertex {vertex:integer} of {count:integer}; expected indices of its "
    "own vertices.",
    meaning="A triangle of a surface names a vertex that it does not have.",
)
SURFACE_OUTLINE = Code(
    "surface_outline",
    "Surface {surface} has an outline of {count:count point|points}; expected 3 to "
    "{most:integer}, or triangles.",
    meaning="A plane of a room has too few or too many corners.",
)
SURFACE_IS_LINE = Code(
    "surface_is_line",
    "The outline of surface {surface} is a line; expected an area.",
    meaning="The corners of a plane lie on one line.",
)

# joint states

JOINT_STATE_SIZE = Code(
    "joint_state_size",
    "A joint state has {positions:integer} positions and {velocities:integer} velocities; "
    "expected {joints:integer} of each.",
    meaning="A joint state does not fit the robot.",
)
JOINT_STATE_BEYOND = Code(
    "joint_state_beyond",
    "A joint state holds NaN or infinity[, or a number beyond {most:exact}]; the arm stays "
    "where it is.",
    meaning="A joint state with numbers that no joint has.",
)
