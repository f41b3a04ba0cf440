"""What `mrlab class` refuses and reports."""

from mrlab_ros.core.base.diagnostic import INFO, Code

OPTION_OUT_OF_RANGE = Code(
    "option_out_of_range",
    "--{option} is {value:number}; expected {least:number} to {most:number}.",
)
NO_SUBMISSIONS = Code(
    "no_submissions",
    "{file} holds no submission; expected an export of Moodle, ILIAS, Canvas or Gradescope, or a "
    "folder or file for each student.",
)
REFERENCE_IS_CELL = Code(
    "reference_is_cell",
    "{rubric}: the reference {file} is a cell; a class is compared with one motion.",
    "Leave reference out, or name a file with one motion.",
)
REFERENCE_NOT_READ = Code(
    "reference_not_read", "{rubric}: the reference {file} cannot be read: {why:problem}."
)
PROCESSES_KILLED = Code(
    "processes_killed",
    "Processes that check were killed {count:integer} times; the memory may not suffice.",
    "What is done is kept: give fewer --jobs and run the same command again.",
)
STOPPED = Code(
    "stopped_class",
    "Stopped with {done:integer} of {all:integer} checked; they are kept.",
    "Run the same command to go on.",
    INFO,
)
WORKSHEET_FAILED = Code(
    "worksheet_failed", "{file} cannot be read or {out} written: {why:problem}."
)
WORKSHEET_WRITTEN = Code(
    "worksheet_written", "The worksheet with the grades is {file}.", severity=INFO
)
KEY_TABLE_NOT_READ = Code(
    "key_table_not_read",
    "The key table {file} cannot be read ({why:problem}); without it the pseudonyms would change.",
    "Mend it, or move it away to get new ones.",
)
KEY_TABLE_NOT_WRITTEN = Code(
    "key_table_not_written", "The key table {file} cannot be written: {why:problem}."
)
GRADER_NOT_STARTED = Code("grader_not_started", "The process that checks did not start.")
NO_ROBOT_IN_RUBRIC = Code(
    "no_robot_in_rubric",
    "'{file}' does not say which robot it is for; name one in the rubric: robot: ur5e",
)
NO_FILE = Code("no_file", "There is no file.")
