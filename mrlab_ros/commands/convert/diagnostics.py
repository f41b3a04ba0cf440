"""Diagnostics of the options of `mrlab convert`, and of other commands that take a file."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

LIMIT_OUT_OF_RANGE = Code(
    "limit_out_of_range",
    "--{option} is {value:number}; expected {least:number} to {most:number} {unit}.",
    "Leave it out for the usual limit.",
)
FILES_OR_TOPIC = Code(
    "files_or_topic",
    "Expected files or --topic.",
    "For example: mrlab convert run.mat --robot ur5e.",
)
FOLDER_WITHOUT_FILES = Code(
    "folder_without_files",
    "The folder '{folder}' holds no {suffixes:either} file.",
    "Give the folder with the workspaces.",
)
WOULD_REPLACE_INPUT = Code(
    "would_replace_input",
    "'{file}' would be written and is read as well.",
    "Give another folder with --out.",
)
TARGET_THERE = Code(
    "target_there",
    "'{file}'[ and {more:integer} more] is there already, and nothing was written.",
    "Give another folder, or replace what is there with --force.",
)
ONE_PICTURE = Code(
    "one_picture",
    "--plot '{file}' is one picture, and there are {count:integer} files.",
    "Give a folder.",
)
FOLDER_NOT_WRITABLE = Code(
    "folder_not_writable",
    "--{option} '{folder}' cannot be written ({error}).",
    "Give a folder that you may write to.",
)
NOT_WRITTEN = Code(
    "not_written",
    "not written[ ({times:integer} times)]: {error}[ '{file}'].",
    "[{remedy:choice room=Make room on that disk, or name a folder on another one."
    "|may=Check who may write there, or name another folder.}]",
)
NOT_A_TOPIC = Code("not_a_topic", "'{topic}' cannot be a topic: {why:problem}.")
NO_PUBLISHER = Code(
    "no_publisher",
    "Nobody publishes on {topic} of ROS domain {domain:integer} within {timeout:time}[; "
    "{expected} is on {others:list}].",
    "Name the topic as its publisher does, and the ROS domain.",
)
OTHER_TYPE = Code(
    "topic_of_other_type",
    "{topic} carries {found:list}; expected {expected}.",
    "Name a topic of that type.",
)
NO_MESSAGE = Code(
    "no_message_came",
    "{topic} has a publisher, but no message came within {timeout:time}.",
    "Publish while this waits, or wait longer with --timeout.",
)
