"""Diagnostics of a robot's URDF and meshes."""

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
MESH_WITHOUT_TRIANGLES = Code(
    "mesh_without_triangles", "it holds no triangles", meaning="A mesh file holds nothing."
)
MESH_VERTEX_NOWHERE = Code(
    "mesh_vertex_nowhere", "a vertex is not finite", meaning="A mesh file holds NaN or infinity."
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

# the library of robots and end effectors

NO_ROBOT_MODEL = Code(
    "no_robot_model",
    "There is no robot '{robot}'; there are: {known:list}.",
    "[Did you mean '{close}'?]",
    meaning="The library has no robot of this id.",
)
NO_END_EFFECTOR = Code(
    "no_end_effector",
    "There is no end effector '{end_effector}'; there are: {known:list}, or none for a bare "
    "flange.",
    "[Did you mean '{close}'?]",
    meaning="The library has no end effector of this id.",
)
HAND_OF_ITS_OWN = Code(
    "hand_of_its_own",
    "Robot '{robot}' has a hand of its own.",
    "Leave the end effector empty, or import the robot again without its hand.",
    meaning="An imported robot with a hand takes no end effector of the lab.",
)
ROBOT_MESH_URI = Code(
    "robot_mesh_uri",
    "The mesh is '{mesh}'; expected a URI that begins with {prefix}.",
    meaning="The mesh of a robot is none of the library.",
)
HOME_SIZE = Code(
    "home_size",
    "{file}: home_deg has {count:count value|values}; expected {joints:integer}, one for each "
    "moving joint.",
    meaning="The home position of a robot does not fit its joints.",
)
SAME_NAMES = Code(
    "same_names",
    "Robot '{robot}' and end effector '{end_effector}' both have {names:list}.",
    "Rename them in one of the two URDFs.",
    meaning="A robot and an end effector have links or joints of the same name.",
)
LAB_NAMES = Code(
    "lab_names",
    "{file} has {names:list}, which the lab puts between a robot and its end effector.",
    "Rename them.",
    meaning="An end effector has a link or a joint with a name of the lab's own.",
)
NO_TCP = Code(
    "no_tcp",
    "{file} has no frame tcp; its links are {links:list}.",
    "Add a link tcp, or one that ends in _tcp, by a fixed joint where the tool works.",
    meaning="An end effector does not say where it works.",
)
FINGERS_STILL = Code(
    "fingers_still",
    "No joint of {file} moves, but {facts} says that fingers hold.",
    "Give the fingers joints that move, or write gripper: cup, magnet or none.",
    meaning="An end effector has a gripper with fingers, and no finger.",
)
END_EFFECTOR_LEFT_OUT = Code(
    "end_effector_left_out",
    "End effector '{end_effector}' is left out: {why:problem}",
    severity=Severity.WARNING,
    meaning="The files of an end effector are damaged; the others are listed.",
)
NO_MOTION_LEADS = Code(
    "no_motion_leads",
    "No motion of {robot} leads from {start:list} to {goal:list} rad ({why:problem}).",
    "Check the first row of the trajectory.",
    meaning="A motion to the start of a trajectory cannot be planned.",
)
MOTION_SIZE = Code(
    "motion_size",
    "A motion of {robot} from {start:integer} to {goal:integer} values was asked for; expected "
    "{joints:integer} joint positions each.",
    meaning="Joint positions do not fit the robot.",
)
SHEET_FORMAT = Code(
    "sheet_format",
    "The file is '{file}'; expected a name in {formats:either}.",
    meaning="A format that no sheet of a robot has.",
)
FOLDER_IN_USE = Code(
    "folder_in_use",
    "{folder} holds something already.",
    "Name a new folder.",
    meaning="A robot was to be exported into a folder that is not empty.",
)

# what is imported, and from where

NOT_OF_LIBRARY = Code(
    "not_of_library",
    "'{robot}' is not one of the lab's own robots.",
    "Import it again instead.",
    meaning="Meshes of a manufacturer are for the lab's own robots.",
)
NO_CLONE = Code(
    "no_clone",
    "{folder} holds no clone of {repository}[ at commit {commit}][: {why}].",
    "Clone it there, or say where it is.",
    meaning="The repository of a manufacturer's description is not on this machine.",
    page=False,
)
NOT_CLONED = Code(
    "commit_not_cloned",
    "The clone {folder} of {repository} lacks commit {commit}, with which its meshes were tried.",
    "Fetch that commit.",
    meaning="A clone of a manufacturer's description lacks the commit that robot.yaml states.",
    page=False,
)
MESHES_NEED = Code(
    "meshes_need",
    "Packing meshes needs the Python package '{package}', which is not installed.",
    "Install fast-simplification and embreex beside the lab.",
    meaning="A package that thins or lights meshes is missing.",
    page=False,
)
ANOTHER_SHAPE = Code(
    "another_shape",
    "The silhouette of these meshes has {share:share} of that of '{robot}'; at least "
    "{least:share} is expected.",
    "Take the description of the same product.",
    meaning="The meshes of a manufacturer's description show another body than the lab's.",
    page=False,
)
NOT_IMPORTED = Code(
    "not_imported",
    "Nothing was imported as '{robot}', so nothing is removed.",
    meaning="There is no imported robot of this id.",
)
NO_SHARED_LINK = Code(
    "no_shared_link",
    "No link of {file} that has a mesh[ ({meshed:list})] is a link of '{robot}' ({links:list}).",
    "Give a URDF without a prefix.",
    meaning="The links of a manufacturer's description have other names than the lab's.",
)

# the arm and the hand of a description


# the text of a URDF

A_URDF = Code("a_urdf", "a URDF", severity=Severity.INFO, meaning="A robot's description.")
URDF_LINK = Code(
    "urdf_link", "{file}: link '{link}'", severity=Severity.INFO, meaning="A place in a URDF."
)
URDF_JOINT = Code(
    "urdf_joint", "{file}: joint '{joint}'", severity=Severity.INFO, meaning="A place in a URDF."
)
FINITE_COUNT = Code(
    "finite_count",
    "{count:count finite number|finite numbers}",
    severity=Severity.INFO,
    meaning="What an attribute of a URDF must hold.",
)
NO_ZERO = Code(
    "no_zero", "numbers other than 0", severity=Severity.INFO, meaning="The scale of a mesh."
)
SIZES_ABOVE_ZERO = Code(
    "sizes_above_zero",
    "{count:count size|sizes} above 0, m",
    severity=Severity.INFO,
    meaning="The size of a shape.",
)
DOCUMENT_TYPE = Code(
    "document_type",
    "{file} declares a document type, which a URDF does not need.",
    "Remove the lines <!DOCTYPE ...> and <!ENTITY ...>.",
    meaning="Entities of a document type can expand without end.",
)
NOT_XML = Code(
    "not_xml",
    "{file} is not XML: {why:problem} in line {line:integer}[, '{found}'].",
    meaning="A description cannot be parsed.",
)
NOT_URDF = Code(
    "not_urdf",
    "{file} begins with <{tag}>; expected a URDF, which has <robot>.",
    meaning="An XML file is no robot's description.",
)
STILL_XACRO = Code(
    "still_xacro",
    "{file} holds <xacro:{tag}>; expected a plain URDF.",
    "Expand it: xacro {name} -o robot.urdf",
    meaning="A URDF still has elements of xacro.",
)
ELEMENT_LACKS = Code(
    "element_lacks",
    "{file}: <{element} name='{name}'> has no <{tag} {attribute}=...>.",
    "Add it.",
    meaning="An element of a URDF lacks what it must have.",
)
ELEMENT_UNNAMED = Code(
    "element_unnamed",
    "{file}: a <{element}>[ from '{parent}' to '{child}'] has no name.",
    "Add one.",
    meaning="A link or a joint of a URDF has no name.",
)
NAME_TOO_LONG = Code(
    "name_too_long",
    "{file}: a name is {count:integer} characters long, '{name}...'; expected {most:integer} at "
    "most.",
    meaning="A name in a URDF is longer than any.",
)
NAME_UNPRINTABLE = Code(
    "name_unprintable",
    "{file}: a link or a joint is named '{name}'; expected printable characters, and none of "
    "= + - @ at the beginning.",
    meaning="A name in a URDF that a terminal or a spreadsheet could take for something else.",
)
JOINT_TYPE = Code(
    "joint_type",
    "{place:problem} is of type '{type}'; expected {known:either}.",
    meaning="A joint of a type that the lab does not move.",
)
JOINT_AXIS = Code(
    "joint_axis",
    "{place:problem}: the axis is '{axis}'; expected a direction such as 0 0 1.",
    meaning="The axis of a joint has no direction.",
)
JOINT_NO_VELOCITY = Code(
    "joint_no_velocity",
    "{place:problem} has no <limit> with a velocity; expected lower, upper and velocity (rad, "
    "rad/s) from the robot's data sheet.",
    meaning="A moving joint of a URDF states no largest speed.",
)
GEOMETRY_EMPTY = Code(
    "geometry_empty",
    "{place:problem}: a <geometry> holds nothing; expected one of {known:either}.",
    meaning="A visual or a collision of a URDF has no shape.",
)
GEOMETRY_UNKNOWN = Code(
    "geometry_unknown",
    "{place:problem}: a <geometry> holds <{tag}>; expected one of {known:either}.",
    meaning="A visual or a collision of a URDF has no shape that the lab knows.",
)
SHAPE_LACKS = Code(
    "shape_lacks",
    "{place:problem}: a <{tag}> has no {missing:list}.",
    "Add it.",
    meaning="A shape of a URDF has no size.",
)
TOO_MANY_LINKS = Code(
    "too_many_links",
    "{file} has {count:integer} links; expected {most:integer} at most.",
    meaning="A description has more links than any robot.",
)
TWICE_IN_URDF = Code(
    "twice_in_urdf",
    "{file}: two {what:choice joint=joints are named|link=links are named|child=joints have the "
    "child} '{name}'; expected one tree of links, with a name each.",
    meaning="The links of a description are no tree, or two have one name.",
)
LINK_CIRCLE = Code(
    "link_circle",
    "Link '{link}' hangs below itself; expected a tree of links.",
    meaning="The links of a description are a circle.",
)
NO_LINK_IN_FILE = Code(
    "no_link_in_file",
    "{file} has no link '{link}'; its links: {known:list}.",
    meaning="A link was named that a description does not have.",
)
ROOT_LINKS = Code(
    "root_links",
    "{file} has the root links {links:list}; expected one.",
    meaning="The links of a description are no tree.",
)
NOT_ASSEMBLED = Code(
    "not_assembled",
    "{file} cannot be put together: {why:problem}.",
    "Compare it with the URDF specification, http://wiki.ros.org/urdf/XML.",
    meaning="The reader of descriptions fails on one.",
)
