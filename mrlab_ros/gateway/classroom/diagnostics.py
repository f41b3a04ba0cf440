"""What is said of the class that a gateway shows."""

from mrlab_ros.core.base.diagnostic import Code

CLASS_NOT_READ = Code(
    "class_not_read", "The class cannot be read: {why:problem}.", "Mark the class again."
)
CLASS_NO_JSON = Code("class_no_json", "{file} is no JSON: {why:problem}.", "Mark the class again.")
OTHER_CLASS_SCHEMA = Code(
    "other_class_schema",
    "{file} has the schema {found}; expected {expected}.",
    "Mark the class again with this version.",
)
NO_SUBMISSION = Code(
    "no_submission", "There is no submission '{key}' in this class; choose one of its list."
)
NO_MOTION_TO_SHOW = Code(
    "no_motion_to_show", "The submission '{key}' has no motion to show[: {why:problem}]."
)
MOTION_OUTSIDE = Code(
    "motion_outside", "The motion of '{key}' lies outside the folder of the class."
)
MOTION_NOT_THERE = Code(
    "motion_not_there",
    "The motion of '{key}' is not there: {why:problem}.",
    "Mark the class again.",
)
CLASS_FILE_TOO_LARGE = Code(
    "class_file_too_large", "{file} has more than {most:bytes}; it is no file of a class."
)
NO_CLASS = Code(
    "no_class", "This gateway shows no class.", "Start the lab with the folder of a marked class."
)
LOST_POINTS = Code(
    "lost_points",
    "{test}: {found:problem}.",
    "[{hint}]",
    meaning="A test of a rubric took points.",
)
