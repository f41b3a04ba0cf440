"""Diagnostics of a robot system: its state, and refusals of commands, cells and waits."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# the state of a system, and what a command did

SYSTEM_CREATED = Code(
    "system_created",
    "{system} drives {robots:list}: {duration:time}, {mode:choice parallel=parallel|"
    "sequential=sequential}",
    severity=INFO,
    meaning="A robot system was created.",
)
DISSOLVED = Code(
    "dissolved", "{system} is dissolved", severity=INFO, meaning="Its robots are independent."
)
MODE_SET = Code(
    "mode_set",
    "{mode:choice parallel=parallel|sequential=sequential}, {duration:time}",
    severity=INFO,
    meaning="How the members of a system share its timeline was set.",
)
STAGES = Code(
    "stages",
    "moves its members to their places[ for {duration:time}], then plays",
    severity=INFO,
    meaning="A system plays once every member stands in its place.",
)
PAUSED_WITHOUT = Code(
    "paused_without",
    "paused at {position:time}; {robots:list} did not answer",
    severity=WARNING,
    meaning="A system was paused; members that do not answer are lost until they do.",
)
MEMBER_COLLIDED = Code(
    "member_collided",
    "{robot} collided",
    severity=INFO,
    meaning="A collision of one member halted all.",
)
OTHERS_GO_ON = Code(
    "others_go_on",
    "{robot} collided; the others go on",
    severity=INFO,
    meaning="A collision halted one member alone.",
)
STILL_COLLIDES = Code(
    "still_collides",
    "{robot} still collides",
    severity=INFO,
    meaning="A member came back after a restart and is in a halt.",
)
MEMBER_LOST = Code(
    "member_lost",
    "{robot} lost its playback; play goes on from here",
    severity=WARNING,
    meaning="A member has no trajectory any more or obeys another system; all stand.",
)
MEMBER_LOST_AT_END = Code(
    "member_lost_at_end",
    "{robot} lost its playback; play again to start over",
    severity=WARNING,
    meaning="A member was lost when the run had ended.",
)
MEMBERS_SILENT = Code(
    "members_silent",
    "[{robots:list} did not answer; ]play goes on from here",
    severity=WARNING,
    meaning="Members did not answer an order; all stand, and they are lost until they answer.",
)
PROCESS_DIED = Code(
    "process_died",
    "{process} died ({how:problem}) with {robots:list}; all stand at {position:time}",
    severity=WARNING,
    meaning="The process that plays members of a system ended; the system stands where they did.",
)
PROCESS_FROZE = Code(
    "process_froze",
    "{process} does not run, and with it {robots:list}; all stand at {position:time}",
    severity=WARNING,
    meaning="A signal stopped the process that plays members of a system.",
    data=("how",),
)
MEMBERS_BACK = Code(
    "members_back",
    "{robots:list} came back; play goes on from {position:time}",
    severity=INFO,
    meaning="All members are there again after the process that plays them ended or froze.",
)
MAY_STILL_MOVE = Code(
    "may_still_move",
    "{why:problem}; {robots:list} did not answer and may still move",
    severity=WARNING,
    meaning="Members did not answer when they were to stop; they are asked again.",
)
ALL_STAND = Code(
    "all_stand",
    "all members stand; play starts over",
    severity=INFO,
    meaning="All members were reached and stand.",
)
LATE_AT_START = Code(
    "late_at_start",
    "{robots:list} did not arrive at the start in time",
    severity=WARNING,
    meaning="A staging took too long; all members stand.",
)
COORDINATOR_RESTARTED = Code(
    "coordinator_restarted",
    "the coordinator was restarted; play goes on from here",
    severity=INFO,
    meaning="The system stands where it stood when the coordinator ended.",
)
SYSTEM_LOST = Code(
    "system_lost",
    "The system {system} was lost: its entry in the journal is damaged.",
    "Create it again.",
    severity=WARNING,
    meaning="A system could not be brought back after a restart.",
)

# what a refused command needs first

REACH_MEMBERS_FIRST = Code(
    "reach_members_first",
    "wait until all members were reached, or dissolve the system",
    severity=INFO,
    meaning="Needed before a command of a system that is STOPPING.",
)
PAUSE_FIRST = Code("pause_first", "pause first", severity=INFO, meaning="Needed before a step.")
STOP_FIRST = Code(
    "stop_first", "stop first", severity=INFO, meaning="Needed before the mode changes."
)
STOP_AND_CLEAR_FIRST = Code(
    "stop_and_clear_first",
    "stop it, which takes its arms back to where they began, then play once all are clear",
    severity=INFO,
    meaning="Needed before a system in a halt plays.",
)
CLEAR_AND_STOP_FIRST = Code(
    "clear_and_stop_first",
    "wait until all members are clear, then stop",
    severity=INFO,
    meaning="Needed before the mode of a system in a halt changes.",
)

# refused commands

NO_SYSTEM = Code(
    "no_system",
    "There is no system '{system}'[; there are: {known:list}].",
    "[Did you mean '{close}'?]",
    meaning="A system was named that does not exist.",
)
SYSTEM_GONE = Code(
    "system_gone",
    "The system {system} is dissolved.",
    meaning="A command came while its system was dissolved.",
)
NO_MEMBERS = Code(
    "no_members",
    "A system needs at least one member.",
    "Name the robots that it drives.",
    meaning="A system without members.",
)
ROBOT_REPEATED = Code(
    "robot_repeated",
    "'{robot}' is named {count:integer} times.",
    "Name it once.",
    meaning="A robot is a member of a system once.",
)
NO_TRAJECTORY_LOADED = Code(
    "no_trajectory_loaded",
    "{robot} has no trajectory.",
    "Load one, or name one for the system.",
    meaning="A member of a system needs a trajectory.",
)
MEMBERS_MOVE_TO_PLACES = Code(
    "members_move_to_places",
    "The members move to their places.",
    "Pause, then change the direction and play.",
    meaning="The direction cannot change while a system is staged.",
)
NOT_TAKEN_BACK = Code(
    "not_taken_back",
    "{why:problem}. What was changed could not be taken back: {error:problem}.",
    "Load {robots:list} again.",
    meaning="A system was refused after robots had loaded other trajectories for it.",
)
BAD_MODE = Code(
    "bad_mode",
    "The mode {mode:integer} is unknown; expected 0 (parallel) or 1 (sequential).",
    meaning="mrlab_msgs/RobotSystem has the modes.",
)
BAD_POLICY = Code(
    "bad_policy",
    "The policy {policy:integer} is unknown; expected 0 (halt all) or 1 (halt member).",
    meaning="mrlab_msgs/RobotSystem has the policies.",
)
BAD_COMMAND = Code(
    "bad_command",
    "The command {command:integer} is unknown; expected one of mrlab_msgs/DriveOrder.",
    meaning="An order to a member that is none.",
)
NO_STATE_OF_ROBOT = Code(
    "no_state_of_robot",
    "Nothing publishes the playback state of {robot}; its playback may not run.",
    meaning="A robot was to become a member, and its playback is not found.",
)
PLAYBACK_SILENT = Code(
    "playback_silent",
    "The playback of {robots:list} did not answer within {timeout:time}.",
    "Try again.",
    meaning="An order was sent to a host of playbacks that did not answer.",
    commands=("mrlab status",),
)

# waits and the timeline

BAD_WAIT = Code(
    "bad_wait",
    "'{wait}' is no wait; expected 'frame 0: after kr6_1.frame 120', 'frame 200: object cube_1 "
    "held by ur5e_1' or 'frame 310: object cube_1 free'.",
    meaning="The text of a wait does not follow its grammar.",
)
BAD_DWELL = Code(
    "bad_dwell",
    "The dwell is {dwell:time}; expected 0 to {longest:time}.",
    meaning="The pause of a member before the next one begins.",
)
WAIT_BEYOND_END = Code(
    "wait_beyond_end",
    "{robot} waits at frame {frame:integer}; its trajectory has the frames 0 to "
    "{last_frame:integer}.",
    meaning="A wait names a frame that the trajectory does not have.",
)
WAIT_FOR_STRANGER = Code(
    "wait_for_stranger",
    "'{wait}' names {robot}; expected a member of the system: {members:list}.",
    meaning="A member can wait for another member only.",
)
WAIT_FOR_ITSELF = Code(
    "wait_for_itself",
    "{robot} waits for itself: '{wait}'.",
    "Name another member.",
    meaning="A member waits for a frame of its own.",
)
WAITING_CIRCLE = Code(
    "waiting_circle",
    "The members would wait for each other without end:{steps:problems}",
    "Leave one of these waits out.",
    meaning="Waits that can never be met.",
)
WAITS_AT = Code(
    "waits_at", "{robot} waits at {wait}", severity=INFO, meaning="A step of a circle of waits."
)
ENDS_FIRST = Code(
    "ends_first",
    "{robot} has to end first",
    severity=INFO,
    meaning="A step of a circle of waits: in sequential mode one member begins after another.",
)
MEMBER_PLACE = Code(
    "member_place",
    "{place:problem}, member {robot}",
    severity=INFO,
    meaning="A member of a system in a file.",
)
NO_MEMBERS_IN_FILE = Code(
    "no_members_in_file",
    "members is empty; expected a list of at least one robot",
    meaning="A system of a file without members.",
)
ENDLESS_HOLD = Code(
    "endless_hold",
    "nothing says until when it holds frame {frame:integer}; add wait, such as 'object cube_1 "
    "free', or after, such as 'kr6_1.frame 120'",
    meaning="A hold of a member in a file needs a condition.",
)
