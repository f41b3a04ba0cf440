"""Diagnostics of the physics engine about arms, bodies and steps."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

PYBULLET_MISSING = Code(
    "pybullet_missing",
    "pybullet is not installed for this Python {version}; it has wheels for 3.10 and 3.11.",
    "Install one of those and set up again, or build it with pip install pybullet, which takes "
    "minutes.",
    meaning="The lab has no physics without the engine.",
)
WORLDS_FULL = Code(
    "worlds_full",
    "pybullet has no room for another world.",
    "Close one first.",
    meaning="The engine takes a limited number of worlds in a process.",
)
NOT_IN_WORLD = Code(
    "not_in_world",
    "Physics does not know {name}.",
    "Add it first.",
    meaning="The engine was asked for an arm or an object that it does not have.",
)
NO_LINK = Code(
    "no_link",
    "{robot} has no link '{link}'; its links: {known:list}.",
    meaning="The engine was asked for a link that the robot's description does not have.",
)
NO_MOVING_JOINT = Code(
    "no_moving_joint",
    "The description of {robot} has no moving joint {missing:either}; its joints: {known:list}.",
    meaning="A joint of the robot is missing in its description, or does not move there.",
)
NO_COLLISION_MESH = Code(
    "no_collision_mesh",
    "The collision mesh {mesh} of link '{link}' is missing or of no format that physics reads "
    "({formats:list}).",
    "Generate the robot's meshes again.",
    meaning="A collision mesh of a robot cannot be loaded.",
)
BAD_FINGERS = Code(
    "bad_fingers",
    "The fingers of {robot} were given the velocities {found:list}; expected {count:integer} "
    "finite numbers.",
    meaning="Velocities do not fit the fingers of an end effector.",
)
FINGER_BEYOND = Code(
    "finger_beyond",
    "Finger {finger} is put at {position:number}; expected {low:number} to {high:number}.",
    meaning="A finger was put beyond its limits, m or rad.",
)
BAD_STEP = Code(
    "bad_step",
    "A step of {step:exact} s; expected 0.00001 to 0.1 s.",
    meaning="The engine takes no shorter and no longer steps.",
)
NO_SPEED = Code(
    "no_speed",
    "The velocity {found:list} of {object} is no speed; expected m/s and rad/s.",
    meaning="An object was given a velocity that is not finite or beyond all reason.",
)
BAD_BODY = Code(
    "bad_body",
    "A body of {mass:mass} with {parts:count part|parts}; expected a mass of at least 0 and one "
    "part or more.",
    meaning="A body that the engine cannot make.",
)
NO_SHAPE = Code(
    "no_shape",
    "pybullet made no shape of a body.",
    "Check the sizes of its parts.",
    meaning="A body that the engine cannot make.",
)
BAD_SIZE = Code(
    "bad_size",
    "A {shape:choice box=box|cylinder=cylinder|sphere=sphere|hull=hull|mesh=mesh} of the size "
    "{size:list} m; expected {count:count number|numbers} of 0.0001 to 1000.",
    meaning="A part of a body has a size that the engine cannot make.",
)
BAD_MESH = Code(
    "bad_mesh",
    "A mesh without at least three finite vertices.",
    meaning="A part of a body is no mesh.",
)
HOLLOW_MESH = Code(
    "hollow_mesh",
    "A hollow mesh cannot move.",
    "Make it of convex parts.",
    meaning="The engine moves convex shapes only.",
)
MESH_NO_VERTEX = Code(
    "mesh_no_vertex",
    "The triangles of a mesh name vertices that it does not have.",
    meaning="A part of a body is no mesh.",
)
