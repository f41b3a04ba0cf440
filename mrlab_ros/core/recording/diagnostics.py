"""Diagnostics of recordings: of the runs of a session, of its bag, and of the recorder."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code, Fix
from mrlab_ros.core.base.foreign_text import for_shell

STOP_LEFT = Code(
    "stop_left",
    "The recorder does not run now; the order to end the recording into {bag} waits for it, and "
    "is carried out as soon as it runs.",
    severity=WARNING,
)

# the runs of a session
SESSION_SUMMARY = Code(
    "session_summary",
    "{duration:duration}, {robots:count robot|robots}, {runs:count run|runs}"
    "[, {completed:integer} completed][, {collisions:count collision|collisions}]",
    severity=INFO,
    meaning="How long a session was, how many robots played how often, and how that ended.",
)
RUN_BEGAN = Code("run_began", "begins {trajectory}", severity=INFO)
RUN_ENDED = Code("run_ended", "{trajectory}: {outcome:problem}", severity=INFO)
RUN_COMPLETED = Code(
    "run_completed",
    "completed[, {rounds:integer} times][ after {halts:count collision|collisions}]",
    severity=INFO,
    meaning="A run came to the end of its trajectory; `rounds` where it looped.",
)
RUN_STOPPED = Code(
    "run_stopped",
    "stopped[ after {halts:count collision|collisions}][ at {position:time} of {length:time}]",
    severity=INFO,
    meaning="A run ended before its trajectory did; the position is that on the trajectory.",
)
RUN_HALTED = Code(
    "run_halted",
    "halted by a collision[ at {position:time} of {length:time}] when the recording ended",
    severity=INFO,
    data=("halts",),
)
RUN_OPEN = Code(
    "run_open",
    "still running[ at {position:time} of {length:time}] when the recording ended",
    severity=INFO,
    data=("halts",),
)
RUN_FOLLOWED = Code("run_followed", "followed {reference} exactly", severity=INFO)
RUN_DEVIATED = Code(
    "run_deviated",
    "up to [{angle:fine_angle}][{distance:length}] from {reference} ({joint} at "
    "{time:duration})[, the tool {tool:length}]",
    severity=INFO,
    meaning="The largest deviation of a joint, and of the tool, from the reference of a run.",
)
# what a robot did in a run
RUN_GRASPED = Code(
    "run_grasped",
    "grasped {object}[, {mass:mass}, friction {friction:number}, needed {friction_needed:number},"
    " {wrist_moment:moment} at the wrist]",
    severity=INFO,
    data=("place", "payload"),
)
RUN_RELEASED = Code(
    "run_released",
    "released {object}[ at {place:position}][, {distance:length} from its programmed place]",
    severity=INFO,
    meaning="Where a released object lies, and how far from where the trajectory would have put "
    "it: `target`.",
    data=("target",),
)
RUN_LOST = Code("run_lost", "lost {object}[ at {place:position}]", severity=WARNING)
RUN_HANDED_OVER = Code("run_handed_over", "handed {object} to {to}", severity=INFO)
RUN_MISSED = Code("run_missed", "closed the gripper on nothing", severity=WARNING)
RUN_HIT = Code("run_hit", "Hit {other} with {link} at row {row:integer}")
# the stops of a guided replay
LOOKED_HERE = Code("looked_here", "{name} pointed here", severity=INFO)
STOP_EVENT = Code("stop_event", "{robot}: {said:problem}", severity=INFO)
TOUR_STOP = Code(
    "tour_stop",
    "Stop {number:integer} of {count:integer}: {events:reasons}",
    severity=INFO,
    meaning="A replay stands at something that happened; `place` is where.",
    data=("place",),
)
TO_STOP = Code("to_stop", "plays on to {at:time}", severity=INFO)
TO_END = Code("to_end", "plays on to the end: no stop follows", severity=INFO)
NO_STOP_BEFORE = Code("no_stop_before", "no stop comes before this place", severity=INFO)
STOPS_AWAITED = Code(
    "stops_awaited",
    "The events of {bag} are still being read.",
    "Try again in a moment.",
    severity=INFO,
)

# gaps of a recording
RECORDING_GAP = Code(
    "recording_gap",
    "{missing:time} are missing from {time:time} on: the recorder was restarted",
    severity=WARNING,
)
RECORDING_GAP_UNKNOWN = Code(
    "recording_gap_unknown",
    "Some time is missing from {time:time} on: the recorder was restarted",
    severity=WARNING,
    meaning="The clock was set back meanwhile, so how long the recorder did not run is not known.",
)

# metadata.yaml
NO_METADATA = Code(
    "no_metadata",
    "{file} is not the metadata of a bag: it has no {field}.",
    "Name the folder of a bag, or repair the bag, which writes the metadata anew.",
)
METADATA_TOO_NEW = Code(
    "metadata_too_new",
    "{file} has version {version}; this lab reads up to {known:integer}.",
    "Use a newer lab.",
)
OTHER_STORAGE = Code(
    "other_storage",
    "{file} names storage {storage}[ with compression {compression}]; expected plain mcap.",
    "Import the bag, which makes a plain one of it.",
)
METADATA_WITHOUT_FILES = Code(
    "metadata_without_files",
    "{file} lists no files.",
    "Repair the bag, which writes the metadata anew.",
)

# what is recorded and replayed
BAD_TOPIC_PATTERN = Code(
    "bad_topic_pattern",
    "'{pattern}' names no topic; expected a name such as /robots or /*/joint_states, in which "
    "* stands for one part and ** for any parts.",
)
BAD_SPLIT_DURATION = Code(
    "bad_split_duration",
    "The files are to be split after {duration:time}; expected 1 s or more, or 0 for never.",
)
BAD_SPLIT_SIZE = Code(
    "bad_split_size",
    "The files are to be split at {size:bytes}; expected 0 or more.",
)
BAD_REPLAY_RATE = Code(
    "bad_replay_rate",
    "The rate is {rate:number}; expected {low:number} to {high:number}, 1 is as recorded.",
)
NOTHING_TO_REPLAY = Code(
    "nothing_to_replay",
    "{path} holds no topic that can be replayed[:{left_out:problems}].",
    "Record the lab's topics.",
)
REPLAY_OVER = Code("replay_over", "the replay is over", severity=INFO)
LEFT_OUT = Code(
    "left_out",
    "left out {topic}: {why:problem}",
    severity=INFO,
    meaning="A topic of a bag that is neither replayed nor imported.",
)

# joints of the bags of others
SEVERAL_MODELS = Code(
    "several_models",
    "The joints of {topic} are those of {models:list}.",
    "Name the robot.",
)
NO_SUCH_JOINTS = Code(
    "no_such_joints",
    "The bag has no joint states of {model}, whose joints are {joints:list}[; it "
    "has:{found:problems}]",
)
JOINTS_OF_TOPIC = Code("joints_of_topic", "{topic}: {joints:list}", severity=INFO)

# what the recorder does now, as why it does not do another thing
RECORDING_RUNS = Code(
    "recording_runs",
    "a recording into {bag} runs; stop it first",
    severity=INFO,
)
REPLAY_RUNS = Code("replay_runs", "{bag} is being replayed; stop that first", severity=INFO)
NO_RECORDING = Code("no_recording", "nothing is recorded; start a recording first", severity=INFO)
NO_REPLAY = Code("no_replay", "nothing is replayed; start a replay first", severity=INFO)
NOTHING_RUNS = Code("nothing_runs", "nothing is recorded or replayed", severity=INFO)


# Ends the recording that runs.
ENDING = (Fix(command="mrlab record --stop"),)


def importing(path: object) -> tuple[Fix, ...]:
    """Return the fix that makes a bag of the lab of another one."""
    return (Fix(command=f"mrlab bag import {for_shell([str(path)])} NEW_FOLDER"),)


def repairing(path: object) -> tuple[Fix, ...]:
    """Return the fix that rewrites a bag."""
    return (Fix(command=f"mrlab bag repair {for_shell([str(path)])}"),)
