"""Diagnostics of a robot's playback: its state, and refusals of commands and goals."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# the state of a playback, and what a command did

LOADED = Code(
    "loaded",
    "loaded {trajectory}: {frames:count frame|frames}, {duration:time}",
    severity=INFO,
    meaning="A trajectory was loaded; the arm stays where it is.",
)
UNLOADED = Code("unloaded", "unloaded", severity=INFO, meaning="The trajectory was unloaded.")
PLAYS = Code("plays", "plays", severity=INFO, meaning="The robot plays its trajectory.")
MOVES_TO_START = Code(
    "moves_to_start",
    "moves to the start",
    severity=INFO,
    meaning="The arm stands elsewhere and moves to where its trajectory begins or goes on; where "
    "play was called, it plays when it arrives.",
)
AT_START = Code(
    "at_start", "at the start", severity=INFO, meaning="A member waits where its run begins."
)
PAUSED = Code("paused", "paused at {position:time}", severity=INFO, meaning="Play goes on there.")
STOPPED = Code("stopped", "stopped", severity=INFO, meaning="The run ended; play starts it over.")
AT_POSITION = Code(
    "at_position", "at {position:time}", severity=INFO, meaning="The clock was put there."
)
RATE_SET = Code(
    "rate_set", "rate {rate:number}", severity=INFO, meaning="The speed of playback was set."
)
LOOPS = Code("loops", "loops", severity=INFO, meaning="It starts over after its end.")
PLAYS_ONCE = Code("plays_once", "plays once", severity=INFO, meaning="It ends at its end.")
CLEAR_AGAIN = Code(
    "clear_again",
    "clear again; play goes on from here",
    severity=INFO,
    meaning="The halt ended: nothing touches the arm any more.",
)
BACK_AT_BEGIN = Code(
    "back_at_begin",
    "back where it began, waits until it is clear",
    severity=INFO,
    meaning="The run was stopped in a halt, which goes on until physics confirms that the arm is "
    "clear.",
)
BACK_AT_HOME = Code(
    "back_at_home",
    "in its home pose, waits until it is clear",
    severity=INFO,
    meaning="The run was stopped again in a halt at its first frame, where the arm touches "
    "something too.",
)
HELD_BY_WAIT = Code(
    "held_by_wait",
    "waits for its system",
    severity=INFO,
    meaning="A member of a system stands where a wait holds it.",
)
PLAYED_TO_END = Code(
    "played_to_end", "played to the end", severity=INFO, meaning="The run ended by itself."
)
PLAYED_BACK = Code(
    "played_back",
    "played back to the start",
    severity=INFO,
    meaning="The run ended by itself; it played backwards.",
)
DRIVEN_BY = Code(
    "driven_by",
    "driven by system {system}",
    severity=INFO,
    meaning="The robot became a member of a system.",
)
RELEASED_BY = Code(
    "released_by",
    "released by system {system}",
    severity=INFO,
    meaning="The robot left its system.",
)
HALTED_BY_CONTACT = Code(
    "halted_by_contact",
    "[the held {held}][{link}] touches {other}",
    severity=INFO,
    meaning="The arm halted: this link, or what its gripper holds, touches something.",
)
PLAYBACK_RESTARTED = Code(
    "playback_restarted",
    "its process was restarted; play goes on from here",
    severity=INFO,
    meaning="The robot stands where it stood when its process ended.",
)
GOAL_LOST = Code(
    "goal_lost",
    "{robot} stands where it was: the goal or the stream of joint commands that it followed ended "
    "with its process.",
    "Send it again.",
    severity=WARNING,
    meaning="What is in no catalogue cannot be brought back after a restart.",
)
TRAJECTORY_LOST = Code(
    "trajectory_lost",
    "{robot} has lost {trajectory}: {why:problem}.",
    "Load it again.",
    severity=WARNING,
    meaning="What a robot had loaded could not be brought back after a restart.",
)
FOLLOWS_COMMANDS = Code(
    "follows_commands",
    "follows joint commands",
    severity=INFO,
    meaning="A stream of joint commands moves the arm.",
)
COMMANDS_ENDED = Code(
    "commands_ended",
    "no joint command comes any more",
    severity=INFO,
    meaning="A stream of joint commands ended; the arm stands.",
)
COMMAND_REFUSED = Code(
    "command_refused",
    "A joint command was refused: {why:problem}",
    meaning="A joint command moves nothing; the same refusal is told once.",
)

# refused commands

OF_ROBOT = Code(
    "of_robot", "{robot}: {why:problem}", meaning="Which robot of several it is said of."
)
NOT_IN_PLACE = Code(
    "not_in_place",
    "The arm does not stand at {position:time} of its trajectory.",
    "Stage it first.",
    meaning="A system starts a member only from its place.",
)
PASSED_ALREADY = Code(
    "passed_already",
    "The robot has passed {until:time} already.",
    "Pause, then seek back.",
    meaning="A robot can be held only at a position that lies ahead.",
)
NOTHING_LOADED = Code(
    "nothing_loaded",
    "The robot cannot move in {state:state}: it has no trajectory.",
    "Load a trajectory first.",
    meaning="The command needs a trajectory.",
)
STILL_TOUCHES = Code(
    "still_touches",
    "The arm still touches something.",
    "Place the robot elsewhere, move what it touches away, or seek back.",
    meaning="A halt cannot end while physics reports a collision.",
)
MEMBER_OF_SYSTEM = Code(
    "member_of_system",
    "The robot[ {robot}] is already a member of system '{system}'.",
    "Dissolve that system first.",
    meaning="A robot is a member of at most one system.",
    commands=("mrlab system dissolve {system}",),
)
NOT_STANDING = Code(
    "not_standing",
    "The robot[ {robot}] is in {state:state}.",
    "Stop it first.",
    meaning="A system takes only robots that stand.",
)
DRIVEN_BY_SYSTEM = Code(
    "driven_by_system",
    "The robot is driven by system '{system}'.",
    "Command the system, or dissolve it to set the robot free.",
    meaning="A member of a system takes commands of that system alone.",
    commands=("mrlab system dissolve {system}",),
)
NOT_DRIVEN_BY = Code(
    "not_driven_by",
    "The robot is not a member of system '{system}'.",
    "Create the system again.",
    meaning="A system commanded a robot that is no member any more.",
)
COMMANDS_IGNORED = Code(
    "commands_ignored",
    "The robot is in {state:state} and ignores the joint commands.",
    "Play goes on with them, and so does a stream that begins again after {silence:time}.",
    meaning="The stream was paused or stopped while it goes on.",
)
ROBOT_GONE = Code(
    "robot_gone",
    "{robot} was removed meanwhile.",
    meaning="The robot left the scene before its command was carried out.",
)
NOT_PLAYED = Code(
    "not_played",
    "{robot} has no playback here; is it still in the scene?",
    meaning="A host of playbacks does not play this robot; one that was just started may soon.",
)

# joint commands and goals

WRONG_JOINT_NAMES = Code(
    "wrong_joint_names",
    "The joint names are not those of the robot[; missing: {missing:list}][; unknown: "
    "{unknown:list}][; repeated: {repeated:list}]; expected each of {expected:list} once, in any "
    "order.",
    meaning="A joint command or a goal does not name the joints of the robot.",
)
WRONG_VALUE_COUNT = Code(
    "wrong_value_count",
    "There are {found:integer} {what:choice positions=positions|velocities=velocities|"
    "accelerations=accelerations}[ at point {point:integer}]; expected {expected:integer}, one "
    "for each joint.",
    meaning="A joint command, or a point of a goal, has too few or too many values.",
)
VALUE_NOT_FINITE = Code(
    "value_not_finite",
    "{joint} has no finite {what:choice positions=position|velocities=velocity|accelerations="
    "acceleration}[ at point {point:integer}]; expected a number.",
    meaning="A joint command or a goal holds NaN or an infinite number.",
)
JOINT_OUT_OF_RANGE = Code(
    "joint_out_of_range",
    "{joint} is {value:angle}[ at point {point:integer}][ at {time:time}, between two points]; "
    "expected {lower:angle} to {upper:angle}.",
    meaning="A joint command or a goal leaves the range of a joint.",
)
COMMAND_TOO_FAST = Code(
    "command_too_fast",
    "The joint command moves {joint} at {value:turn_rate}; expected {limit:turn_rate} at most.",
    meaning="The velocity of a joint command is above the joint's limit.",
)
COMMAND_JUMPS = Code(
    "command_jumps",
    "The joint command jumps: {joint} by {value:angle} in {passed:time}; expected "
    "{limit:turn_rate} at most.",
    "Move there in smaller steps, or pause the stream for {silence:time}.",
    meaning="A set-point is too far from the one before it.",
)
NO_POINTS = Code(
    "no_points",
    "The goal has no points; expected one or more.",
    meaning="A goal without points.",
    page=False,
)
HAS_EFFORTS = Code(
    "has_efforts",
    "The points have efforts, which a position controller cannot follow.",
    "Leave them out.",
    meaning="A goal asks for efforts.",
    page=False,
)
NO_POSITIONS = Code(
    "no_positions",
    "The points have no positions; expected one for each joint.",
    meaning="A goal without positions.",
    page=False,
)
ENDS_MOVING = Code(
    "ends_moving",
    "{joint} has the velocity {value:turn_rate} at the last point; expected 0, as the arm stands "
    "there.",
    meaning="A goal ends in motion.",
    page=False,
)
GOAL_OVER = Code(
    "goal_over",
    "The goal ended {ago:time} ago.",
    "Set header.stamp to a later time, or to 0 to start at once.",
    meaning="All points of a goal lie in the past.",
    page=False,
)
STARTS_ELSEWHERE = Code(
    "starts_elsewhere",
    "{joint} is {value:angle} away from the first point, which is due at once; expected "
    "{limit:angle} at most.",
    "Begin at the arm's joint positions, or give the first point a later time.",
    meaning="A goal's first point has the time 0 and is not where the arm is.",
    page=False,
)
GOAL_TOO_LONG = Code(
    "goal_too_long",
    "The goal ends in {duration:time}; expected {longest:time} at most.",
    meaning="A goal lasts too long.",
    page=False,
)
BAD_FIRST_TIME = Code(
    "bad_first_time",
    "The first point is at {time:time}; expected 0 or later.",
    meaning="A goal begins before its start, or a time of it is not finite.",
    page=False,
)
TIMES_NOT_RISING = Code(
    "times_not_rising",
    "Point {point:integer} is at {before:time} and the next one at {after:time}; expected times "
    "that increase.",
    meaning="The points of a goal are not in order of time; points count from 1.",
    page=False,
)
GOAL_TOO_FAST = Code(
    "goal_too_fast",
    "{joint} moves at {value:turn_rate} at {time:time}; expected {limit:turn_rate} at most.",
    "Give that way more time. The motion begins where the arm is, with the velocity that it has.",
    meaning="A goal asks for more than a joint's velocity limit.",
    page=False,
)
HAS_MULTI_DOF = Code(
    "has_multi_dof",
    "The goal has a {field}; expected none: each joint of the robot has one degree of freedom.",
    meaning="A goal, or a tolerance, for joints with several degrees of freedom.",
    page=False,
)
TOLERANCE_OF_NO_JOINT = Code(
    "tolerance_of_no_joint",
    "A tolerance is for {found}; expected one of {expected:list}.",
    meaning="A tolerance of a goal names no joint of the robot.",
    page=False,
)
TOLERANCE_NO_NUMBER = Code(
    "tolerance_no_number",
    "The tolerance for {joint} is {tolerance:number}; expected a number above 0, or 0 or -1 for "
    "no limit.",
    meaning="A tolerance of a goal is NaN, infinite, or below 0 and not -1.",
    page=False,
)

FOLLOWS_NOTHING = Code(
    "follows_nothing",
    "The robot is {state:state}; expected one that follows a motion.",
    meaning="The course of a robot was asked for, which has none now.",
    page=False,
)
OUTSIDE_COURSE = Code(
    "outside_course",
    "The instant is {away:time} {side:choice before=before the newest change of what the robot "
    "plays|after=after its end}.",
    meaning="The course of a robot was asked for at an instant for which it is not known.",
    page=False,
)

# how a goal ended

GOAL_REACHED = Code(
    "goal_reached",
    "Goal successfully reached!",
    severity=INFO,
    meaning="A goal was reached.",
    page=False,
)
GOAL_FIGURES = Code(
    "goal_figures",
    "After {elapsed:time} of {duration:time}: {joint} is the furthest from the goal, by "
    "{left:fine_angle}; {worst} was the furthest off the path, by {most:fine_angle} at most.",
    severity=INFO,
    meaning="How far a goal came; it follows the reason in the answer of the action.",
    page=False,
)
GOAL_CANCELLED = Code(
    "goal_cancelled",
    "cancelled: the arm holds where it is",
    severity=INFO,
    meaning="The client of a goal cancelled it.",
    page=False,
)
GOAL_REPLACED = Code(
    "goal_replaced",
    "A new goal came; this one was given up.",
    meaning="Another goal was accepted before this one was reached.",
    page=False,
)
OTHER_TRAJECTORY = Code(
    "other_trajectory",
    "Another trajectory was loaded meanwhile.",
    meaning="A goal was given up, as somebody loaded a trajectory.",
    page=False,
)
GOAL_HALTED = Code(
    "goal_halted",
    "The arm halted[: {why:problem}].",
    meaning="A goal ended in a collision halt.",
    page=False,
)
GOAL_STOPPED = Code(
    "goal_stopped",
    "The robot was stopped.",
    meaning="A goal was given up, as somebody stopped it.",
    page=False,
)
OFF_GOAL = Code(
    "off_goal",
    "{joint} is {value:measure} off the goal; expected {limit:measure} at most.",
    meaning="A goal ended outside its goal tolerance.",
    page=False,
)
OFF_PATH = Code(
    "off_path",
    "{joint} is {value:measure} off the path; expected {limit:measure} at most[; the robot is in "
    "{state:state}].",
    meaning="A goal left its path tolerance.",
    page=False,
)
GOAL_LATE = Code(
    "goal_late",
    "The goal was not reached {late:time} after its time[; the robot is in {state:state}].",
    meaning="A goal passed its time tolerance.",
    page=False,
)
