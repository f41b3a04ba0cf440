"""Diagnostics of a file to convert, of recordings and of replays."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

ROBOT_NOT_NAMED = Code(
    "robot_not_named",
    "'{file}' does not say which robot it is for.",
    "Name its robot, one of {known:list}.",
)

# recordings
RECORDS = Code("records", "records into {folder}", severity=INFO)
RECORDING_SPLIT = Code("recording_split", "continues in a new file", severity=INFO)
RECORDED = Code("recorded", "{folder} holds {messages:count message|messages}", severity=INFO)
RECORDER_RESTARTED = Code(
    "recorder_restarted",
    "the recorder was restarted before it had received anything",
    severity=WARNING,
)
RECORDING_WITH_GAP = Code(
    "recording_with_gap", "the recording {folder}: {gap:problem}", severity=WARNING
)
RECORDING_LOST = Code(
    "recording_lost", "The recording {folder} ended with the recorder: {why:problem}."
)
RECORDING_ENDED_LATE = Code(
    "recording_ended_late",
    "the recording {folder} was ended while the recorder did not run: it holds "
    "{messages:count message|messages}",
    severity=WARNING,
)

# replays
REPLAYS = Code(
    "replays",
    "replays {duration:time} with {messages:count message|messages}[:{left_out:problems}]",
    severity=INFO,
)
REPLAY_PAUSED = Code("replay_paused", "paused at {position:time}", severity=INFO)
REPLAY_RESUMED = Code("replay_resumed", "continues", severity=INFO)
REPLAY_AT = Code("replay_at", "at {position:time}", severity=INFO)
REPLAY_RATE = Code("replay_rate", "rate {rate:number}", severity=INFO)
REPLAY_LOOPS = Code("replay_loops", "loops", severity=INFO)
REPLAY_ONCE = Code("replay_once", "ends at the end", severity=INFO)
OTHER_JOINTS = Code(
    "other_joints",
    "'{file}' has the joints {joints:list}; expected those of {model}.",
    "Convert the original file again.",
)
