"""Diagnostics of the recorder, of recordings and of replays."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

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
RECORDING_FAILED = Code(
    "recording_failed",
    "{why:problem}; the bag is whole, with {messages:count message|messages}.",
    meaning="A recording ended by itself.",
)
RECORDER_FAULT = Code(
    "recorder_fault",
    "The recorder met an error of its own ({error}).",
    "Please report it with the log of the recorder.",
)

# what is not in a bag
NOT_RECORDED = Code("not_recorded", "not recorded: {why:problem}", severity=WARNING)
SEVERAL_TYPES = Code("several_types", "{topic} has several types ({types:list}).")
NOT_ATTACHED = Code(
    "not_attached",
    "{topic}: what belongs to it is not in the bag: {why:problem}",
    severity=WARNING,
)
PARAMETERS_NOT_ATTACHED = Code(
    "parameters_not_attached",
    "the parameters of {node} are not in the bag: {why:problem}",
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
BAG_TRAJECTORY = Code("bag_trajectory", "{trajectory} of {bag}", severity=INFO)
OTHERS_PUBLISH = Code(
    "others_publish",
    "The replay does not begin: {nodes:list} publish {topics:list}.",
    "Stop what publishes there, or replay on another ROS domain.",
)
REPLAY_BROKE = Code(
    "replay_broke",
    "The bag {path} cannot be read on ({problem}).",
    "Look at what is wrong with it.",
)
