"""What importing a description says: in a terminal only."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code, Severity

ROBOT_SPEED = Code(
    "robot_speed",
    "'{joint}' states no largest speed; motions are checked against {value:measure}.",
    "Write its <limit velocity=> into the URDF from the data sheet, and import it again.",
    severity=Severity.WARNING,
    meaning="A joint states no largest speed; one was assumed.",
)
ROBOT_STILL = Code(
    "robot_still",
    "'{joint}' neither moves the arm nor closes its hand; the lab keeps it at 0.",
    severity=Severity.INFO,
    meaning="A joint neither moves the arm nor closes the hand.",
)
BAD_ROBOT_ID = Code(
    "bad_robot_id",
    "The id is '{robot}'; expected small letters, digits and _, such as my_robot.",
    meaning="An id that an imported robot cannot have.",
)
ROBOT_ID_TAKEN = Code(
    "robot_id_taken",
    "'{robot}' is the id of a robot or an end effector already.",
    "Choose another id.",
    meaning="The id of an imported robot is taken.",
)
NO_DESCRIPTION = Code(
    "no_description",
    "'{source}' is neither a file nor an installed ROS package.",
    "Give the path of a URDF or a xacro.",
    meaning="The source of a robot is not there.",
)
PACKAGE_NO_FILE = Code(
    "package_no_file",
    "Package '{package}' has no file {file}[; its descriptions: {known:list}].",
    meaning="A package does not hold the description that was named.",
)
PACKAGE_DESCRIPTIONS = Code(
    "package_descriptions",
    "Package '{package}' has {count:count description|descriptions}[: {known:list}].",
    "[Name the one you want, such as {package}/{first}.]",
    meaning="A package holds no description of a robot, or several.",
)
NO_XACRO = Code(
    "no_xacro",
    "{file} is no xacro and takes no arguments.",
    "Leave out {arguments:list}.",
    meaning="Arguments are for xacro files.",
)
BAD_XACRO_ARGUMENT = Code(
    "bad_xacro_argument",
    "The argument is '{argument}'; expected NAME:=VALUE, as xacro takes it.",
    meaning="An argument of a xacro has another form.",
)
XACRO_NO_WALL = Code(
    "xacro_no_wall",
    "{file} is a xacro, which is a program, and the kernel here cannot confine it (expected "
    "Landlock and seccomp).",
    "Where you trust it, expand it yourself and import what comes out: xacro {file} > {plain}",
    meaning="A xacro from outside is expanded in a confined process only.",
)
XACRO_NO_ARGUMENT = Code(
    "xacro_no_argument",
    "{file} has no argument {arguments:list}[; it has {known:list}].",
    "[Did you mean '{close}'?]",
    meaning="An argument was given that a xacro does not use; the robot would be another one.",
)
UNBOUND_PREFIX = Code(
    "unbound_prefix",
    "{file} uses the prefix {prefix} in line {line:integer} and does not declare it.",
    'Write xmlns:{prefix}="{uri}" into its <robot>.',
    meaning="A prefix of an XML file stands for a namespace that the file must name.",
)
XACRO_REFUSED = Code(
    "xacro_refused",
    "{file}: xacro says: {why:problem}.[ The arguments of the file are {arguments:list}.]",
    "{hint:choice package=Give the folder of the package that it names.|folder=A xacro reads what "
    "lies beside it and in its packages; give the folder of the package that it "
    "needs.|argument=Give what it asks for, as NAME:=VALUE.|file=Correct the file.}",
    meaning="xacro does not expand a file.",
)
URDF_TOO_LARGE = Code(
    "urdf_too_large",
    "{file} is larger than {most:bytes}; expected a URDF.",
    meaning="No description of a robot is as large.",
)
MESH_NO_FILE = Code(
    "mesh_no_file", "{mesh} names no file: {why:problem}.", meaning="The URI of a mesh is none."
)
MESH_OUTSIDE = Code(
    "mesh_outside",
    "{mesh} is {path}, which is neither beside the description nor in a package.",
    meaning="A description may not name files elsewhere.",
)
MESH_NO_PACKAGE = Code(
    "mesh_no_package",
    "Package '{package}' of mesh {mesh} is not installed.",
    meaning="The package of a mesh is not there.",
)
TIP_GIVEN = Code(
    "tip_given",
    "up to the link that was named",
    severity=Severity.INFO,
    meaning="How it was decided which joints are the arm.",
)
TIP_OF_GROUP = Code(
    "tip_of_group",
    "group '{group}' of the SRDF",
    severity=Severity.INFO,
    meaning="How it was decided which joints are the arm.",
)
TIP_OF_CHAIN = Code(
    "tip_of_chain",
    "the longest chain of driven joints",
    severity=Severity.INFO,
    meaning="How it was decided which joints are the arm.",
)
TIP_UNMOVED = Code(
    "tip_unmoved",
    "{file}: no joint moves link '{link}'.",
    "Choose another last link of the arm.",
    meaning="The link that was named as the last of the arm does not move.",
)
ARM_MIMICS = Code(
    "arm_mimics",
    "{file}: joint '{joint}' of the arm mimics '{other}'; each joint of an arm is a column of the "
    "motion.",
    "Make it driven or fixed.",
    meaning="A joint of an arm follows another one.",
)
ARMS_BRANCH = Code(
    "arms_branch",
    "{file}: at link '{link}' chains of {first:integer} and {second:integer} joints begin; the "
    "lab moves one arm.",
    "Name the last link of it, such as {tip}.",
    meaning="A description has two arms.",
)
NO_ARM_THERE = Code(
    "no_arm_there",
    "{file}: no joint moves before the chains branch at link '{link}', as in a gripper or a "
    "vehicle.",
    "Import an arm, or name its last link; a hand alone comes in with --as-tool.",
    meaning="A description has no arm.",
)
HAND_LIMITS = Code(
    "hand_limits",
    "{file}: joint '{joint}' of the hand has the limits {lower:number} to {upper:number}; "
    "expected a range between open and closed.",
    "Add <limit lower= upper=>, or make the joint fixed.",
    meaning="A joint of a hand has no range.",
)
HAND_MIMICS = Code(
    "hand_mimics",
    "{file}: joint '{joint}' mimics '{other}', which leads to no driven joint of the hand; "
    "expected one that does not mimic another.",
    meaning="Joints of a hand follow each other in a circle, or one that is not there.",
)
HAND_BACKWARDS = Code(
    "hand_backwards",
    "The hand closes {behind:length} behind '{link}', and so inside the robot that carries it.",
    "Give it a root link whose z points out of the flange: one more, with a fixed joint to "
    "'{link}'.",
    severity=Severity.WARNING,
    meaning="The z of a hand's root link points away from its fingers.",
)
