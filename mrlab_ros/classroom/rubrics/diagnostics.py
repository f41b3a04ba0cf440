"""Diagnostics of a rubric: of its tests, its reader and its linter."""

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code
from mrlab_ros.core.checking.diagnostics import MET, WHO

# contact and distance
NOTHING_TOUCHED = Code("nothing_touched", "Nothing is touched.", severity=INFO)
STARTS_INSIDE = Code(
    "starts_inside",
    "{robot} begins inside the surface {other}[; {more:count more contact|more contacts}].",
)
TOUCHES = Code(
    "touches",
    f"{WHO} touches {MET} at {{time:time}}[; {{more:count more contact|more contacts}}].",
)
NO_DISTANCE = Code("no_distance", "There is no distance[ to {thing}] in what was checked.")
NOTHING_NEAR = Code("nothing_near", "Nothing comes nearer than {value:length}.", severity=INFO)
LEAST_DISTANCE = Code(
    "least_distance",
    f"{WHO}[ of {{robot}}] comes within {{value:length}} of {MET} at {{time:time}}; expected at "
    "least {limit:length}.",
)
# limits of joints
NO_SUCH_LIMIT = Code(
    "no_such_limit",
    "No {of:choice ranges=range|speeds=largest speed|acceleration=acceleration limit|jerk=jerk "
    "limit} is stated for this robot.",
)
LIMIT_USED = Code(
    "limit_used",
    "{joint} uses {value:share} of its {of:choice ranges=range|speeds=largest speed|acceleration="
    "acceleration limit|jerk=jerk limit}; expected at most {limit:share}.",
)
# time
CYCLE_TIME = Code("cycle_time", "The cycle lasts {value:time}; expected at most {limit:time}.")
TOTAL_TIME = Code("total_time", "All lasts {value:time}; expected at most {limit:time}.")
NO_CELL = Code(
    "no_cell",
    "It is one motion; expected a cell in {mode:choice parallel=parallel|sequential=sequential} "
    "mode.",
)
MODE_USED = Code(
    "mode_used",
    "The cell is played in {mode:choice parallel=parallel|sequential=sequential} mode.",
    severity=INFO,
)
OTHER_MODE = Code(
    "other_mode",
    "The cell is played in {found:choice parallel=parallel|sequential=sequential} mode; expected "
    "{mode:choice parallel=parallel|sequential=sequential}.",
)
MEMBER_WAITS_FOREVER = Code(
    "member_waits_forever", "{robot} waits forever: '{wait}' is never met."
)
NO_MOTION_OF = Code(
    "no_motion_of",
    "{robot} has no motion in this file[; those that have: {robots:list}].",
)
# path
PATH_LENGTH = Code(
    "path_length", "The tool's path is {value:length} long; expected at most {limit:length}."
)
TOOL_SPEED = Code("tool_speed", "The tool moves at {value:speed}; expected at most {limit:speed}.")
SMOOTHNESS = Code(
    "smoothness", "The smoothness is {value:number}; expected at least {limit:number}."
)
# ends
TOOL_FROM_PLACE = Code(
    "tool_from_place",
    "The tool {instant:choice start=begins|end=ends} {value:length} away from {place:position}; "
    "expected at most {limit:length}.",
)
AT_REST = Code("at_rest", "It {instant:choice start=begins|end=ends} at rest.", severity=INFO)
NOT_AT_REST = Code(
    "not_at_rest",
    "{joint} {instant:choice start=begins|end=ends} at {value:share} of its largest speed; "
    "expected at most {limit:share}.",
)
JOINT_FROM = Code(
    "joint_from",
    "{joint} {instant:choice start=begins|end=ends} {value:angle} away from {origin:choice "
    "home=home|start=where it began}; expected at most {limit:angle}.",
)
# poses
POSES_PASSED = Code(
    "poses_passed",
    "The tool passes {passed:integer} of {count:count pose|poses}, at most {value:length} away.",
    severity=INFO,
)
POSE_TOO_EARLY = Code(
    "pose_too_early",
    "The tool passes pose {number:integer} ({place:position}) at {time:time}, before the one that "
    "comes first; {passed:integer} of {count:count pose|poses} passed.",
)
POSE_TOO_FAR = Code(
    "pose_too_far",
    "The tool passes pose {number:integer} ({place:position}) at a distance of {value:length} at "
    "{time:time}; expected at most {limit:length}; {passed:integer} of {count:count pose|poses} "
    "passed.",
)
POSE_TURNED = Code(
    "pose_turned",
    "The tool passes pose {number:integer} ({place:position}) turned by {value:angle} at "
    "{time:time}; expected at most {limit:angle}; {passed:integer} of {count:count pose|poses} "
    "passed.",
)
# grasps
NEVER_GRASPED = Code("never_grasped", "{object} is never grasped; the gripper does not close.")
NEVER_GRASPED_CLOSES = Code(
    "never_grasped_closes",
    "{object} is never grasped; the gripper closes at {time:time}.",
)
NEVER_GRASPED_OTHER = Code(
    "never_grasped_other", "{object} is never grasped; {other} is, at {time:time}."
)
NEVER_GRASPED_NOTHING = Code(
    "never_grasped_nothing",
    "{object} is never grasped; the gripper closes on nothing at {time:time}[: {why:problem}].",
)
GRASPED = Code(
    "grasped",
    "{robot} grasps {object} at {value:time}[; expected after {since:time}][; expected before "
    "{until:time}].",
)
HELD_FOR = Code("held_for", "{object} is held for {value:time}; expected {limit:time}.")
GRASPED_LATE = Code(
    "grasped_late", "{object} is grasped at {value:time}; expected before {limit:time}."
)
HELD = Code("held", "{object} is held from {since:time} to {until:time}.", severity=INFO)
NOT_HELD = Code(
    "not_held",
    "{object} is not held at {time:time}; expected from {since:time} to {until:time}.",
)
STILL_HELD = Code("still_held", "{object} is still held by {robot} at the end.")
NOT_IN_THE_ROOM = Code("not_in_the_room", "{object} is not in the room any more at the end.")
STILL_MOVES = Code("still_moves", "{object} still moves at {value:speed} at the end.")
NO_OBJECT_CHECKED = Code("no_object_checked", "There is no {object} in what was checked.")
LIES_FROM_PLACE = Code(
    "lies_from_place",
    "{object} lies {value:length} away from {place:position}; expected at most {limit:length}.",
)
LIES_FROM_OBJECT = Code(
    "lies_from_object",
    "{object} lies {value:length} away from {other}; expected at most {limit:length}.",
)
LIES_IN_PLACE = Code(
    "lies_in_place",
    "{object} lies {side:choice in=in|on=on} {other}.",
    severity=INFO,
)
LIES_ELSEWHERE = Code(
    "lies_elsewhere",
    "{object} lies at {point:position}, not {side:choice in=in|on=on} {other}.",
)
# reference
NO_REFERENCE_MOTION = Code("no_reference_motion", "There is no reference motion to compare with.")
NO_REFERENCE_OF_MODEL = Code(
    "no_reference_of_model", "The reference has no motion of a {model} to compare with."
)
FROM_REFERENCE = Code(
    "from_reference",
    "{what:choice tool=The tool|joint=A joint} is {how:choice rms=on average (RMS)|most=at most} "
    "{value:measure} away from the reference; expected at most {limit:measure}.",
)
NO_MOTION_TO_MARK = Code("no_motion_to_mark", "There is no motion to mark.")
# quantities and sentences, as a rubric has them
QUANTITY = Code(
    "quantity",
    "{quantity:choice length=a length|angle=an angle|time=a time|speed=a speed|share=a percentage"
    "|number=a number}, such as {example}[ (units: {units:list})]",
    severity=INFO,
)
NOT_A_NUMBER = Code(
    "not_a_number", "'{text}' is no number[; write {better}]; expected {expected:problem}."
)
OTHER_UNIT = Code("other_unit", "'{text}' has the unit '{given}'; expected {expected:problem}.")
NO_UNIT = Code("no_unit", "'{text}' has no unit; expected {expected:problem}.")
BEYOND_MOST = Code(
    "beyond_most", "'{text}' is beyond {limit:measure}; expected {expected:problem}."
)
NEGATIVE = Code("negative", "'{text}' is negative; expected {expected:problem}.")
TIMES_SWAPPED = Code(
    "times_swapped", "{first:time} is not before {last:time}; expected the earlier one first."
)
NOT_A_PLACE = Code(
    "not_a_place", "The place is {text}; expected [[x, y]] or [[x, y, z]] in m, in world."
)
UNKNOWN_SENTENCE = Code(
    "unknown_sentence",
    "'{text}' is nothing that a rubric can measure; did you mean {close:either}?",
    "docs/rubrics.md has all that can be measured.",
)
# the rubric's file
RUBRIC_TEST = Code("rubric_test", "{file}[:{line:integer}]: test '{test}'", severity=INFO)
RUBRIC_ENTRY = Code(
    "rubric_entry", "{file}[:{line:integer}]: test {number:integer}", severity=INFO
)
TEST_POSE = Code("test_pose", "{place:problem}: pose {number:integer}", severity=INFO)
TEST_COUNT = Code(
    "test_count",
    "tests has {count:count entry|entries}; expected 1 to {most:integer}.",
)
HANDED_IN_ON_TIME = Code("handed_in_on_time", "Handed in on time.", severity=INFO)
HANDED_IN_LATE = Code(
    "handed_in_late",
    "Handed in {days:count day|days} late: {share:share} of the points are taken.",
    severity=WARNING,
)
BAD_DUE = Code("bad_due", "There is no such instant as {text}.")
BAD_CLOSEST = Code(
    "bad_closest", "closest is {text}; expected 0 to {limit:length}, as far as is measured."
)
SAME_TEST_NAME = Code(
    "same_test_name",
    "The name '{test}' is that of the test in line {line:integer}, too; give each test a name of "
    "its own.",
)
REQUIRES_UNKNOWN = Code(
    "requires_unknown",
    "It requires '{test}', which is no other test of the rubric[; there are {known:list}]"
    "[. Did you mean {close:either}?].",
)
REQUIRES_CIRCLE = Code(
    "requires_circle",
    "It requires itself, by way of {tests:list}; no test of these can be passed.",
)
UNKNOWN_PARTIAL = Code(
    "unknown_partial",
    "partial is '{rule}'; '{sentence}' knows {rules:list}.",
)
NO_PARTIAL = Code(
    "no_partial",
    "partial is '{rule}'; '{sentence}' knows no partial points; leave it out.",
)
READS_NO_POSES = Code(
    "reads_no_poses", "'{sentence}' reads no poses; write 'passes within 5 mm of poses'."
)
POSE_COUNT = Code(
    "pose_count",
    "poses has {count:count entry|entries}; expected 1 to {most:integer}, such as [[0.4, -0.3, "
    "0.2]], m in world.",
)
BAD_POSE = Code(
    "bad_pose",
    "{place:problem} is {found}; expected [[x, y, z]] in m, or position: [[x, y, z]] with "
    "rpy_deg: [[roll, pitch, yaw]].",
)
TURNED_TWICE = Code("turned_twice", "Both rpy_deg and orientation are given; write one of them.")
# flaws
OBJECT_NOT_IN_SCENE = Code(
    "object_not_in_scene",
    "The scene has no object '{object}'[; it has: {known:list}].",
    "[Did you mean {close}?]",
)
THING_NOT_IN_SCENE = Code(
    "thing_not_in_scene",
    "The scene has nothing called '{thing}'; it has: {known:list}.",
    "[Did you mean {close}?]",
)
OBJECT_IS_FIXED = Code(
    "object_is_fixed",
    "'{object}' is fixed, so nothing can grasp it; name an object that moves.",
)
PARTIAL_GIVES_NOTHING = Code(
    "partial_gives_nothing",
    "'partial: until' with {until:measure} gives no part of the points: it must lie {side:choice "
    "below=below|above=above} the limit of {limit:measure}.",
)
LIMIT_NOT_STATED = Code(
    "limit_not_stated",
    "{model} states no {of:choice acceleration=acceleration|jerk=jerk} limit of {joints:list}, "
    "so it cannot be measured.",
    "Measure speeds, or state it in its robot.yaml.",
)
SELF_DISTANCE = Code(
    "self_distance",
    "The distance of a robot to itself is not measured; use 'no collision'.",
)
BEYOND_MEASURE = Code(
    "beyond_measure",
    "Distances are measured up to {most:length}, so {limit:length} cannot be distinguished from "
    "more; take less.",
)
OUT_OF_REACH = Code(
    "out_of_reach",
    "{place:position} is out of reach: the tool comes within {value:length} of it, not within "
    "{limit:length}.",
)
POSE_OUT_OF_REACH = Code(
    "pose_out_of_reach",
    "Pose {number:integer} ({place:position}) is out of reach: the tool comes within "
    "{value:length} of it, not within {limit:length}.",
)
NO_TOOL_TO_GRASP = Code(
    "no_tool_to_grasp",
    "There is no tool to grasp with on {robots:list}; add tool: parallel_gripper to the rubric.",
)
NO_REFERENCE_NAMED = Code(
    "no_reference_named",
    "The rubric names no reference to compare with; add reference: solution.mat",
)
REFERENCE_WITHIN_NOTHING = Code(
    "reference_within_nothing",
    "No motion is within 0 of another; take 1 mm or 1 deg, or more.",
)
LIES_ON_ITSELF = Code("lies_on_itself", "'{object}' cannot lie {side:choice in=in|on=on} itself.")
NO_POSES = Code("no_poses", "It names no poses; add poses: [[[[0.4, 0.2, 0.3]]]], m in world.")
ONE_POSE_EACH = Code(
    "one_pose_each", "'partial: each' gives no part of the points: there is one pose."
)
WITHIN_NOTHING = Code(
    "within_nothing", "Within 0 mm no motion passes anything; take 1 mm or more."
)
POSE_NOT_TURNED = Code(
    "pose_not_turned",
    "An angle is asked for, and pose {number:integer} has no orientation; add rpy_deg: [[180, 0, "
    "0]] to its position, or leave the angle out.",
)
MODE_OF_ONE_MOTION = Code(
    "mode_of_one_motion",
    "The reference is one motion, which has no mode; name a cell (.yaml).",
)
HIDDEN_WITHOUT_HINT = Code(
    "hidden_without_hint",
    "It is hidden and has no hint, so a student learns nothing from it; add hint:",
    severity=WARNING,
)
FALLS = Code(
    "falls",
    "{object} falls by {value:length} when it is let go; expected at most {limit:length}.",
)
STANDS_STILL = Code("stands_still", "{robot} does not move.")
REQUIRED_LOST = Code("required_lost", "The test '{test}' is not passed, which this one requires.")
REQUIRED_HIDDEN_LOST = Code(
    "required_hidden_lost", "Another test is not passed, which this one requires."
)
CAPPED = Code("capped", "{found:problem}; therefore the whole earns at most {most:number} points.")
READY_FOR_ROBOT = Code("ready_for_robot", "The check has no blocking finding.")
NOT_READY_FOR_ROBOT = Code("not_ready_for_robot", "The check blocks it: {why:problem}.")
NO_REFERENCE = Code(
    "no_reference",
    "It names no reference solution, so nothing shows that full marks can be had; add reference: "
    "solution.mat",
    severity=WARNING,
)
ALL_HIDDEN = Code("all_hidden", "Every test is hidden; students see none of it.", severity=WARNING)
EARNED_STANDING = Code(
    "earned_standing",
    "A motion that stands still earns {points:number} of {of:number} points here.",
    "Let this test require one that needs work.",
    WARNING,
)
LOST_BY_NONE = Code(
    "lost_by_none",
    "The reference, reversed or cut short, and even standing still, loses nothing here.",
    "Choose a narrower limit.",
    WARNING,
)
NEVER_HELD = Code(
    "never_held", "No motion keeps to {limit:number}[ {unit}]; choose a limit that can be held."
)
NEVER_LOST = Code(
    "never_lost", "Every motion keeps to {limit:number}[ {unit}]; choose a limit that can be lost."
)
NO_SHARE_OF_LIMITS = Code(
    "no_share_of_limits",
    "{value:share} of a limit is no bound; choose a share above 0% and up to 100%.",
)
REFERENCE_LOSES = Code(
    "reference_loses",
    "The reference loses {lost:number} of {of:number} points: {why:problem}.",
)
