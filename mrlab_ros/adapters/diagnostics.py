"""Diagnostics of files and folders of this machine, and of their readers."""

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
    "[{remedy:choice room=Make room on that disk, or name a folder on another one."
    "|may=Check who may write there, or name another folder.}]",
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
    "'{key}' is there twice, the second time in line {line:integer}[ of {file}].",
    "Write it once.",
    meaning="A mapping in a file holds a key twice.",
)
YAML_ALIAS = Code(
    "yaml_alias",
    "*{alias} in line {line:integer} is an alias, which ROS does not read.",
    "Write the values out.",
    meaning="A ROS parameter file has no aliases.",
)

# readers in the sandbox
READER_SLOW = Code(
    "reader_slow", "Reading {file} takes more than {limit:time}.", "Is it what it should be?"
)
READER_MEMORY = Code("reader_memory", "Reading {file} needs more than {limit:bytes} of memory.")
READER_FAILED = Code(
    "reader_failed",
    "The reader of {file} failed on it (exit status {status:integer})[: {problem}]",
)

# what is compressed
INFLATES_TOO_MUCH = Code("inflates_too_much", "it inflates to more than {limit:bytes}")
COMPRESSED_CUT_SHORT = Code("compressed_cut_short", "its end is missing")
COMPRESSED_DAMAGED = Code("compressed_damaged", "what is compressed is damaged: {problem}")

# folders
FOLDER_HELD = Code(
    "folder_held",
    "Another lab keeps its state in {path}[ (process {pid})].",
    "Stop that one, or name another folder: each lab needs its own.",
    meaning="Two labs in one folder would overwrite each other's scene and trajectories.",
    page=False,
)
FOLDER_OF_ANOTHER = Code(
    "folder_of_another", "{path} belongs to another user; expected a folder of yours."
)
FOLDER_UNUSABLE = Code(
    "folder_unusable",
    "{path} cannot be used: {problem}; expected a folder, or a path where one can be made.",
)
NOT_A_FOLDER = Code("not_a_folder", "{path} is no folder, or a link to one")
OTHERS_WRITE = Code("others_write", "others can write into {path}")
OTHERS_EXCHANGE = Code("others_exchange", "others can exchange what lies in {path}")

# pages in one file
REPORT_NOT_BUILT = Code(
    "report_not_built",
    "The page cannot be written: there is no {path}, which the pages' build makes.",
    "Build the pages: npm ci and npm run build in web/.",
    meaning="The code of the one-file pages is missing from the installation.",
)
NOTHING_TO_SHOW = Code(
    "nothing_to_show",
    "There is no motion to show: {why:problem}.",
    meaning="A file was refused before a matrix was found in it.",
)

# arrays in Python
ARRAY_SHAPE = Code(
    "array_shape",
    "An array of {kind} with the shape {shape:list} is no motion.",
    "Expected a matrix of real numbers, with a row a frame and a column a joint.",
)
ARRAY_RATE = Code(
    "array_rate",
    "fs is {found}, which is no rate.",
    "Expected a number of Hz above 0, or the time of each of the {rows:count row|rows} in s.",
    meaning="The rate that comes with an array cannot be one.",
)
PANDAS_MISSING = Code(
    "pandas_missing",
    "A table needs pandas, which cannot be imported: {problem}.",
    "Install it: python -m pip install pandas.",
    meaning="The lab itself does not need pandas.",
    page=False,
)
RERUN_MISSING = Code(
    "rerun_missing",
    "Files for Rerun need its SDK, which cannot be imported: {problem}.",
    "Install it, some 800 MB: python -m pip install rerun-sdk.",
    meaning="The lab itself does not need Rerun.",
    page=False,
)

# what is set aside
SET_ASIDE = Code("set_aside", "It is now called {file}", severity=INFO)
COPY_KEPT = Code("copy_kept", "A copy is kept as {file}", severity=INFO)
NOT_SET_ASIDE = Code("not_set_aside", "It cannot be set aside: {problem}")
