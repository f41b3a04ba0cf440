"""What the converter says of a file's variables and of the trajectory that it makes of them.

Reasons stand inside findings: they are clauses, without a capital letter and a full stop.
"""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code, Severity

INFO, WARNING, _ = Severity
SAVE_AGAIN = (("", "", "save('traj.mat', 'q', '-v7')"),)
SAVE_RATE = (("frame_rate", "{rate:g}", "fs = {rate:g}; save('traj.mat', 'q', 'fs', '-v7')"),)
# what a file holds
CONTENTS = (
    " It holds {count:count variable|variables}[: {held:list}][, and {more:integer} more]."
    "[ Inside: {inside:list}.]"
)
QUANTITY = (
    "{quantity:choice velocities=velocities|accelerations=accelerations|jerks=third derivatives|"
    "torques=torques or forces|currents=motor currents|voltages=voltages|"
    "errors=errors or differences|poses=positions of the tool|times=times|"
    "parameters=parameters of a controller or model|turns=numbers of turns|"
    "obstacles=obstacles|temperatures=temperatures|"
    "joint_velocities=joint velocities|inputs=control inputs or pixel coordinates|"
    "pixels=velocities or pixel coordinates|tool_or_states=positions of the tool or states|"
    "points=points|states_or_path=states or path parameters|"
    "angular_velocities=angular velocities or weights|states=states|"
    "turns_or_reversed=numbers of turns or a reversed path}"
)
ANGLES = (
    "rad=radians|deg=degrees|mrad=milliradians|urad=microradians|gon=gon|turn=turns|"
    "halfturn=half turns|ddeg=tenths of a degree|cdeg=hundredths of a degree|"
    "mdeg=thousandths of a degree|arcmin=minutes of arc|arcsec=seconds of arc|counts=counts|"
    "%=percent|normalized=shares of a range|mm=mm"
)
GRIPPER_RANGE = (
    "{meaning:choice states=0 open, 1 closed|"
    "position=a position of 0 (open) to 255 (closed), as Robotiq's|"
    "width_m=an opening width in m, where larger means open|percent=percent|"
    "width_mm=an opening width in mm, where larger means open}"
)
SIDE = "closed {side:choice above=above|below=below} {threshold:number}"

# finding the matrix
TOO_MANY_ROWS = Code(
    "too_many_rows",
    "'{variable}' has {rows:count sample|samples}; the limit is {most:integer}.",
    "Save a part of it or every tenth sample, or raise the limit on rows.",
    meaning="The matrix has more samples than the limit on rows.",
    fixes=(("", "", "q = q(1:10:end, :); save('traj.mat', 'q', '-v7')"),),
)
NO_TRAJECTORY = Code(
    "no_trajectory",
    "No variable of '{file}' looks like the joint positions of {model}, an N x {joints:integer} "
    "matrix of radians with N >= 2." + CONTENTS + "[{looks:problems}]",
    "Save the joint positions, one row a sample. If one of the variables is what you want, name "
    "it.",
    meaning="No variable looks like joint positions of the robot; what they look like instead.",
)
LOOKS_LIKE = Code(
    "looks_like",
    "'{variable}' ({size}) was not taken as joint positions: {why:problem}.",
    "Save the joint positions, one row a sample. If it is what you want all the same, name it.",
    meaning="A matrix has the right size, but its numbers are no joint positions.",
)
CANDIDATE = Code(
    "candidate",
    "'{variable}' ({size}): {reasons:reasons}",
    severity=INFO,
    meaning="What a matrix that was not taken looks like.",
)
NEVER_FILLED = Code(
    "never_filled",
    "'{variable}' ({size}) holds nothing but zeros; joint positions are expected.",
    "Run the program that fills it before you save it.",
    meaning="Every number of the matrix is 0.",
    fixes=(("", "", "any({name:matlab}(:))"),),
)
ROWS_NOT_FILLED = Code(
    "rows_not_filled",
    "Rows {first_row:integer} to {last_row:integer} of '{variable}' are all zeros and the motion "
    "jumps to them: they were reserved (zeros(N, d)) and not filled.",
    "Leave them out, or fill them before you save.",
    meaning="Rows at an end of the matrix are zeros that were never filled.",
    data=("count",),
)
ROWS_LEFT_OUT = Code(
    "rows_left_out",
    "'{variable}' leaves out {count:integer} of the {rows:count row|rows} of '{other}'.",
    "If they belong to the motion, mend the place between them and take the whole matrix.",
    severity=WARNING,
    meaning="A part of a matrix was taken; rows of the motion are left out.",
)
AMBIGUOUS = Code(
    "ambiguous",
    "[Is '{only}' ({size}) of '{file}' the joint positions as the robot takes them? It would be "
    "taken, but {why:reasons}.][ Its values: {seen:reasons}.]"
    "[{count:count matrix|matrices} in '{file}' could be the trajectory:{candidates:problems}]",
    "[If '{only}' holds them, name it; if not, save the joint positions as q.]"
    "[Say which one of {among:list} it is, or save only that one.]",
    meaning="More than one matrix could be the trajectory, or the only one is doubtful: choose "
    "one.",
)
UNKNOWN_VARIABLE = Code(
    "unknown_variable",
    "'{file}' has no variable '{variable}'." + CONTENTS,
    "Take one of these names, written the same way.",
    meaning="The variable that was asked for is not in the file.",
)
UNSUPPORTED_OBJECT = Code(
    "unsupported_object",
    "{objects:list} could not be opened: {why:problem}. No other matrix of '{file}' is the "
    "trajectory.",
    "Save the numbers in it in MATLAB.",
    meaning="The values sit in a MATLAB object that could not be opened.",
)
OBJECT_IGNORED = Code(
    "object_ignored",
    "{objects:list} could not be opened and was left out: {why:problem}.",
    "Nothing to do, unless the trajectory is in there: then save the numbers in it in MATLAB.",
    severity=INFO,
    meaning="An object in the file could not be opened; the trajectory is a matrix beside it.",
    data=("file",),
)
UNKNOWN_CLASS = Code("unknown_class", "only MATLAB knows this class")
FUNCTION_HANDLE = Code("function_handle", "a function holds no samples until it is called")
INSIDE_CONTAINER = Code(
    "inside_container",
    "The trajectory is not one matrix: {pieces:choice joints=each joint is a variable of its own|"
    "segments=it is kept in segments|samples=it is kept in samples, one by one}, '{variable}' to "
    "'{last}'[, and {more:integer} more that are too many to list].",
    "Join them.",
    meaning="The trajectory is kept in pieces: a variable for each joint, sample or segment.",
)
WRONG_SHAPE = Code(
    "wrong_shape",
    "'{variable}' is {size}; {model} needs {joints:integer} columns, one a joint, or "
    "{more:integer} with the gripper last.[ Columns 1 to {dates:integer} are dates.]"
    "[ Column {time_column:integer} looks like time, beside {beside:integer} others.]"
    "[ A robot of {meant:integer} joints may be meant.][ Columns {columns} may be the joints.]"
    "[ It has {dimensions:integer} dimensions.]",
    "Save one row a sample and one column a joint[, or take the columns {columns}].",
    meaning="The matrix has the wrong number of columns or dimensions for the robot.",
    fixes=(("", "", "size({name:matlab})"),),
)
RECORDED_STATES = Code(
    "recorded_states",
    "'{variable}' holds recorded joint states, but not those of all joints of {model}; it names "
    "{found:list}.",
    "Choose the robot that was recorded, or replay the bag as it was recorded.",
    meaning="The joint states in a bag do not name all joints of the robot.",
)
TRANSFORMS = Code(
    "transforms",
    "'{variable}' ({size}) holds homogeneous transforms, one a page: poses, no joint positions.",
    "Save the joint positions, one row a sample; MATLAB computes them from poses with "
    "inverseKinematics, Corke's toolbox with ikine.",
    meaning="An array holds 4 x 4 transforms: poses of a tool or a body, no joint positions.",
    fixes=SAVE_AGAIN,
)
EMPTY = Code(
    "empty",
    "'{variable}' is empty ({size}).",
    "Run the program that fills it before you save it.",
    meaning="The matrix holds no samples.",
    fixes=(("", "", "isempty({name:matlab})"),),
)
SINGLE_SAMPLE = Code(
    "single_sample",
    "'{variable}' is {size}, a single configuration; a trajectory has at least 2 rows.",
    "Save a motion of two rows or more.",
    meaning="The matrix holds one configuration, not a motion.",
    fixes=(("", "", "q = jtraj({name:matlab}(:).', qEnd, 100);"),),
)
NOT_REAL = Code(
    "not_real",
    "'{variable}' holds complex numbers; joint positions are real.",
    "An inverse kinematics out of reach often gives them. Check the path; if the imaginary parts "
    "are only rounding, take the real part.",
    meaning="The matrix holds complex numbers.",
    fixes=(("", "", "{name:matlab} = real({name:matlab});"),),
)
WRONG_CLASS = Code(
    "wrong_class",
    "'{variable}' has the class {kind}; joint positions are double or single.",
    "Save radians as double.",
    meaning="The variable has a class that is not taken as radians: integer, logical, char, "
    "sparse.",
)
NON_FINITE = Code(
    "non_finite",
    "'{variable}' holds {count:count value that is|values that are} NaN or Inf, in "
    "{rows:integer} of {of:count row|rows}, the first in row {first_row:integer}, column "
    "{column:integer}.",
    "Find what made them with isfinite. Rows at an end and a few inside can be left out; more are "
    "filled from their neighbours, as the motion would be shorter without them.",
    meaning="The matrix holds NaN or Inf.",
)
TRANSPOSED = Code(
    "transposed",
    "'{variable}' is {size}: its samples are columns, {model} needs one row a sample."
    "[ Row {time_row:integer} is time.]",
    "Transpose it.",
    meaning="The samples are columns instead of rows.",
    fixes=(("transpose", "true", "{name:matlab} = {name:matlab}.';"),),
)
TIME_COLUMN = Code(
    "time_column",
    "Column {column:integer} of '{variable}' is time ({first:number} to {last:number}), not a "
    "joint: {why:problem}.[ Columns {columns} are the joints.]"
    "[ {left:count column is|columns are} left, and {model} has {joints:integer} joints.]",
    "Take the joints alone, or save them alone and the time as t.",
    meaning="A column counts time and is no joint.",
)
CLOCK = Code(
    "clock",
    "[its heading '{heading}' says time][it runs as '{other}' does]"
    "[{rises:choice far=it rises steadily, farther than a joint turns|"
    "round=it rises steadily in round steps|"
    "irregular=it rises in irregular steps, as recorded times do|"
    "even=it rises in equal steps throughout}]",
    severity=INFO,
    meaning="Why a column may be time.",
)
SEVEN_AXES = Code(
    "seven_axes",
    "Column {column:integer} of '{variable}' moves like a joint ({first:number} to {last:number}, "
    "{levels:count value|values}), not like a gripper that is open or closed; {model} has "
    "{joints:integer} joints.[ If it is a gripper that moves slowly, " + GRIPPER_RANGE + ", name "
    "it.]",
    "Choose the robot that the file was made for, take the joints alone, or say that it is the "
    "gripper.",
    meaning="The last column moves like a joint and not like a gripper.",
)
DEGREES = Code(
    "degrees",
    "'{variable}' seems to be in degrees[{percent:choice percent= or in percent, as several "
    "columns run from 0 to 100}]: {why:problem}; radians are expected.",
    "Convert it to radians with deg2rad, or name its unit if all of it is in degrees. If it is in "
    "radians all the same, name that unit.",
    meaning="The values are degrees; the lab takes radians.",
    fixes=(("units", "deg", "{name:matlab} = deg2rad({name:matlab});"),),
)
COUNTS = Code(
    "counts",
    "'{variable}' is not in radians: {why:problem}.",
    "Say how many counts make a turn, {counts:integer} or another number.",
    meaning="The values are encoder counts, hundredths or thousandths of a degree.",
    fixes=(("units", "counts:{counts}", "{name:matlab} = {name:matlab} * 2*pi / {counts};"),),
)
SCALE_BESIDE = Code(
    "scale_beside",
    "'{variable}' reaches {value:number}, which is not in radians; times '{source}' "
    "({factor:number}) it is within the limits of {model}.",
    "Multiply it by '{source}', or name its unit.",
    meaning="A factor beside the matrix brings it to radians.",
)
UNIT_OF_NAME = Code(
    "unit_of_name",
    "'{variable}' is named as {stated:choice " + ANGLES + "}; radians are expected.",
    "Convert it to radians, or confirm the unit by naming it.",
    meaning="The name of the matrix says a unit that is not radians.",
    fixes=(("units", "{stated}", ""),),
)
UNIT_CONFLICT = Code(
    "unit_conflict",
    "'{source}' says that '{variable}' is in {stated:choice " + ANGLES + "}, but '{other}' says "
    "{second:choice " + ANGLES + "}.",
    "Which one is right? Name the unit.",
    meaning="Two places of the file say different units of the same matrix.",
    fixes=(("units", "{stated}", ""), ("units", "{second}", "")),
)
UNITS_DIFFER = Code(
    "units_differ",
    "The file gives columns {columns} of '{variable}' in {stated:choice " + ANGLES + "} and "
    "columns {others} in {second:choice " + ANGLES + "}; each was taken in its own unit.",
    "Check that all joints move as they should. If one unit is right for all, name it.",
    severity=WARNING,
    meaning="The columns of one matrix have different units; each was converted by its own.",
    fixes=(("units", "{stated}", ""), ("units", "{second}", "")),
)
UNIT_UNREAD = Code(
    "unit_unread",
    "'{source}' says '{words}' of '{variable}', which is no unit of angles that is known; "
    "radians were taken.",
    "Write rad or deg there, or name the unit.",
    severity=WARNING,
    meaning="A text that is called a unit was not understood.",
    fixes=(("units", "rad", "{name:matlab} = deg2rad({name:matlab});"),),
)
COUNTS_STATED = Code(
    "counts_stated",
    "'{source}' says that '{variable}' is in {stated:choice " + ANGLES + "}, and the file does "
    "not say how much of them makes a turn.",
    "Say how many counts make a turn, or save radians.",
    meaning="The file says that the numbers are counts or shares, but not of how much.",
    fixes=(("", "", "plot({name:matlab})"),),
)
UNIT_NAMED = Code("unit_named", "its name says degrees", severity=INFO)
UNIT_REACHES = Code(
    "unit_reaches",
    "it reaches {largest:number}[ and is within the limits of {model} only if it is in "
    "{fits:choice degrees=degrees|hundredths=hundredths of a degree, or counts|"
    "thousandths=millidegrees, or counts}]"
    "[, as degrees do and radians of {beyond} do not]"
    "[{counted:choice counts= in whole numbers, as encoders count them}]",
    severity=INFO,
)
UNIT_MIXED = Code(
    "unit_mixed",
    "columns {columns} reach up to {largest:number}, as degrees do, but columns {others} move as "
    "radians do, so no one unit is right for all",
    severity=INFO,
)
BAD_COLUMNS = Code(
    "bad_columns",
    "The columns '{columns}' cannot be taken from '{variable}', which is {size}: {why:problem}.",
    "Write columns as in MATLAB: 2:7, or 1,3,5, or 2:end.",
    meaning="The columns that were asked for do not exist or cannot be read.",
    fixes=(("columns", "", "size({name:matlab}, 2)"),),
)
BAD_PART = Code(
    "bad_part",
    "'{variable}' cannot be taken from '{other}', which is {size}: {why:problem}.",
    "Write rows and columns as in MATLAB: q(1:200, :), or q(201:end, 1:6).",
    meaning="The part of a matrix that was asked for is not there.",
)
NO_INDEX = Code("no_index", "'{term}' is no {axis:choice row=row|column=column}")
STEP_OF_ZERO = Code("step_of_zero", "a step of 0 leads nowhere")
OUT_OF_RANGE = Code(
    "index_out_of_range",
    "there are the {axis:choice row=rows|column=columns} 1 to {count:integer}",
)
NO_INDICES = Code("no_indices", "that is no {axis:choice row=row|column=column} at all")
PIECES_DIFFER = Code(
    "pieces_differ",
    "The joints from '{variable}' on differ in length: most have {usual:count sample|samples}, "
    "but not {others:list}.",
    "Find out which samples are missing and save all of them again. If all begin together, cut "
    "them to the first {rows:integer}.",
    meaning="The vectors that hold a joint each differ in length, so they cannot be joined.",
)
BAD_RATE = Code(
    "bad_rate",
    "The frame rate is {value:number}; expected a number of samples per second from "
    "{least:number} to {most:number}.",
    "Say how many rows a second you recorded, such as 100.",
    meaning="The frame rate that was asked for is out of bounds.",
    fixes=(("frame_rate", "0", "fs = 100; save('traj.mat', 'q', 'fs', '-v7')"),),
)
BAD_OPTION = Code(
    "bad_option",
    "The option {option} is '{found}': {why:problem}.",
    "Correct the option or leave it out.",
    meaning="An option cannot be applied.",
    fixes=(("{option}", "", ""),),
)
ROWS_ALREADY = Code("rows_already", "'{variable}' is {size}: its samples are rows already")
NO_SUCH_VARIABLE = Code("no_such_variable", "there is no variable '{variable}'")
OTHER_LENGTH = Code(
    "other_length", "'{variable}' is {size}, and '{other}' has {rows:count row|rows}"
)
NO_SUCH_COLUMN = Code("no_such_column", "'{variable}' has the columns 1 to {width:integer}")
TOO_FEW_COLUMNS = Code(
    "too_few_columns",
    "'{variable}' has {width:integer} columns, and without column {column:integer} only "
    "{left:integer} are left for the {joints:integer} joints of {model}",
)
UNITS_CONTRADICT = Code(
    "units_contradict", "degrees were asked for as well; name one unit, such as {found}"
)
COUNTS_OF_WHAT = Code("counts_of_what", "counts needs the counts of one turn, such as counts:4096")
UNKNOWN_UNIT = Code("unknown_unit", "the units are {known:list}")
ALL_JOINTS_TURN = Code(
    "all_joints_turn", "all joints of {model} turn: they take rad, deg or counts:N"
)
COUNTS_DOWN = Code("counts_down", "'{term}' does not count upwards from one number to another")
NO_MATRIX = Code("no_matrix", "'{variable}' is no matrix of numbers")
ONE_PIECE = Code("one_piece", "it names one variable, and joining takes two or more")
SIZES_DIFFER = Code("sizes_differ", "the sizes differ: {sizes:list}")
NEUTRAL_NAME = Code(
    "neutral_name",
    "'{variable}' was taken as joint positions, though {why:problem}[ ({seen:reasons})].",
    "If it is something else, save the joint positions as q. If it is right, confirm it by its "
    "name.",
    severity=WARNING,
    meaning="A matrix whose name does not say what it holds was taken, as nothing speaks against "
    "it.",
)
DOUBTFUL_NAME = Code(
    "doubtful_name",
    "'{variable}' was taken as joint positions, but {why:problem}.",
    "Check that it is what you meant; joint positions are usually named q.",
    severity=WARNING,
    meaning="The name of the matrix speaks against joint positions.",
    fixes=(("", "", "plot({name:matlab})"),),
)
DOUBTFUL_VALUES = Code(
    "doubtful_values",
    "'{variable}' was taken as joint positions, but {why:reasons}.",
    "Look at the motion before you trust it, and save the joint positions as q.",
    severity=WARNING,
    meaning="Something in the numbers speaks against joint positions.",
    fixes=(("", "", "plot({name:matlab})"),),
)
NAME_SAYS = Code(
    "name_says",
    "its name [says "
    + QUANTITY
    + "][is often given to "
    + QUANTITY.replace("quantity:", "often:")
    + "][{hint:choice positions=is one that joint positions have|"
    "partly=is one that joint positions have|"
    "neutral=does not say what it holds|"
    "two_faced=is given to joint positions and to tool paths alike|"
    "doubtful=is often given to something else than joint positions|"
    "against=says that it is something else than joint positions}]"
    "[, but {unread:list} was not understood]",
    severity=INFO,
    meaning="What the name of a matrix says.",
)
SEEN = Code(
    "seen",
    "{what:choice message=it is a JointTrajectory for these joints|"
    "named=its columns are named as the joints|not_finite=it holds NaN or Inf|square=it is square|"
    "last_column=its last column is not a gripper's|"
    "between_zeros=it begins and ends at zero, as velocities do|"
    "limits=it leaves the joint limits|still=it never moves|smooth=it moves smoothly|"
    "rough=its rows do not follow one another like a motion|"
    "zeros=all of it is 0, so it was never filled}",
    severity=INFO,
    meaning="What is seen in the numbers of a matrix.",
)
FEW_ROWS_ONLY = Code("few_rows", "it has {rows:count row|rows} only", severity=INFO)
TOOL_PATH = Code(
    "tool_path", "'{other}' is the path of the tool at these positions", severity=INFO
)
HAS_DERIVATIVE = Code("has_derivative", "'{other}' is its derivative", severity=INFO)
DERIVATIVE_OF = Code(
    "derivative_of",
    "it holds the {order:choice first=velocities|second=accelerations} of '{other}'",
    severity=INFO,
)
TOOL_OF = Code(
    "tool_of", "its columns 1 to 3 are the positions of the tool at '{other}'", severity=INFO
)
VELOCITIES_OF = Code(
    "velocities_of", "they are the velocities of its columns {columns}", severity=INFO
)
LIKE_POSES = Code("like_poses", "it looks like poses of the tool: {why:problem}", severity=INFO)
WHOLE_LIKE_POSES = Code(
    "whole_like_poses",
    "the whole matrix looks like poses of the tool: {why:problem}",
    severity=INFO,
)
MAY_BE_POSES = Code(
    "may_be_poses", "it may be poses of the tool in m and rad: {why:reasons}", severity=INFO
)
QUATERNIONS = Code("quaternions", "columns 4 to 7 are unit quaternions", severity=INFO)
POSE_RANGES = Code(
    "pose_ranges",
    "columns 1 to 3 reach {far:number} and columns 4 to 6 only {near:number}: mm and "
    "{angles:choice rad=rad|deg=degrees}",
    severity=INFO,
)
POSE_HINT = Code(
    "pose_hint",
    "{hint:choice down=columns 4 to 6 are the orientation of a tool that points down|"
    "still=columns 4 to 6 never change while columns 1 to 3 move|"
    "wraps=columns 4 to 6 jump between -pi and pi, as angles of an orientation do|"
    "circle=two of columns 1 to 3 run on a circle}",
    severity=INFO,
)
MAY_BE_TIME = Code(
    "may_be_time",
    "column {column:integer} may be time and not a joint: {why:problem}",
    severity=INFO,
)
REPEATED_PIECES = Code("repeated_pieces", "{join} names a variable more than once", severity=INFO)
REPEATED_COLUMNS = Code(
    "repeated_columns", "columns {columns} name a column more than once", severity=INFO
)
LITTLE_IN_DEGREES = Code(
    "little_in_degrees",
    "in degrees, columns {columns} move by less than 2 degrees each, and they may be radians "
    "already, while others are degrees",
    severity=INFO,
)
LIKE_PERCENT = Code(
    "like_percent", "it runs from 0 to 100 in several columns, as percent do", severity=INFO
)
UNIT_STATED = Code(
    "unit_stated",
    "'{source}' says that it is in {stated:choice " + ANGLES + "}",
    severity=INFO,
)
SMALL_FOR_DEGREES = Code(
    "small_for_degrees",
    "its unit in the file is {stated:choice " + ANGLES + "}, and it reaches {largest:number}, "
    "as radians do too",
    severity=INFO,
)
TOOL_PATH_DIFFERS = Code(
    "tool_path_differs",
    "'{other}' is not the path of the tool at '{variable}' on this robot: they differ by "
    "{value:length}, and the path extends over {limit:length}.",
    "Choose the robot that the file was made for, or check that both belong to one motion.",
    severity=WARNING,
    meaning="A tool path in the file is not where the robot's tool goes; it may be another "
    "robot's.",
    fixes=(("", "", "plot({other:matlab})"),),
)
OTHER_CANDIDATES = Code(
    "other_candidates",
    "'{variable}' was taken; {others:list} could have been meant too.",
    "To take another one, name it.",
    severity=INFO,
    meaning="Other matrices could have been meant; the clearly likelier one was taken.",
)
COPIES = Code(
    "copies",
    "'{variable}' was taken; the same numbers are in {others:list}.",
    severity=INFO,
    meaning="Matrices hold the same numbers; one of them was taken.",
)
TWIN = Code(
    "twin",
    "'{variable}' was taken; nearly the same motion is in {others:list}.",
    "To take the other one, name it.",
    severity=WARNING,
    meaning="Two matrices hold nearly the same motion, such as measured and commanded positions.",
)
# the frame rate
RATE_DEFAULT = Code(
    "rate_default",
    "'{file}' does not say how many rows make a second; {rate:number} was taken.",
    "Save it with the trajectory as fs, or set the frame rate.",
    severity=INFO,
    meaning="The file does not say how many rows make a second; the lab's default was taken.",
    fixes=SAVE_RATE,
)
RATE_UNUSED = Code(
    "rate_unused",
    "'{variable}' is named as times or a rate of the rows, but was not used: {why:problem}; "
    "{rate:number} rows a second were taken.",
    "Save one rising time in seconds for each row, or the rate as the number fs.",
    severity=WARNING,
    meaning="Times, a step or a rate of the file could not be used; the lab's default was taken.",
    fixes=SAVE_RATE,
)
NO_NUMBER = Code(
    "no_number",
    "it is {found:problem} where a real number is expected",
    severity=INFO,
)
VALUES_OF = Code(
    "values_of",
    "{kind:choice complex=complex|text=text}",
    severity=INFO,
    meaning="Values that are no real numbers; other kinds are named as MATLAB's classes.",
)
TIMES_OF_CLASS = Code("times_of_class", "its class is {found:problem}", severity=INFO)
NO_RATE = Code("no_rate", "{value:number} is no rate or step of the rows", severity=INFO)
NO_COLUMN = Code("no_column", "it is {size} where one column is expected", severity=INFO)
TIME_NOT_FINITE = Code(
    "time_not_finite", "its row {first_row:integer} is {value:number}", severity=INFO
)
COARSE_TIMES = Code(
    "coarse_times",
    "single precision holds such times in steps of {value:number} only; save it as double",
    severity=INFO,
)
NO_TIMES_OF_ROWS = Code(
    "no_times_of_rows",
    "its values are no times of the rows that rise at a rate of joints",
    severity=INFO,
)
ANOTHER_COUNT = Code(
    "another_count",
    "it has {count:count element|elements}, and the trajectory {rows:count row|rows}",
    severity=INFO,
)
WAYPOINTS = Code(
    "waypoints",
    "The rows of '{variable}' come at {rate:rate} and are up to {value:angle} apart, the most "
    "before row {first_row:integer}: they are waypoints, between which the robot jumps.",
    "Resample them: straight lines join them. This needs their times, saved as t.",
    severity=WARNING,
    meaning="The rows are as far apart as waypoints, in time and in angle; the robot would jump.",
    fixes=(("resample", "true", "q = interp1(t, q, (t(1):0.01:t(end))'); fs = 100;"),),
)
RATE_FOUND = Code(
    "rate_found",
    "{rate:number} rows a second, from '{variable}'.",
    severity=INFO,
    meaning="The frame rate was taken from a variable of the file.",
)
RATE_OF_VELOCITY = Code(
    "rate_of_velocity",
    "The file does not say how many rows make a second; '{variable}' is the derivative of the "
    "positions at {rate:number} rows a second, which was taken.",
    "If the velocities are not in rad/s, set the frame rate.",
    severity=WARNING,
    meaning="The frame rate was computed from velocities, as the file does not say it.",
    fixes=SAVE_RATE,
)
RATE_ASSUMED = Code(
    "rate_assumed",
    "{rate:number} rows a second were taken from '{variable}', whose name may mean something "
    "else.",
    "If it is right, save it as fs; else set the frame rate.",
    severity=WARNING,
    meaning="The frame rate was taken from a variable whose name may mean something else.",
)
RATE_UNCLEAR = Code(
    "rate_unclear",
    "A rate or a step may be in {found:list}, but as well something else; {rate:number} rows a "
    "second were taken.",
    "Save the rate as fs, or set the frame rate.",
    severity=WARNING,
    meaning="Numbers of the file may say the frame rate, but none does so for certain.",
)
RATE_CONFLICT = Code(
    "rate_conflict",
    "'{variable}' says {rate:number} rows a second, but '{other}' says {limit:number}; the first "
    "was taken.",
    "Save only one of them, or set the frame rate.",
    severity=WARNING,
    meaning="Two variables of the file give different frame rates.",
)
TIME_UNIT = Code(
    "time_unit",
    "'{variable}' rises by {step:number} from row to row; that was taken as "
    "{taken:choice s=seconds|ms=milliseconds|us=microseconds|ns=nanoseconds|"
    "days=days, as datenum counts them|min=minutes|h=hours}, which makes {rate:number} rows a "
    "second.",
    "Save the time in seconds, or set the frame rate.",
    severity=WARNING,
    meaning="The unit of a time vector is not known; the likeliest one was taken.",
)
TIME_COUNTS_ROWS = Code(
    "time_counts_rows",
    "'{variable}' counts up by one: seconds, milliseconds or the numbers of the rows; "
    "{rate:number} rows a second were taken.",
    "Save the time in seconds, or set the frame rate.",
    severity=WARNING,
    meaning="A time vector counts 1, 2, 3 ..., which may be seconds, milliseconds or row numbers.",
)
TIME_LENGTH = Code(
    "time_length",
    "'{variable}' has {value:integer} elements and the trajectory {limit:integer} rows, so it was "
    "not used; it says {rate:number} rows a second.",
    "Save one time for each row, or set the frame rate.",
    severity=WARNING,
    meaning="A time vector has almost as many elements as there are rows and was not used.",
)
TIME_UNEVEN = Code(
    "time_uneven",
    "The steps of '{variable}' go from {least:number} to {most:number} s, the worst one before "
    "row {first_row:integer}; played evenly at {rate:number} rows a second, a row is up to "
    "{value:number} s away from its time.",
    "Resample it to make the rows even, or use interp1 in MATLAB.",
    severity=WARNING,
    meaning="The samples are not evenly spaced in time; they are played at one rate.",
)
TIME_ROUNDED = Code(
    "time_rounded",
    "The times of '{variable}' were rounded to {value:number} s; the rows come evenly, "
    "{rate:number} a second.",
    severity=INFO,
    meaning="Times of even rows were rounded when they were written; the rows are even.",
)
NO_TIMES = Code(
    "no_times",
    "Resampling needs the times of the rows of '{variable}', and the file has none.",
    "Save a time in s for each row, for example 2 s from row to row.",
    meaning="Rows are to be made even, but the file does not say when each of them is reached.",
)
TIME_REPEATED = Code(
    "time_repeated",
    "{count:count row|rows} of '{variable}' have the time of the row before, the first is row "
    "{first_row:integer}; the rows are played evenly at {rate:number} a second.",
    "Leave these rows out, and resample it to make the others even.",
    severity=WARNING,
    meaning="Rows have the same time as the row before.",
)
TIME_BACKWARD = Code(
    "time_backward",
    "The time '{variable}' goes back in {count:count row|rows}, the first is row "
    "{first_row:integer}; the rows are played in their order at {rate:number} a second.",
    "Check whether two recordings were joined; sort the rows in MATLAB, or take one of them, such "
    "as q(1:{last:integer}, :).",
    severity=WARNING,
    meaning="The time goes back.",
)
STAMPS_BACK = Code(
    "stamps_back",
    "{count:count message carries|messages carry} in '{variable}' an earlier stamp than the one "
    "before; what came before the latest stamp was left out.",
    "Check whether two recordings are in the bag or a clock was set back, and cut the bag there.",
    severity=WARNING,
    meaning="The stamps of a recording go back.",
    fixes=(("", "", "plot({name:matlab})"),),
)
RECORDING_PAUSES = Code(
    "recording_pauses",
    "'{variable}' has no point for {value:number} s before point {first_row:integer}; the robot "
    "takes that long from one to the next.",
    "If the recording was interrupted there, convert its parts alone.",
    severity=WARNING,
    meaning="A recorded motion has a long pause between two points.",
)
# messages and tables that name their joints
JOINT_NAMES = Code(
    "joint_names",
    "The joints of '{variable}' are not those of {model}.[ It lacks {missing:list}.]"
    "[ {model} has no {unknown:list}.][ It has {repeated:list} more than once.]",
    "Choose the robot that it was made for, or name the columns as the robot does: {joints:list}. "
    "Columns of a table can be taken by their numbers as well.",
    meaning="The joints that the file names are not those of the robot.",
)
ORDER_STATED = Code(
    "order_stated",
    "'{source}' says which joint each column of '{variable}' holds ({words}); the columns were "
    "put into the order of {model}.",
    "Check that the robot moves as it should. If the columns are in the robot's order already, "
    "take them by their numbers.",
    severity=WARNING,
    meaning="The file states an order of the joints that is not the robot's; it was obeyed.",
)
ORDER_UNCLEAR = Code(
    "order_unclear",
    "'{source}' gives '{variable}' an order of joints ({words}), which may say the joint of each "
    "column or the column of each joint.",
    "Which columns are the joints 1 to {joints:integer}?",
    meaning="The file states an order of the joints that can be read in two ways.",
)
NAMES_OTHER = Code(
    "names_other",
    "'{source}' names the columns of '{variable}' {words}, which are not the joints of {model}: "
    "{joints:list}.",
    "Are the columns these joints in this order all the same? Then name the matrix; else choose "
    "the robot that the file was made for.",
    meaning="The file names the columns as joints that the robot does not have.",
)
ROBOT_STATED = Code(
    "robot_stated",
    "'{source}' says '{words}', and {model} was chosen.",
    "Is the motion for {model} all the same? Then name the matrix; else choose the robot that the "
    "file names.",
    meaning="The file names another robot than the one that was chosen.",
)
MOTOR_SIDE = Code(
    "motor_side",
    "'{source}' speaks of motors or gears; the numbers of '{variable}' may be angles of motors "
    "and not of joints.",
    "Are they angles of the joints, behind the gears? If they are those of motors, divide them "
    "by the gear ratios and save the result as q.",
    severity=WARNING,
    meaning="The file holds gear ratios or names motors; the angles may be those of motors.",
    fixes=(("", "", "plot({name:matlab})"),),
)
UNUSED_BESIDE = Code(
    "unused_beside",
    "{found:list} {count:choice one=holds one number a joint|more=hold one number a joint|"
    "factor=may be a factor of it}[, and {unread:list} was not understood]: '{variable}' was "
    "taken as it is.",
    "If they are offsets, signs or factors of the joints, apply them and save the result as q.",
    severity=WARNING,
    meaning="Numbers beside a matrix were not used, such as offsets, signs or factors.",
    fixes=(("", "", "plot({name:matlab})"),),
)
TEXT_UNREAD = Code(
    "text_unread",
    "'{source}' says '{words}', and {unread:list} was not understood: '{variable}' was taken as "
    "it is.",
    "If it changes how the numbers are meant, apply it and save the result as q.",
    severity=WARNING,
    meaning="A text beside a matrix says something that was not understood.",
    fixes=(("", "", "plot({name:matlab})"),),
)
NO_MOTION = Code(
    "no_motion",
    "The rows of '{variable}' are no motion: "
    "{why:choice random=neighbouring rows are as far apart as any two rows|"
    "pose=the tool stands at one place while the joints jump, as solutions of an inverse "
    "kinematics do}.",
    "Save the motion in the order in which it runs; if the rows are waypoints, save the time of "
    "each of them as t.",
    meaning="The rows do not follow one another: random, shuffled, or solutions for one pose.",
    fixes=(("", "", "plot({name:matlab})"),),
)
JOINTS_MATCHED = Code(
    "joints_matched",
    "The columns of '{variable}' were matched to {model} by the names of its joints: columns "
    "{order:list} in this order.[ Left out: {left_out:list}.]",
    severity=INFO,
    meaning="The columns were put into the robot's order, by the names of its joints.",
)
RESAMPLED = Code(
    "resampled",
    "The {points:count point|points} of '{variable}' ({duration:time}) were joined by "
    "{curve:choice lines=straight lines|splines=cubic splines through their velocities} and "
    "became {frames:count frame|frames} at {rate:rate}.",
    "For another rate, set the frame rate.",
    severity=INFO,
    meaning="Points with times of their own became frames at an even rate.",
)
BAD_MESSAGE = Code(
    "bad_message",
    "'{variable}' is a JointTrajectory that cannot be played: {why:problem}.",
    "Every point needs a position for each joint, and a time_from_start later than that of the "
    "point before it.",
    meaning="A JointTrajectory contradicts itself.",
    fixes=SAVE_AGAIN,
)
LATE_POINT = Code(
    "late_point", "point {point:integer} ({time:time}) is not after the one before it"
)
SHORT_POINT = Code(
    "short_point",
    "point {point:integer} has {count:count position|positions} for {joints:count joint|joints}",
)
TOO_LONG = Code(
    "too_long",
    "'{variable}' lasts {duration:time}, which is more than {most:integer} frames at {rate:rate}.",
    "Check its times for a gap and the time of its last point; {lower:rate} at most would fit.",
    meaning="A trajectory lasts too long for the rate.",
    fixes=(("frame_rate", "{lower:.3g}", ""),),
)
# against the robot
JOINT_LIMIT = Code(
    "joint_limit",
    "{joint} goes to {value:measure} in row {row:integer} ({time:time}); its range is "
    "{lower:measure} to {upper:measure}; it is outside in {count:count row|rows}.",
    "Plan the motion inside the range, or choose the robot that it was made for.",
    meaning="A joint leaves its range.",
)
VELOCITY_LIMIT = Code(
    "velocity_limit",
    "{joint} moves at {value:measure} in row {first_row:integer} ({time:time}); {model} reaches "
    "{limit:measure}; it is too fast in {count:count step|steps}.",
    "Make the motion {times:number} times as long[, or check that {rate:number} rows a second is "
    "right: at {slower:number} the robot can follow].",
    severity=WARNING,
    meaning="A joint moves faster than the robot can.",
    fixes=(
        (
            "frame_rate",
            "{slower:g}",
            "q = {name:matlab}; fs = {slower:g}; save('traj.mat', 'q', 'fs', '-v7')",
        ),
    ),
)
DISCONTINUITY = Code(
    "discontinuity",
    "{joint} jumps by {value:measure} from row {first_row:integer} to the next ({time:time}); its "
    "other steps stay below {usual:measure}.",
    "Look for a piece that is missing or was joined at the wrong place.",
    meaning="A joint jumps from one sample to the next.",
)
STRAY_ROWS = Code(
    "stray_rows",
    "{joint} jumps by {value:measure} at row {first_row:integer} ({time:time}) and back after row "
    "{last_row:integer}; the rows before and after fit together.",
    "Leave out what does not belong there, or put the mean of its neighbours in its place.",
    meaning="A few rows lie apart from those before and after them, which fit together.",
    data=("count",),
)
JUMP_FULL_TURN = Code(
    "jump_2pi",
    "{joint} jumps by a full turn ({value:measure}) from row {first_row:integer} to the next "
    "({time:time}).",
    "Unwrap it.",
    meaning="A joint jumps by a full turn, as atan2 makes it.",
    fixes=(("unwrap", "true", "{name:matlab} = unwrap({name:matlab});"),),
)
GRIPPER_OUT_OF_RANGE = Code(
    "gripper_range",
    "The gripper column goes from {first:number} to {last:number}.[ That is "
    + GRIPPER_RANGE
    + ".] It was taken as "
    + SIDE
    + ".",
    "Save 0 for open and 1 for closed, or say that larger means open.",
    severity=WARNING,
    meaning="The gripper column is not 0 and 1.",
)
GRIPPER_BETWEEN = Code(
    "gripper_between",
    "{count:integer} of {rows:integer} samples in the gripper column lie between its ends "
    "{first:number} and {last:number}; the gripper was taken as " + SIDE + ".",
    "Save 0 for open and 1 for closed, without ramps. If the column is a joint, take the joints "
    "alone.",
    severity=WARNING,
    meaning="The gripper column is not always at one of its two ends; it may be a joint, or a "
    "ramp.",
)
GRIPPER_ASSUMED = Code(
    "gripper_assumed",
    "The last column, '{heading}', was taken as the gripper: 0 open, 1 closed.",
    "Where it is none, leave it out of the matrix.",
    severity=WARNING,
    meaning="A column behind those of the joints was taken as the gripper against its heading.",
)
GRIPPER_OPENS = Code(
    "gripper_opens",
    "By its heading '{heading}' is 1 where the gripper is open; it was turned round.",
    "Invert it to confirm that, or save 1 for closed.",
    severity=WARNING,
    meaning="The heading of the gripper's column says that 1 means open.",
)
GRIPPER_CONSTANT = Code(
    "gripper_constant",
    "The gripper column is {value:number} throughout; the gripper stays open.",
    severity=INFO,
    meaning="The gripper column never changes; the gripper stays open.",
)
GRIPPER_UNMOVED = Code(
    "gripper_unmoved",
    "The gripper column is {value:number} throughout, which does not say open or closed; the "
    "gripper stays open.",
    "Save 0 for open and 1 for closed. If the column is a joint, choose a robot that has it, or "
    "take the joints alone.",
    severity=WARNING,
    meaning="The gripper column never changes and is not 0; it may be closed, or be a joint.",
)
GRIPPER_BESIDE = Code(
    "gripper_beside",
    "'{variable}' ({size}) may be the states of the gripper; it was not taken.",
    "Take it as the gripper, or save it as the last column.",
    severity=WARNING,
    meaning="A vector that is named as a gripper lies beside the trajectory and was not taken.",
)
KINEMATICS_AGREE = Code(
    "kinematics_agree",
    "The robot '{variable}'[ ({title})] in the file agrees with {model} within {distance:length}.",
    severity=INFO,
    meaning="The robot that the file holds is the chosen one, up to its base and its tool.",
)
KINEMATICS_DIFFER = Code(
    "kinematics_differ",
    "The robot '{variable}'[ ({title})] in the file is not {model}:"
    "[ for the same joint positions its flange is up to {distance:length} and {angle:angle} "
    "away.][ it has {count:count joint|joints}, and {model} has {joints:integer}.] The motion may "
    "have been made for another robot, or with other zero positions of the joints.",
    "Choose the robot that the file was made for; or compare the zero positions and the "
    "directions of the joints with those of {model}.",
    severity=WARNING,
    meaning="The robot that the file holds is not the chosen one.",
)
# what was done
SQUEEZED = Code(
    "squeezed",
    "'{variable}' is {size}; it was taken as {taken}, as {line} gives it.",
    severity=INFO,
    meaning="An array of more than two dimensions was taken as one row a sample.",
)
CONVERTED_UNIT = Code(
    "converted_unit",
    "The file gives the unit of '{variable}' as {stated:choice " + ANGLES + "}"
    "[ ('{source}')]; it was converted to radians.",
    severity=INFO,
    meaning="The file says which unit the numbers have; they were converted to radians.",
)
LAYOUT_READ = Code(
    "layout_read",
    "The joints were read as they lie in the file: {why:problem}.",
    severity=INFO,
    meaning="The samples were columns, a column was time or each joint a variable: read so.",
)
TRANSPOSE_APPLIED = Code(
    "transpose_applied", "'{variable}' was transposed, as asked.", severity=INFO
)
COLUMNS_APPLIED = Code(
    "columns_applied", "Columns {columns} of '{variable}' were taken, as asked.", severity=INFO
)
GRIPPER_APPLIED = Code("gripper_applied", "The gripper was taken from '{gripper}'.", severity=INFO)
INVERT_APPLIED = Code(
    "invert_applied", "Larger values of the gripper were taken as open, as asked.", severity=INFO
)
UNITS_APPLIED = Code(
    "units_applied",
    "'{variable}' was taken as {taken:choice " + ANGLES + "}[, {counts:number} a turn], as asked.",
    severity=INFO,
)
UNWRAP_APPLIED = Code(
    "unwrap_applied", "Jumps of 2*pi in '{variable}' were removed, as asked.", severity=INFO
)
TRAJECTORY_TAKEN = Code(
    "trajectory_taken",
    "'{variable}' of '{file}' was taken: {frames:count frame|frames} at {rate:rate}, "
    "{duration:time}[, with {warnings:count warning|warnings}]",
    severity=INFO,
    meaning="A file became a trajectory.",
)
del INFO, WARNING
