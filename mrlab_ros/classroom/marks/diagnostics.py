"""Diagnostics of the submissions of a class."""

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# files that belong to nobody, and what a teacher is to know of a submission
NO_MOTION_FILE = Code(
    "no_motion_file", "This is no file that may hold a motion.", severity=WARNING
)
NOT_NAMED_AS_BY = Code(
    "not_named_as_by", "It is not named as {form} names files.", severity=WARNING
)
SENDER_NOT_NAMED = Code(
    "sender_not_named", "{file} does not name who sent {folder}.", severity=WARNING
)
TEXT_NOT_READ = Code(
    "text_not_read", "There is an online text too, which is not read.", severity=INFO
)
NONE_NAMED_SO = Code("none_named_so", "No file is named {pattern}.", severity=WARNING)
NEWEST_TAKEN = Code(
    "newest_taken",
    "Of {count:count file|files}[, those named {pattern},] the newest that holds a motion is taken"
    "[: {files:list}].",
    severity=INFO,
)
# why a submission has no marks
NO_FILE_HANDED_IN = Code(
    "no_file_handed_in",
    "No file that may hold a motion was handed in[; there is {files:list}].",
)
SUBMISSION_OUT_OF_MEMORY = Code(
    "submission_out_of_memory",
    "The check needs more than {limit:bytes} of memory; the motion may be very long.",
)
SUBMISSION_FAILED = Code("submission_failed", "The check failed on it ({error}).")
SUBMISSION_GIVEN_UP = Code("submission_given_up", "The check was given up after {limit:duration}.")
SUBMISSION_ENDED = Code(
    "submission_ended",
    "The check was ended: it took more than {limit:duration} of a processor, or the machine had "
    "no memory left.",
)
SUBMISSION_CRASHED = Code(
    "submission_crashed",
    "The check crashed on it ({why:problem}); the file is the reason, no other.",
)
# the gradebook
NO_WORKSHEET = Code(
    "no_worksheet",
    "{file} has {count:count column|columns}[: {columns:list}]; expected Identifier "
    "and Grade, as Moodle's grading worksheet has them.",
)
MAXIMUM_DIFFERS = Code(
    "maximum_differs",
    "Moodle's maximum is {found}, the rubric has {points:number} points; the points are written "
    "as they are.",
    severity=WARNING,
)
NOT_IN_WORKSHEET = Code("not_in_worksheet", "{student} is not in the worksheet.", severity=WARNING)
