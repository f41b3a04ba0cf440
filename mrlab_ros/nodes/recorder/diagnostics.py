"""Diagnostics of the recorder, of recordings and of replays."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# recordings
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
