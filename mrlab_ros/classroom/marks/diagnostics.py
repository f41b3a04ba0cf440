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
FILE_ASSIGNED = Code(
    "file_assigned", "{file} was given to this student by a teacher.", severity=INFO
)
CHANGED_MARK = Code(
    "changed_mark",
    "[{test}: ]{before:number} was changed to {after:number} by a teacher.",
    severity=INFO,
)
CHANGED_MARK_NOT_READ = Code(
    "changed_mark_not_read",
    "{student}, {test}: '{found}' is no number; the mark stays as the test gave it.",
    severity=WARNING,
)
CHANGED_MARK_OUT_OF_RANGE = Code(
    "changed_mark_out_of_range",
    "{student}, {test}: {found:number} is not between {least:number} and {most:number} points; "
    "the mark stays as it was.",
    severity=WARNING,
)
MARKS_CHANGED = Code(
    "marks_changed",
    "Marks of {count:count submission|submissions} were changed by hand; they are kept.",
    "Write the value of the test back into the table to undo a change.",
    INFO,
    page=False,
)
CLASS_IS_LOCKED = Code(
    "class_is_locked", "{who} locked the marks of this class; undo that before you change one."
)
MARK_WITHOUT_REASON = Code(
    "mark_without_reason", "A mark that is changed needs a reason; say why in a few words."
)
SECOND_IS_FIRST = Code(
    "second_is_first",
    "{who} gave this mark, and cannot be its second marker; another instructor has to sign in.",
)
SECOND_MARKS_DIFFER = Code(
    "second_marks_differ",
    "{count:count mark of a second marker differs|marks of a second marker differ}; give the mark "
    "that holds, or take the second one back.",
)
NOTHING_TO_UNDO = Code("nothing_to_undo", "Nothing was done that could be undone.")
# why a submission has no marks
NO_FILE_HANDED_IN = Code(
    "no_file_handed_in",
    "No file that may hold a motion was handed in[; there is {files:list}].",
)
UNREADABLE = Code("unreadable_submission", "No file of this submission can be read.")
SUBMISSION_OUT_OF_MEMORY = Code(
    "submission_out_of_memory",
    "The check needs more than {limit:bytes} of memory; the motion may be very long.",
)
SUBMISSION_FAILED = Code("submission_failed", "The check failed on it ({error}).")
SUBMISSION_GIVEN_UP = Code(
    "submission_given_up",
    "The check was given up after {limit:duration}; the machine was too busy.",
    "Run the same command again: it checks what is to be repeated.",
    WARNING,
)
SUBMISSION_ENDED = Code(
    "submission_ended", "The check took more than {limit:duration} of a processor."
)
SUBMISSION_KILLED = Code(
    "submission_killed",
    "The check was killed from outside; the machine may have no memory left.",
    "Run the same command again with fewer jobs: it checks what is to be repeated.",
    WARNING,
)
MACHINE_REFUSED = Code(
    "machine_refused",
    "The machine did not let the check end ({why:problem}).",
    "Free memory or disk space, and run the same command again: it checks what is to be repeated.",
    WARNING,
)
SUBMISSION_CRASHED = Code(
    "submission_crashed",
    "The check crashed on it ({why:problem}); the file is the reason, no other.",
)
# the gradebook
GRADE_TO_REPEAT = Code(
    "grade_to_repeat",
    "{student} has no grade: the check is to be repeated.",
    "Run the same command again.",
    WARNING,
)
NO_WORKSHEET = Code(
    "no_worksheet",
    "{file} has {count:count column|columns}[: {columns:list}]; expected those of "
    "Moodle's grading worksheet (Identifier, Grade), of ILIAS' status.csv (login, mark), or of "
    "Canvas' gradebook (ID, and one task, or one that is named as the rubric).",
)
MAXIMUM_DIFFERS = Code(
    "maximum_differs",
    "The platform's maximum is {found}, the rubric has {points:number} points; the points are "
    "written as they are.",
    severity=WARNING,
)
NOT_IN_WORKSHEET = Code("not_in_worksheet", "{student} is not in the worksheet.", severity=WARNING)
UNKNOWN_MATCH = Code(
    "unknown_match",
    "'{found}' is neither a file or student that could not be matched, nor somebody of this class"
    "[; did you mean {near}?]",
    "Name a file as it is listed, and a student by key, name or number.",
    page=False,
)
