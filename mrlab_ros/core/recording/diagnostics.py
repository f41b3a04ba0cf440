"""What is said of recordings: of the runs of a session, of its bag, and of the recorder."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

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
RUN_HIT = Code("run_hit", "hit {other} with {link} at row {row:integer}")
# gaps of a recording
RECORDING_GAP = Code(
    "recording_gap",
    "{missing:time} are missing from {time:time} on: the recorder was restarted",
    severity=WARNING,
)
RECORDING_GAP_UNKNOWN = Code(
    "recording_gap_unknown",
    "some time is missing from {time:time} on: the recorder was restarted",
    severity=WARNING,
    meaning="The clock was set back meanwhile, so how long the recorder did not run is not known.",
)
