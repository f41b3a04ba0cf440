"""What is said of the files that the adapters read and write."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, Code

FILE_MISSING = Code(
    "file_missing",
    "There is no file {file}.",
    "[Did you mean '{close}'?]",
    meaning="A file that was named does not exist.",
)
NOT_A_FILE = Code(
    "not_a_file",
    "{file} cannot be read: it is {what:choice folder=a folder|special=no regular file}.",
    meaning="Something else than a file stands where a file was expected.",
)
FILE_UNREADABLE = Code(
    "file_unreadable",
    "{file} cannot be read: {why:problem}.",
    meaning="The operating system refuses to read a file, or its content is none.",
)
FILE_UNWRITABLE = Code(
    "file_unwritable",
    "{file} cannot be written: {why:problem}.",
    meaning="The operating system refuses to write a file.",
)
NO_ROOM_ON_DISK = Code(
    "no_room_on_disk",
    "{folder} cannot be written ({why:problem}), so nothing was changed.",
    "Make room there, then try again.",
    meaning="The disk is full; a change that could not be kept is not made.",
)
NOT_OF_FORMAT = Code(
    "not_of_format",
    "{file}[:{line:integer}] is not {format}: {why:problem}.",
    meaning="The content of a file is not YAML or JSON.",
)
NOT_UTF8 = Code(
    "not_utf8",
    "{file} is no text in UTF-8.",
    "Save it as UTF-8.",
    meaning="A text file has another encoding.",
)
YAML_MAPPING = Code(
    "yaml_mapping", "a YAML mapping", severity=INFO, meaning="A mapping of names to values."
)
KEY_TWICE = Code(
    "key_twice",
    "[{file}:]line {line:integer}: '{key}' is there twice.",
    "Write it once.",
    meaning="A mapping in a file holds a key twice.",
)
YAML_ALIAS = Code(
    "yaml_alias",
    "line {line:integer}: *{alias} is an alias, which ROS does not read.",
    "Write the values out.",
    meaning="A ROS parameter file has no aliases.",
)
