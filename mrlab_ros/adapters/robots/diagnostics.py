"""What is found about the URDF and the meshes of a robot."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code, Severity

ROBOT_NO_LINK = Code(
    "robot_no_link",
    "Joint '{joint}' names link '{link}', which is not there.",
    "Add the link, or mend the name.",
    meaning="A joint of a robot names a link that is not there.",
)
ROBOT_ROOTS = Code(
    "robot_roots",
    "Expected exactly one root link; found {count:integer}[: {roots:list}].",
    "Connect the links by fixed joints.",
    meaning="The links of a robot are not one tree.",
)
ROBOT_JOINTS = Code(
    "robot_joints",
    "{count:count joint moves|joints move}; expected 1 to {most:integer}.",
    "Fix the joints that the arm does not need.",
    meaning="A robot has no moving joint, or too many.",
)
ROBOT_MILLIMETRES = Code(
    "robot_millimetres",
    "[The size of mesh {mesh}][The distance to the origin of '{joint}'] is {size:length}; that "
    "is no arm's size.",
    'Export in metres, or add scale="0.001 0.001 0.001" to the mesh.',
    meaning="A robot's size is no arm's: the file seems to be in millimetres.",
)
ROBOT_MIMIC = Code(
    "robot_mimic",
    "'{joint}' follows '{other}'; the lab moves it along with it.",
    severity=Severity.INFO,
    meaning="A joint follows another one.",
)
ROBOT_NO_LIMITS = Code(
    "robot_no_limits",
    "'{joint}' has no limits.",
    "Add <limit lower= upper= velocity= effort=> from the data sheet.",
    meaning="A moving joint of a robot has no limits.",
)
ROBOT_LIMITS = Code(
    "robot_limits",
    "The limits of '{joint}' are {lower:number} to {upper:number}.",
    "The lower limit must be below the upper one.",
    meaning="A joint's lower limit is not below the upper one.",
)
ROBOT_DEGREES = Code(
    "robot_degrees",
    "The limits of '{joint}' are {lower:number} to {upper:number} rad.",
    "These seem to be degrees: write radians.",
    meaning="A joint's limits seem to be degrees.",
)
ROBOT_VELOCITY = Code(
    "robot_velocity",
    "The velocity limit of '{joint}' is {value:number}.",
    "Write the largest speed, rad/s or m/s, or give it when you import the robot.",
    meaning="A joint's largest speed is not above 0.",
)
ROBOT_SPEED = Code(
    "robot_speed",
    "'{joint}' states no largest speed; motions are checked against {value:measure}.",
    "Write its <limit velocity=> into the URDF from the data sheet, and import it again.",
    severity=Severity.WARNING,
    meaning="A joint states no largest speed; one was assumed.",
)
ROBOT_STILL = Code(
    "robot_still",
    "'{joint}' moves neither the arm nor its hand; the lab keeps it at 0.",
    severity=Severity.INFO,
    meaning="A joint moves neither the arm nor the hand.",
)
ROBOT_EFFORT = Code(
    "robot_effort",
    "The largest effort of '{joint}' is not known.",
    severity=Severity.INFO,
    meaning="A joint's largest effort is not known.",
)
ROBOT_MASS = Code(
    "robot_mass",
    "The inertial of '{link}' has no positive mass or no inertia.",
    "Give both, or leave the inertial out.",
    severity=Severity.WARNING,
    meaning="An inertial has no mass or no inertia.",
)
ROBOT_NO_MASS = Code(
    "robot_no_mass",
    "The mass of '{link}' is {mass:mass}.",
    "Give the mass of the data sheet, in kg, or leave the inertial out.",
    meaning="A mass is negative, or no link's.",
)
ROBOT_INERTIA = Code(
    "robot_inertia",
    "The principal moments of '{link}' are {least:number}, {middle:number} and {most:number} "
    "kg*m^2.",
    "No body has these: each is positive and none exceeds the sum of the others.",
    severity=Severity.WARNING,
    meaning="An inertia is one that no body has.",
)
ROBOT_NO_MESH = Code(
    "robot_no_mesh",
    "Mesh {uri} is missing[: {why:problem}].",
    "Install the package that holds it, or give its folder when you import the robot.",
    meaning="A mesh of a robot is missing.",
)
ROBOT_MESH_FORMAT = Code(
    "robot_mesh_format",
    "Mesh {uri} is of a format that the lab does not draw.",
    "Convert it to {formats:either}.",
    meaning="A mesh has a format that the lab does not draw.",
)
ROBOT_MESH_UNREADABLE = Code(
    "robot_mesh_unreadable",
    "Mesh {uri} cannot be read: {why:problem}.",
    "Export it again from the program that made it.",
    meaning="A mesh of a robot cannot be read.",
)
ROBOT_NO_TEXTURE = Code(
    "robot_no_texture",
    "Mesh {uri} names {file}, which is missing.",
    "Put it beside the mesh, or go without its colours.",
    severity=Severity.WARNING,
    meaning="A file that a mesh names, a texture or a material library, is missing.",
)
ROBOT_FRAME = Code(
    "robot_frame",
    "Link '{link}' of {origin} lies {distance:length} and {angle:angle} from that of {robot}.",
    "Take the description of the same product and version.",
    meaning="A link's frame in another description is not where the lab's robot has it.",
)
ROBOT_HULL = Code(
    "robot_hull",
    "The body of '{link}' sticks out of its hulls by {smaller:length}, and they stand off it by "
    "up to {larger:length}; 5 and 20 mm are allowed.",
    "Make the hulls anew, in more pieces (CoACD and V-HACD do that).",
    severity=Severity.WARNING,
    meaning="Collision geometry does not follow what is seen.",
)
