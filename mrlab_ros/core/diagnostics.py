"""Findings about a file or a trajectory, as data: code, severity, words, remedy, place.

`KINDS` is the one table of what the lab can find; `docs/diagnostics.md` is `document()`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.diagnostic import MATLAB_PATH, Diagnostic, Fix, Severity
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.foreign_text import for_shell, visible


class Refused(BadInput):
    """A file that cannot be taken, with the finding that says why."""

    def __init__(self, finding: Diagnostic) -> None:
        super().__init__(finding)

    @property
    def finding(self) -> Diagnostic:
        return self.diagnostic


@dataclass(frozen=True)
class Kind:
    """One row of the table.

    `message`, `remedy` and `fixes`, each (option, value, MATLAB), are filled in with str.format.
    """

    severity: Severity
    meaning: str
    message: str
    remedy: str = ""
    fixes: tuple[tuple[str, str, str], ...] = ()


INFO, WARNING, ERROR = Severity
SAVE_AGAIN = (("", "", "save('traj.mat', 'q')"),)
KINDS: dict[str, Kind] = {
    # the file
    "missing": Kind(
        ERROR,
        "There is no such file.",
        "There is no file '{file}'.",
        "Check the folder and the name; the file ends in .mat.",
        (("", "", "dir('*.mat')"),),
    ),
    "unsupported_format": Kind(
        ERROR,
        "The file is not a MATLAB workspace, and what it is instead.",
        "'{file}' is {found}, not a MATLAB workspace.",
        "In MATLAB: save('traj.mat', 'q') and convert traj.mat.",
        SAVE_AGAIN,
    ),
    "unreadable": Kind(
        ERROR,
        "The file is a workspace but damaged or cut short; nothing of it is taken.",
        "'{file}' is damaged: {problem}.",
        "Copy the file again, or save it again in MATLAB: save('traj.mat', 'q').",
        SAVE_AGAIN,
    ),
    "bad_table": Kind(
        ERROR,
        "A text file is no table of numbers with one row a sample.",
        "'{file}' cannot be read as a table: {problem}.",
        "Write numbers with a decimal point, one row a sample, under one row of headings; in "
        "MATLAB: writematrix([t q], 'traj.csv'), or save('traj.mat', 'q', 't').",
        (("", "", "writematrix([t q], 'traj.csv')"),),
    ),
    "converter_failed": Kind(
        ERROR,
        "The converter itself failed on the file; nothing of it is taken, and the next file is.",
        "The converter failed on '{file}' ({problem}); this is a fault of the converter.",
        "Save only the trajectory: save('traj.mat', 'q'), and report the fault with the file.",
        SAVE_AGAIN,
    ),
    "reader_died": Kind(
        ERROR,
        "The process that reads files ended while reading this one; the lab goes on.",
        "'{file}' brought the file reader down ({problem}); the file is damaged or made to do so.",
        "Save it again in MATLAB: save('traj.mat', 'q').",
        SAVE_AGAIN,
    ),
    "readers_disagree": Kind(
        ERROR,
        "Two independent readers do not find the same numbers: the file is damaged.",
        "'{variable}' of '{file}' cannot be trusted, as two readers disagree: {problem}.",
        "Save it again in MATLAB and send the new file: save('traj.mat', 'q', '-v7').",
        SAVE_AGAIN,
    ),
    "too_large": Kind(
        ERROR,
        "The file, or what it inflates to, passes the limit on size or memory.",
        "'{file}' is too large: {problem}.",
        "Save only the trajectory: save('traj.mat', 'q').",
        SAVE_AGAIN,
    ),
    "too_many_rows": Kind(
        ERROR,
        "The matrix has more samples than the limit on rows.",
        "'{variable}' has {rows} samples; the limit is {most}.",
        "Save a part of it or every tenth sample, or raise the limit: the parameter row_limit of "
        "the converter, --row-limit of mrlab convert.",
        (("", "", "q = q(1:10:end, :); save('traj.mat', 'q')"),),
    ),
    "too_slow": Kind(
        ERROR,
        "Reading the file passed the time limit and was stopped.",
        "'{file}' could not be read within {limit:g} s and was stopped.",
        "Save only the trajectory: save('traj.mat', 'q').",
        SAVE_AGAIN,
    ),
    # finding the matrix
    "no_trajectory": Kind(
        ERROR,
        "No variable looks like joint positions of the robot; what they look like instead.",
        "No variable of '{file}' looks like the joint positions of {robot}, an N x {joints} "
        "matrix of radians with N >= 2. {found}",
        "Save the joint positions, one row a sample: save('traj.mat', 'q'). If one of the "
        "variables is what you want, name it: --variable NAME.",
    ),
    "looks_like": Kind(
        ERROR,
        "A matrix has the right size, but its numbers are something else than joint positions.",
        "'{variable}' ({size}) was not taken as joint positions: {why}.",
        "Save the joint positions, one row a sample: save('traj.mat', 'q'). If it is what you "
        "want all the same, name it: --variable {variable:shell}.",
    ),
    "never_filled": Kind(
        ERROR,
        "Every number of the matrix is 0.",
        "'{variable}' ({size}) holds nothing but zeros; joint positions are expected.",
        "Run the program that fills it before you save it.",
        (("", "", "any({name}(:))"),),
    ),
    "rows_not_filled": Kind(
        ERROR,
        "Rows at an end of the matrix are zeros that were never filled.",
        "The rows {first_row} to {last_row} of '{variable}' are all zeros and the motion jumps to "
        "them: they were reserved (zeros(N, d)) and not filled.",
        "Leave them out: --variable '{fix}', or fill them before you save.",
    ),
    "ambiguous": Kind(
        ERROR,
        "More than one matrix could be the trajectory, or the only one is doubtful: choose one.",
        "{count} in '{file}' could be the trajectory: {found}.",
        "Say which one it is (--variable NAME), or save only that one: save('traj.mat', 'q').",
    ),
    "unknown_variable": Kind(
        ERROR,
        "The variable that was asked for is not in the file.",
        "'{file}' has no variable '{variable}'. {found}",
        "Take one of these names, written the same way.",
    ),
    "unsupported_object": Kind(
        ERROR,
        "The values sit in a MATLAB object that could not be opened.",
        "{found} could not be opened: {why}. No other matrix of '{file}' is the trajectory.",
        "In MATLAB, save the numbers in it: {code}",
        (("", "", "{code}"),),
    ),
    "object_ignored": Kind(
        INFO,
        "An object in the file could not be opened; the trajectory is a matrix beside it.",
        "{found} was left out, as it could not be opened: {why}.",
        "Nothing to do, unless the trajectory is in there: {code}",
    ),
    "inside_container": Kind(
        ERROR,
        "The trajectory is kept in pieces: a variable for each joint, sample or segment.",
        "The trajectory is not one matrix: {found}.",
        "Join them with the option join (--join '{join}'), or in MATLAB: {code}",
    ),
    "wrong_shape": Kind(
        ERROR,
        "The matrix has the wrong number of columns or dimensions for the robot.",
        "'{variable}' is {size}; {robot} needs {joints} columns, one a joint, or {more} with "
        "the gripper last.{hint}",
        "Save one row a sample and one column a joint{pick}.",
        (("", "", "size({name})"),),
    ),
    "recorded_states": Kind(
        ERROR,
        "A bag holds joint states, one message an instant: a recording, no trajectory.",
        "'{variable}' holds joint states, one message an instant: a recording, no trajectory.",
        "Play it as it was recorded: mrlab replay BAG. To look at it, make a session of it: mrlab "
        "bag import BAG SESSION, then mrlab show SESSION.",
        (("", "", "save('traj.mat', 'q')"),),
    ),
    "transforms": Kind(
        ERROR,
        "An array holds 4 x 4 transforms: poses of a tool or a body, no joint positions.",
        "'{variable}' ({size}) holds homogeneous transforms, one a page: poses, no joint "
        "positions.",
        "Save the joint positions, one row a sample; MATLAB computes them from poses with "
        "inverseKinematics, Corke's toolbox with ikine.",
        (("", "", "save('traj.mat', 'q')"),),
    ),
    "empty": Kind(
        ERROR,
        "The matrix holds no samples.",
        "'{variable}' is empty ({size}).",
        "Run the program that fills it before you save it.",
        (("", "", "isempty({name})"),),
    ),
    "single_sample": Kind(
        ERROR,
        "The matrix holds one configuration, not a motion.",
        "'{variable}' is {size}, a single configuration; a trajectory has at least 2 rows.",
        "Save a motion, for example q = jtraj(qStart, qEnd, 100).",
        (("", "", "q = jtraj({name}(:).', qEnd, 100);"),),
    ),
    "not_real": Kind(
        ERROR,
        "The matrix holds complex numbers.",
        "'{variable}' holds complex numbers; joint positions are real.",
        "An inverse kinematics out of reach often gives them. Check the path; if the imaginary "
        "parts are only rounding: {name} = real({name}).",
        (("", "", "{name} = real({name});"),),
    ),
    "wrong_class": Kind(
        ERROR,
        "The variable has a class that is not taken as radians: integer, logical, char, sparse.",
        "'{variable}' has the class {kind}; joint positions are double or single.",
        "Save radians as double: {name} = {fix}({name}).",
        (("", "", "{name} = {fix}({name});"),),
    ),
    "non_finite": Kind(
        ERROR,
        "The matrix holds NaN or Inf.",
        "'{variable}' holds {count} that are NaN or Inf, the first at {where}.",
        "Remove those samples or find what made them: any(~isfinite({name}), 2).",
        (("", "", "q = q(all(isfinite(q), 2), :);"),),
    ),
    "transposed": Kind(
        ERROR,
        "The samples are columns instead of rows.",
        "'{variable}' is {size}: its samples are columns, {robot} needs one row a sample.{time}",
        "In MATLAB {name} = {name}.', or convert with the option transpose (--transpose).",
        (("transpose", "true", "{name} = {name}.';"),),
    ),
    "time_column": Kind(
        ERROR,
        "A column counts time and is no joint.",
        "Column {column} of '{variable}' is time ({first:g} to {last:g}), not a joint: {why}. "
        "{rest}",
        "Take the joints alone with the option columns (--columns), or save them alone and the "
        "time as t.",
    ),
    "seven_axes": Kind(
        ERROR,
        "The last column moves like a joint and not like a gripper.",
        "Column {column} of '{variable}' moves like a joint ({first:g} to {last:g}, {levels}), "
        "not like a gripper that is open or closed; {robot} has {joints} joints.{ramp}",
        "Choose the robot that the file was made for, convert the joints alone "
        "(--columns 1:{joints}), or say that it is the gripper (--gripper {column}).",
    ),
    "degrees": Kind(
        ERROR,
        "The values are degrees; the lab takes radians.",
        "'{variable}' seems to be in degrees: {why}; radians are expected.",
        "In MATLAB {name} = deg2rad({name}), or convert with the option units (--units deg). If "
        "it is in radians all the same: --units rad.",
        (("units", "deg", "{name} = deg2rad({name});"),),
    ),
    "counts": Kind(
        ERROR,
        "The values are encoder counts, hundredths or thousandths of a degree.",
        "'{variable}' is not in radians: {why}.",
        "Say how many counts make a turn: --units counts:{counts}, or another number, or in "
        "MATLAB {name} = {name} * 2*pi / {counts}.",
    ),
    "bad_columns": Kind(
        ERROR,
        "The columns that were asked for do not exist or cannot be read.",
        "The columns '{columns}' cannot be taken from '{variable}', which is {size}: {problem}.",
        "Write columns as in MATLAB: 2:7, or 1,3,5, or 2:end.",
        (("columns", "", "size({name}, 2)"),),
    ),
    "bad_part": Kind(
        ERROR,
        "The part of a matrix that was asked for is not there.",
        "'{variable}' cannot be taken from '{other}', which is {size}: {problem}.",
        "Write rows and columns as in MATLAB: q(1:200, :), or q(201:end, 1:6).",
    ),
    "pieces_differ": Kind(
        ERROR,
        "The vectors that hold a joint each differ in length, so they cannot be joined.",
        "The joints from '{variable}' on differ in length: {found}.",
        "Find out which samples are missing and save all of them again. If all begin together, "
        "cut them to the first {rows} in MATLAB: {code}",
    ),
    "bad_rate": Kind(
        ERROR,
        "The frame rate that was asked for is out of bounds.",
        "The frame rate is {value:g}; expected a number of samples per second from {least:g} to "
        "{most:g}.",
        "Say how many rows a second you recorded: --rate 100.",
        (("frame_rate", "0", "fs = 100; save('traj.mat', 'q', 'fs')"),),
    ),
    "bad_option": Kind(
        ERROR,
        "An option cannot be applied.",
        "The option {option} is '{found}': {problem}.",
        "Correct the option or leave it out.",
        (("{option}", "", ""),),
    ),
    "neutral_name": Kind(
        WARNING,
        "A matrix whose name does not say what it holds was taken, as nothing speaks against it.",
        "'{variable}' was taken as joint positions, though {why} ({seen}).",
        "If it is something else, save the joint positions as q. To confirm it: --variable "
        "{variable:shell}.",
    ),
    "doubtful_name": Kind(
        WARNING,
        "The name of the matrix speaks against joint positions.",
        "'{variable}' was taken as joint positions, but {why}.",
        "Check that it is what you meant; joint positions are usually named q.",
        (("", "", "q = {name}; save('traj.mat', 'q')"),),
    ),
    "doubtful_values": Kind(
        WARNING,
        "Something in the numbers speaks against joint positions.",
        "'{variable}' was taken as joint positions, but {why}.",
        "Look at the motion before you trust it, and save the joint positions as q.",
        (("", "", "plot({name})"),),
    ),
    "tool_path_differs": Kind(
        WARNING,
        "A tool path in the file is not where the robot's tool goes; it may be another robot's.",
        "'{other}' is not the path of the tool at '{variable}' on this robot: they differ by "
        "{value:.3g} m, and the path extends over {limit:.3g} m.",
        "Choose the robot that the file was made for, or check that both belong to one motion.",
        (("", "", "plot({other:matlab})"),),
    ),
    "other_candidates": Kind(
        INFO,
        "Other matrices could have been meant; the clearly likelier one was taken.",
        "'{variable}' was taken; {found} could have been meant too.",
        "To take another one: --variable NAME.",
    ),
    "copies": Kind(
        INFO,
        "Matrices hold the same numbers; one of them was taken.",
        "'{variable}' was taken; {found} holds the same numbers.",
    ),
    "twin": Kind(
        WARNING,
        "Two matrices hold nearly the same motion, such as measured and commanded positions.",
        "'{variable}' was taken; {found} holds nearly the same motion.",
        "To take the other one: --variable NAME.",
    ),
    # the frame rate
    "rate_default": Kind(
        INFO,
        "The file does not say how many rows make a second; the lab's default was taken.",
        "'{file}' does not say how many rows make a second; {rate:g} was taken.",
        "Save it with the trajectory: fs = 100; save('traj.mat', 'q', 'fs'), or use --rate.",
        (("frame_rate", "{rate:g}", "fs = {rate:g}; save('traj.mat', 'q', 'fs')"),),
    ),
    "rate_unused": Kind(
        WARNING,
        "Times, a step or a rate of the file could not be used; the lab's default was taken.",
        "'{variable}' is named as times or a rate of the rows, but was not used: {problem}; "
        "{rate:g} rows a second were taken.",
        "Save one rising time in seconds for each row, or the rate as a number: fs = 100; "
        "save('traj.mat', 'q', 'fs'), or use --rate.",
        (("frame_rate", "{rate:g}", "fs = {rate:g}; save('traj.mat', 'q', 'fs')"),),
    ),
    "waypoints": Kind(
        WARNING,
        "The rows are far apart, in time and in angle, as waypoints are; the robot would jump.",
        "The rows of '{variable}' come at {rate:g} Hz and are up to {step:.3g} rad apart, the "
        "most before row {row}: they are waypoints, between which the robot jumps.",
        "Join them by straight lines with --resample (this needs their times, saved as t), or in "
        "MATLAB: q = interp1(t, q, (t(1):0.01:t(end))').",
        (("resample", "true", "q = interp1(t, q, (t(1):0.01:t(end))'); fs = 100;"),),
    ),
    "rate_found": Kind(
        INFO,
        "The frame rate was taken from a variable of the file.",
        "{rate:g} rows a second, from '{variable}'.",
    ),
    "rate_of_velocity": Kind(
        WARNING,
        "The frame rate was computed from velocities, as the file does not say it.",
        "The file does not say how many rows make a second; '{variable}' is the derivative of the "
        "positions at {rate:g} rows a second, which was taken.",
        "If the velocities are not in rad/s, say the rate: --rate 100.",
        (("frame_rate", "{rate:g}", "fs = {rate:g}; save('traj.mat', 'q', 'fs')"),),
    ),
    "rate_assumed": Kind(
        WARNING,
        "The frame rate was taken from a variable whose name may mean something else.",
        "{rate:g} rows a second were taken from '{variable}', whose name may mean something else.",
        "If it is right, save it as fs, or use --rate {rate:g}; else say the rate: --rate 100.",
    ),
    "rate_unclear": Kind(
        WARNING,
        "Numbers of the file may say the frame rate, but none does so for certain.",
        "{found} may be a rate or a step, but may as well mean something else; {rate:g} rows a "
        "second were taken.",
        "Save the rate as fs: fs = 100; save('traj.mat', 'q', 'fs'), or use --rate.",
    ),
    "rate_conflict": Kind(
        WARNING,
        "Two variables of the file give different frame rates.",
        "'{variable}' says {rate:g} rows a second, but '{other}' says {other_rate:g}; the first "
        "was taken.",
        "Save only one of them, or use --rate.",
    ),
    "time_unit": Kind(
        WARNING,
        "The unit of a time vector is not known; the likeliest one was taken.",
        "'{variable}' rises by {step} from row to row; that was taken as {what}, which makes "
        "{rate:g} rows a second.",
        "Save the time in seconds, or use --rate.",
    ),
    "time_counts_rows": Kind(
        WARNING,
        "A time vector counts 1, 2, 3 ..., which may be seconds, milliseconds or row numbers.",
        "'{variable}' counts up by one: seconds, milliseconds or the numbers of the rows; "
        "{rate:g} rows a second were taken.",
        "Save the time in seconds, or use --rate.",
    ),
    "time_length": Kind(
        WARNING,
        "A time vector has almost as many elements as there are rows and was not used.",
        "'{variable}' has {size} elements and the trajectory {rows} rows, so it was not used; it "
        "says {rate:g} rows a second.",
        "Save one time for each row, or use --rate {rate:g}.",
    ),
    "time_uneven": Kind(
        WARNING,
        "The samples are not evenly spaced in time; they are played at one rate.",
        "The steps of '{variable}' go from {least:.4g} to {most:.4g} s, the worst one before row "
        "{row}; played evenly at {rate:g} rows a second, a row is up to {deviation:.3g} s away "
        "from its time.",
        "Make the rows even with the option resample (--resample), or in MATLAB with interp1.",
    ),
    "time_rounded": Kind(
        INFO,
        "Times of even rows were rounded when they were written; the rows are even.",
        "The times of '{variable}' were rounded to {rounded:g} s; the rows come evenly, {rate:g} "
        "a second.",
    ),
    "no_times": Kind(
        ERROR,
        "Rows are to be made even, but the file does not say when each of them is reached.",
        "The option resample needs the times of the rows of '{variable}', and the file has none.",
        "Save a time in s for each row, for example 2 s from row to row: {code}",
    ),
    "time_repeated": Kind(
        WARNING,
        "Rows have the same time as the row before.",
        "{count} of '{variable}' have the time of the row before, the first is row {row}; the "
        "rows are played evenly at {rate:g} a second.",
        "Leave these rows out and make the others even with the option resample (--resample).",
    ),
    "time_backward": Kind(
        WARNING,
        "The time goes back.",
        "The time '{variable}' goes back in {count}, the first is row {row}; the rows are played "
        "in their order at {rate:g} a second.",
        "Check whether two recordings were joined; sort the rows in MATLAB, or take one of them "
        "(--variable 'q(1:{last}, :)').",
    ),
    # messages and tables that name their joints
    "joint_names": Kind(
        ERROR,
        "The joints that the file names are not those of the robot.",
        "The joints of '{variable}' are not those of {robot}: {problem}.",
        "Choose the robot that it was made for, or name the columns as the robot does: {joints}. "
        "Of a table, columns can be taken by number as well: --columns 1:6.",
        (("columns", "1:{count}", ""),),
    ),
    "joints_matched": Kind(
        INFO,
        "The columns were put into the robot's order, by the names of its joints.",
        "The columns of '{variable}' were matched to {robot} by the names of its joints: columns "
        "{order} in this order.{left_out}",
    ),
    "resampled": Kind(
        INFO,
        "Points with times of their own became frames at an even rate.",
        "The {points} points of '{variable}' ({duration:g} s) were joined by {how} and became "
        "{frames} frames at {rate:g} Hz.",
        "For another rate: --rate 250.",
    ),
    "bad_message": Kind(
        ERROR,
        "A JointTrajectory contradicts itself.",
        "'{variable}' is a JointTrajectory that cannot be played: {problem}.",
        "Every point needs a position for each joint, and a time_from_start later than that of "
        "the point before it.",
        SAVE_AGAIN,
    ),
    "too_long": Kind(
        ERROR,
        "A trajectory lasts too long for the rate.",
        "'{variable}' lasts {duration:g} s, which is more than {most} frames at {rate:g} Hz.",
        "Check its times for a gap and the time of its last point; {lower:.3g} Hz at most would "
        "fit.",
        (("frame_rate", "{lower:.3g}", ""),),
    ),
    # against the robot
    "joint_limit": Kind(
        ERROR,
        "A joint leaves its range.",
        "{joint} goes to {value:.4g} rad ({degrees:.4g} deg) at frame {frame} ({time:.3f} s); "
        "its range is {lower:.4g} to {upper:.4g} rad; it is outside in {count}.",
        "Plan the motion inside the range, or choose the robot that it was made for.",
        (("", "", "find(q(:, {column}) < {lower:.6g} | q(:, {column}) > {upper:.6g})"),),
    ),
    "velocity_limit": Kind(
        WARNING,
        "A joint moves faster than the robot can.",
        "{joint} moves at {value:.4g} rad/s at frame {frame} ({time:.3f} s); {robot} reaches "
        "{limit:.4g} rad/s; it is too fast in {count}.",
        "Use more samples for the motion, or check that {rate:g} rows a second is right: at "
        "{slower:g} the robot can follow.",
        (("frame_rate", "{slower:g}", "fs = {slower:g}; save('traj.mat', 'q', 'fs')"),),
    ),
    "discontinuity": Kind(
        ERROR,
        "A joint jumps from one sample to the next.",
        "{joint} jumps by {value:.4g} rad between frame {frame} and the next ({time:.3f} s); "
        "{others}.",
        "Look for a piece that is missing or was joined at the wrong place.",
    ),
    "jump_2pi": Kind(
        ERROR,
        "A joint jumps by a full turn, as atan2 makes it.",
        "{joint} jumps by a full turn ({value:.4g} rad) between frame {frame} and the next "
        "({time:.3f} s).",
        "In MATLAB {name} = unwrap({name}), or convert with the option unwrap (--unwrap).",
        (("unwrap", "true", "{name} = unwrap({name});"),),
    ),
    "gripper_range": Kind(
        WARNING,
        "The gripper column is not 0 and 1.",
        "The gripper column goes from {first:g} to {last:g}. {meaning}It was taken as closed "
        "{side} {threshold:g}.",
        "Save 0 for open and 1 for closed. If larger means open: --invert.",
    ),
    "gripper_between": Kind(
        WARNING,
        "The gripper column is not always at one of its two ends; it may be a joint, or a ramp.",
        "{count} of {rows} in the gripper column lie between its ends {first:g} and {last:g}; "
        "the gripper was taken as closed {side} {threshold:g}.",
        "Save 0 for open and 1 for closed, without ramps. If the column is a joint, take the "
        "joints alone (--columns).",
    ),
    "gripper_constant": Kind(
        INFO,
        "The gripper column never changes; the gripper stays open.",
        "The gripper column is {first:g} throughout; the gripper stays open.",
    ),
    "gripper_unmoved": Kind(
        WARNING,
        "The gripper column never changes and is not 0; it may be closed, or be a joint.",
        "The gripper column is {first:g} throughout, which does not say open or closed; the "
        "gripper stays open.",
        "Save 0 for open and 1 for closed. If the column is a joint, choose a robot that has it, "
        "or take the joints alone (--columns).",
    ),
    "gripper_beside": Kind(
        WARNING,
        "A vector that is named as a gripper lies beside the trajectory and was not taken.",
        "'{variable}' ({size}) may be the states of the gripper; it was not taken.",
        "Take it with the option gripper (--gripper {variable:shell}), or save it as the last "
        "column.",
    ),
    "kinematics_agree": Kind(
        INFO,
        "The robot that the file holds is the chosen one, up to its base and its tool.",
        "The robot {found} in the file agrees with {robot} within {distance:.1f} mm.",
    ),
    "kinematics_differ": Kind(
        WARNING,
        "The robot that the file holds is not the chosen one.",
        "The robot {found} in the file is not {robot}: {problem}. The motion may have been made "
        "for another robot, or with other zero positions of the joints.",
        "Choose the robot that the file was made for; or compare the zero positions and the "
        "directions of the joints with those of {robot}.",
    ),
    # what an option did
    "squeezed": Kind(
        INFO,
        "An array of more than two dimensions was taken as one row a sample.",
        "'{variable}' is {size}; it was taken as {taken}, as {line} gives it.",
    ),
    "converted_unit": Kind(
        INFO,
        "The file says that the numbers are degrees; they were converted to radians.",
        "The file gives the unit of '{variable}' as degrees; it was converted to radians.",
    ),
    "option_applied": Kind(
        INFO,
        "A change that was asked for was made.",
        "{what}.",
    ),
}
del INFO, WARNING, ERROR


def finding(code: str, /, **values: Any) -> Diagnostic:
    """Return the finding `code`.

    values: its data, by the names of Diagnostic's fields, and whatever else its texts name.
    """
    kind = KINDS[code]
    words = {"variable": "", "where": "", **values}
    words["name"] = format(_Said(words.get("name", words["variable"])), "matlab")
    words = {k: _Said(v) if isinstance(v, str) else v for k, v in words.items()}
    fixes = values.pop("fixes", None)
    if fixes is None:
        fixes = tuple(Fix(*(text.format(**words) for text in fix)) for fix in kind.fixes)
    message, remedy = kind.message.format(**words), kind.remedy.format(**words)
    given = {name: value for name, value in values.items() if value is not None}
    return Diagnostic(code, kind.severity, message, remedy, given, fixes)


class _Said(str):
    """A text of a file in a sentence: as it is seen, in a line of MATLAB or of a shell."""

    def __format__(self, spec: str) -> str:
        if spec == "matlab":
            return self if MATLAB_PATH.fullmatch(self) else "q"
        return for_shell([self]) if spec == "shell" else visible(self)


def document() -> str:
    """Return the part of docs/diagnostics.md with these codes."""
    lines = ["", "## core/conversion"]
    for code, kind in KINDS.items():
        lines += ["", f"### {code}", "", f"{kind.severity.name}. {kind.meaning}", ""]
        lines += [f"> {kind.message}"]
        if kind.remedy:
            lines += [">", f"> *{kind.remedy}*"]
        for option, value, matlab in kind.fixes:
            ways = [
                f"option `{option}` = `{value}`" if option else "",
                f"`{matlab}`" if matlab else "",
            ]
            lines += ["", f"Fix: {', or '.join(filter(None, ways))}"]
    return re.sub(":(shell|matlab)}", "}", "\n".join(lines) + "\n")
