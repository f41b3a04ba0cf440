"""Diagnostics of a check: findings, conditions of a real controller, verdicts."""

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# Obstacles of a robot: `kind` is a name of engine.Kind in lower case.
MET = (
    "{kind:choice self=its own|robot=the robot|object=the object|surface=the surface} {other}"
    "[ ({other_link})]"
)
WHO = "{link}[, holding {held},]"

# contact and distance
COLLISION = Code(
    "collision",
    f"{WHO} touches {MET} at {{point:position}}, {{value:length}} deep.",
    "{kind:choice self=Bend the arm less there, or use another configuration.|robot=Make one of "
    "the two wait, or give them paths that do not cross.|surface=Raise the path there, or add a "
    "point above it.|object=Lead the path around it, or move it.}[ {advice:problem}.]",
    meaning="A robot touches something. The lab would halt it there.",
)
COLLIDES_AT_START = Code(
    "collides_at_start",
    f"{WHO} touches {MET} in the first frame already, at {{point:position}}, "
    "{value:length} deep.",
    "Begin the motion elsewhere, or move what stands there.[ {advice:problem}.]",
    meaning="A robot touches something where its motion begins.",
)
BEGINS_INSIDE = Code(
    "begins_inside",
    "The arm begins inside the surface {other}.",
    "Correct the first frame, or the place of the robot in the scene.",
    meaning="A robot stands in a surface where its motion begins.",
)
TOO_CLOSE = Code(
    "too_close",
    f"{WHO} comes within {{value:length}} of {MET}.",
    "Keep more distance: a real cell is measured less exactly than this one.[ {advice:problem}.]",
    WARNING,
    meaning="A robot comes near something without touching it.",
)
WAITS_FOREVER = Code(
    "waits_forever",
    "Waits forever: '{wait}' is never met.",
    "Correct the wait, or the motion that it waits for.",
    meaning="A robot of a cell waits for what does not happen.",
)
LEFT_THE_ROOM = Code(
    "left_the_room",
    "{other} left the room and was removed.",
    "Look at what pushed or dropped it.",
    WARNING,
    meaning="An object fell or was pushed out of the room.",
)
# grasps
UNCERTAIN_GRASP = Code(
    "uncertain_grasp",
    "{other} in the gripper: {why:problem}.",
    "Move more gently there, or grasp it nearer to its centre of mass.",
    WARNING,
    meaning="A gripper holds an object, but not well.",
)
LOSES_OBJECT = Code(
    "loses_object",
    "The gripper loses {other}[: {why:problem}].",
    "Grasp it nearer to its centre of mass, move more gently, or take a stronger gripper.",
    meaning="A gripper loses what it holds.",
)
GRASPS_NOTHING = Code(
    "grasps_nothing",
    "The gripper closes on nothing[: {why:problem}].",
    "Close it where an object is; the distances show how far away it was.",
    WARNING,
    meaning="A gripper closes where nothing is.",
)
NOTHING_TO_GRASP = Code(
    "nothing_to_grasp",
    "The gripper closes on nothing: no part is there that it could hold.",
    "Check the motion in a scene that has its parts.",
    INFO,
    meaning="A gripper closes in a room without objects.",
)
BARE_FLANGE = Code(
    "bare_flange",
    "The motion closes a gripper, and {robot} carries none.",
    "Choose the gripper that it is for.",
    INFO,
    meaning="A motion commands a gripper that the robot does not have.",
)
MISSED_HAND_OVER = Code(
    "missed_hand_over",
    "The gripper closes on nothing: {giver} let go of {other} {ago:time} before[: {why:problem}].",
    "For a hand-over of {other}, close it while {giver} still holds it: in a parallel cell, with "
    "'after:' where one is early.",
    WARNING,
    meaning="A gripper closes where another robot let go of an object.",
)
DROPS_OBJECT = Code(
    "drops_object",
    "The gripper lets go of {other} in the air; it falls {value:length}.",
    "Open it where the object stands on something.",
    WARNING,
    meaning="A gripper opens above nothing.",
)
FAILED_HAND_OVER = Code(
    "failed_hand_over",
    "The gripper stays closed on {other} while another robot takes it away[: {why:problem}].",
    "Open the giver's gripper after the taker's has closed, and before either moves on.",
    meaning="Two grippers hold one object and move apart.",
)
PAYLOAD = Code(
    "payload",
    "The robot carries {value:mass} in {other}; it may carry {limit:mass} beside its end "
    "effector.",
    "Take a lighter object, or a robot with more payload.",
    meaning="A robot carries more than it may.",
)
# joints
OUTSIDE_RANGE = Code(
    "outside_range",
    "{joint} is {value:measure} outside its range, {lower:measure} to {upper:measure}.",
    "Keep the joint in its range, or convert the file again for this robot.",
    meaning="A joint leaves its range.",
)
NEAR_JOINT_LIMIT = Code(
    "near_joint_limit",
    "{joint} comes within {value:measure} of the end of its range.",
    "Choose another configuration of the arm, or turn the task about the base.",
    WARNING,
    meaning="A joint has little room left in its range.",
)
OVER_SPEED = Code(
    "over_speed",
    "{joint} moves at {value:measure}; its limit is {limit:measure}.",
    "Make the motion at least {times:number} times as long.",
    meaning="A joint moves faster than it can.",
)
ACCELERATION_LIMIT = Code(
    "acceleration_limit",
    "{joint} accelerates at {value:measure}; its vendor states {limit:measure}.",
    "Plan with a smooth time law, such as a quintic, or give it more time.",
    meaning="A joint accelerates more than its vendor states.",
)
JERK_LIMIT = Code(
    "jerk_limit",
    "{joint} has a jerk of {value:measure}; its vendor states {limit:measure}.",
    "Plan with a smooth time law, such as a quintic, or give it more time.",
    meaning="A joint has more jerk than its vendor states.",
)
MOVES_AT_START = Code(
    "moves_at_start",
    "{joint} begins at {value:measure} instead of at rest.",
    "Begin with speed 0, for example with a quintic time law.",
    meaning="A motion does not begin at rest.",
)
MOVES_AT_END = Code(
    "moves_at_end",
    "{joint} ends at {value:measure} instead of at rest.",
    "Bring the motion to rest, for example with a quintic time law.",
    meaning="A motion does not end at rest.",
)
SPEED_STEP = Code(
    "speed_step",
    "{joint} changes its speed by {value:measure} from one row to the next; its usual changes "
    "stay below {usual:measure}.",
    "Blend the two parts of the motion, or stop between them.",
    meaning="The speed of a joint jumps.",
)
ZIGZAG = Code(
    "zigzag",
    "{joint} turns back at once {count:count time|times}, its speed changes by {value:measure} "
    "from one way to the other.",
    "Smooth the motion, or plan it anew with a smooth time law.",
    meaning="A joint goes to and fro within 50 ms, as no arm can follow.",
)
SMALL_JUMPS = Code(
    "small_jumps",
    "{joint} jumps at {count:count row|rows}, where its speed is off by up to {value:measure} for "
    "one row.",
    "Take the rows out that do not belong there, or smooth the motion.",
    meaning="Single rows move a joint as no row beside them does.",
)
NEAR_SINGULARITY = Code(
    "near_singularity",
    "The arm is nearly singular: its conditioning falls to {value:number} (1 is even, 0 is "
    "singular).",
    "Joint motion is possible there; a straight line of the tool is not. Bend the elbow or the "
    "wrist where the path allows it.",
    WARNING,
    meaning="The conditioning of the Jacobian is small.",
)
# points that the tool shall pass
MISSES_POINT = Code(
    "misses_point",
    "The tool passes point {number:integer} ({point:position}) at a distance of {value:length}; "
    "expected at most {limit:length}.",
    "Correct the path, or allow a larger distance.",
    meaning="The tool does not pass a point.",
)
POINT_OUT_OF_ORDER = Code(
    "point_out_of_order",
    "The tool passes point {number:integer} ({point:position}) before point {before:integer}, "
    "not after it.",
    "Order the points as the tool is to pass them, or change the path.",
    meaning="The tool passes points in another order.",
)
POINT_NOT_NUMBERS = Code(
    "point_not_numbers",
    "{file}, line {line:integer} is '{found:list}'; expected three numbers: x, y, z in m, in the "
    "frame world.",
)
POINT_TOO_FAR = Code(
    "point_too_far",
    "{file}, line {line:integer} is {point:position}; expected a point within {most:length} of "
    "the world's origin.",
)
POINT_COUNT = Code(
    "point_count",
    "{file} holds {count:count point|points}; expected 1 to {most:integer}, one a line: x, y, z "
    "in m.",
)
# how the first conflict of two robots is resolved
WAIT_CLEARS = Code(
    "wait_clears",
    "With a wait of {seconds:time} for {robot}, the two stay apart in the rehearsal.",
    "Add to the member {robot}: 'after: {other}.frame {frame:integer}'.",
    INFO,
)
WAIT_CLEARS_TWO = Code(
    "wait_clears_two",
    "With a wait of {seconds:time} for {robot}, the two stay apart in the rehearsal; others "
    "still touch.",
    "Add to the member {robot}: 'after: {other}.frame {frame:integer}'.",
    INFO,
)
WAIT_NOT_ENOUGH = Code(
    "wait_not_enough",
    "A wait of {seconds:time} for {robot} is the smallest that helps, but not enough with what "
    "the robots hold.",
    "Add to the member {robot}: 'after: {other}.frame {frame:integer}', and change a path.",
    WARNING,
)
NO_WAIT_HELPS = Code(
    "no_wait_helps",
    "No wait at a first frame keeps the two apart: one stands in the other's way.",
    "Change a path, or a place.",
    WARNING,
)
# conditions of a real controller, and the figures that they are judged by
POSITIONS_IN_RANGE = Code(
    "positions_in_range",
    "positions inside their ranges, to within {tolerance:exact} rad",
    severity=INFO,
)
SPEEDS_IN_LIMITS = Code(
    "speeds_in_limits",
    "speeds below their limits, to within {tolerance:share}",
    severity=INFO,
)
ACCELERATIONS_IN_LIMITS = Code(
    "accelerations_in_limits",
    "accelerations below their limits, to within {tolerance:share}",
    severity=INFO,
)
JERKS_IN_LIMITS = Code(
    "jerks_in_limits", "jerks below their limits, to within {tolerance:share}", severity=INFO
)
BEGINS_AT_REST = Code("begins_at_rest", "begins at rest", severity=INFO)
ENDS_AT_REST = Code("ends_at_rest", "ends at rest", severity=INFO)
CONTINUOUS = Code("continuous", "continuous", severity=INFO)
NO_COLLISION = Code("no_collision", "no collision", severity=INFO)
LEAST_ROOM = Code(
    "least_room", "at least {value:measure} of room, {joint} at {time:time}", severity=INFO
)
LARGEST_SHARE = Code(
    "largest_share", "at most {value:share} of the limit, {joint} at {time:time}", severity=INFO
)
LARGEST_OF_JOINT = Code("largest_of_joint", "at most {value:measure}, {joint}", severity=INFO)
LIMITS_NOT_STATED = Code(
    "limits_not_stated",
    "at most {value:measure}, {joint}; the model states no limit[ for {missing:list}]",
    severity=INFO,
)
SPEED_AT_END = Code("speed_at_end", "{value:measure}, {joint}", severity=INFO)
LARGEST_STEP = Code(
    "largest_step",
    "largest change of speed from row to row {value:measure}, {joint} at {time:time}",
    severity=INFO,
)
REFUSED_BY_CONVERSION = Code("refused_by_conversion", "refused by the conversion", severity=INFO)
NO_MOTION_IN_FILE = Code(
    "no_motion_in_file", "no motion could be taken from the file", severity=INFO
)
NOT_REHEARSED = Code("not_rehearsed", "the motion did not go through physics", severity=INFO)
# what a motion went through
IN_EMPTY_ROOM = Code("in_empty_room", "in an empty room with a floor", severity=INFO)
IN_SCENE = Code(
    "in_scene", "in the scene {scene} with {objects:count object|objects}", severity=INFO
)
IN_LAB = Code(
    "in_lab",
    "in the lab as it stood, {objects:count object|objects} and {robots:count robot|robots}",
    severity=INFO,
)
IN_CELL = Code("in_cell", "in a cell of {robots:count robot|robots}", severity=INFO)
# what has changed in a lab since a check
APPEARED = Code("appeared", "{name} has been added", severity=INFO)
DISAPPEARED = Code("disappeared", "{name} is gone", severity=INFO)
OTHER_MODEL = Code(
    "other_model", "{name} is another robot, or has another end effector", severity=INFO
)
MOVED = Code("moved", "{name} has been moved", severity=INFO)
STANDS_ELSEWHERE = Code("stands_elsewhere", "{name} stands elsewhere", severity=INFO)
HELD_BY_ANOTHER = Code("held_by_another", "{name} is held by another robot", severity=INFO)
WAS_LET_GO = Code("was_let_go", "{name} was let go", severity=INFO)
SURFACES_CHANGED = Code("surfaces_changed", "the surfaces of the room have changed", severity=INFO)
# verdicts
CHECK_READY = Code(
    "check_ready",
    "ready: no blocking findings[; {warnings:count warning|warnings}]"
    "[; {unknown:count condition|conditions} not known]",
    severity=INFO,
)
CHECK_NOT_READY = Code(
    "check_not_ready",
    "not ready: {count:count blocking finding|blocking findings}[, the first at {time:time}]: "
    "{first:problem}.",
)
CLAIM = Code(
    "claim",
    "This says what the model shows: nominal kinematics, convex hulls of the links, rigid "
    "bodies, the objects that the scene names, and prescribed joints. It knows no torque, no "
    "controller's own limits, no brakes, no cables, no people, and nothing of how the arm comes "
    "to the first frame. Run it first at low speed with a hand on the stop button.",
    severity=INFO,
)
