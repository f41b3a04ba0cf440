"""Diagnostics of `mrlab class`, of `mrlab rubric`, of exports and results, and of the routes."""

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

OPTION_OUT_OF_RANGE = Code(
    "option_out_of_range",
    "--{option} is {value:number}; expected {least:number} to {most:number}.",
    page=False,
)
MATCH_NOT_READ = Code(
    "match_not_read",
    "'{found}' matches nothing; expected WHAT=WHO, such as run.mat=Jane Doe.",
    page=False,
)
NO_SUBMISSIONS = Code(
    "no_submissions",
    "{file} holds no submission; expected an export of Moodle, ILIAS, Canvas or Gradescope, or a "
    "folder or file for each student.",
)
UNKNOWN_FORM = Code("unknown_form", "The form of the export is '{form}'; expected {known:either}.")
REFERENCE_APART = Code(
    "reference_apart",
    "{rubric}: the reference {file} names the motion {motion}, which does not lie beside it.",
    "Put the motions of the cell beside it.",
)
REFERENCE_NOT_READ = Code(
    "reference_not_read", "{rubric}: the reference {file} cannot be read: {why:problem}."
)
PROCESSES_KILLED = Code(
    "processes_killed",
    "Processes that check were killed {count:integer} times; the memory may not suffice.",
    "What is done is kept: run the same command again with fewer jobs.",
)
STOPPED = Code(
    "stopped_class",
    "Stopped with {done:integer} of {all:integer} checked; they are kept.",
    "Run the same command to go on.",
    INFO,
    page=False,
)
WORKSHEET_WRITTEN = Code(
    "worksheet_written",
    "The worksheet with the grades is {file}.",
    severity=INFO,
    page=False,
)
KEY_TABLE_NOT_READ = Code(
    "key_table_not_read",
    "The key table {file} cannot be read ({why:problem}); without it the pseudonyms would change.",
    "Mend it, or move it away to get new ones.",
    page=False,
)
KEY_TABLE_NOT_WRITTEN = Code(
    "key_table_not_written",
    "The key table {file} cannot be written: {why:problem}.",
    page=False,
)
GRADER_NOT_STARTED = Code("grader_not_started", "The process that checks did not start.")
NO_ROBOT_IN_RUBRIC = Code(
    "no_robot_in_rubric",
    "'{file}' does not say which robot it is for; name one in the rubric: robot: ur5e",
)
NO_FILE = Code("no_file", "There is no file.")


OF_RUBRIC = Code("of_rubric", "{rubric}: {why:problem}.")
OF_REFERENCE = Code("of_reference", "{rubric}: reference: {why:problem}.")
REFERENCE_NOT_MARKED = Code(
    "reference_not_marked",
    "{rubric}: the reference {file} cannot be marked[: {why:problem}].",
)
CELL_FOR_ONE_ROBOT = Code(
    "cell_for_one_robot",
    "{file} is a cell of several robots, and the rubric is for one {robot}; leave robot: out of a "
    "rubric for cells.",
)
ROBOT_NOT_SAID = Code(
    "robot_not_said",
    "'{file}' does not say which robot it is for, nor does the rubric; add robot: ur5e to the "
    "rubric, or mark a cell (.yaml).",
)


# the export
NO_EXPORT = Code(
    "no_export",
    "There is no folder or archive {file}; check the path and the name.",
    page=False,
)
NO_ZIP = Code(
    "no_zip",
    "{file} is no zip archive that can be read ({why:problem}); expected the export as the system "
    "wrote it, or its folder.",
)
TOO_MANY_FILES = Code(
    "too_many_files", "{file} holds more than {most:integer} files; expected fewer."
)
NOT_READABLE = Code("not_readable", "{file} cannot be read: {why:problem}.")
NOT_UNPACKED = Code("not_unpacked", "{file} cannot be unpacked: {why:problem}.")
LARGER_THAN_NEEDED = Code(
    "larger_than_needed", "{file} is larger than {most:bytes}, which no class needs."
)
INFLATES_TOO_FAR = Code("inflates_too_far", "{file} inflates to more than {most:bytes}.")
NAMES_NOT_KNOWN = Code(
    "names_not_known",
    "It cannot be read, so names are not known: {why:problem}.",
    severity=WARNING,
)
LINK_NOT_FOLLOWED = Code(
    "link_not_followed", "This is a link; it is not followed.", severity=WARNING
)
NO_ORDINARY_FILE = Code(
    "no_ordinary_file", "This is no ordinary file; it is not read.", severity=WARNING
)
NAME_LEADS_OUT = Code(
    "name_leads_out",
    "Its name leads out of the archive; it is not read.",
    severity=WARNING,
)
ENCRYPTED_FILE = Code(
    "encrypted_file", "It is encrypted; ask the student for an open file.", severity=WARNING
)
UNPACKING_ENDED = Code(
    "unpacking_ended",
    "The process that unpacks ended at {file} ({why:problem}); the file is the reason and is not "
    "read.",
    "Ask the student for an ordinary archive.",
    WARNING,
)
UNPACKING_NOT_STARTED = Code(
    "unpacking_not_started", "The process that unpacks does not start: {why:problem}."
)
TWICE_IN_ARCHIVE = Code(
    "twice_in_archive", "It is in the archive twice; the last one is read.", severity=INFO
)
# the folder of results
NO_CLASS_FOLDER = Code(
    "no_class_folder",
    "{folder} holds {found} and is no folder of an earlier class; give an empty or a new folder.",
)
CLASS_RUNS = Code(
    "class_runs", "Another run writes the results in {folder}; wait until it has ended."
)
SOURCE_NAME = Code(
    "source_name", "'{file}' is no name of a file beside a rubric; expected one without folders."
)
SOURCE_TOO_LARGE = Code("source_too_large", "{file} is larger than {most:bytes}.")
SOURCES_MISSING = Code(
    "sources_missing",
    "There is no {what:choice export=export|rubric=rubric} yet; hand it in first.",
)
NOTHING_PROPOSED = Code("nothing_proposed", "No marks are proposed; run the class first.")
CLASS_RUN_ENDED = Code(
    "class_run_ended", "The run ended before it was done ({why:problem}); start it again."
)
NOT_RELEASED = Code(
    "not_released", "The marks are not released; release them, then download what students get."
)
NO_WORKSHEET_GIVEN = Code(
    "no_worksheet_given",
    "The platform's table was not handed in; hand it in, undo the release, and release again.",
)
# processes that check
UNKNOWN_BACKEND = Code(
    "unknown_backend",
    "The backend is '{backend}'; expected {known:either}.",
    page=False,
)
SCHEDULER_NEEDS_CLUSTER = Code(
    "scheduler_needs_cluster",
    "A scheduler needs the backend dask or ray; loky uses this machine alone.",
    page=False,
)
WORKERS_DIFFER = Code(
    "workers_differ",
    "Workers at {address} have another MR-Lab than this machine[: {workers:list}]"
    "[ ({why:problem})].",
    "Install the same version on all machines.",
    page=False,
)
SCHEDULER_NOT_REACHED = Code(
    "scheduler_not_reached",
    "The dask scheduler {address} is not reached ({why:problem}).",
    "Start one.",
    commands=("dask scheduler",),
    page=False,
)
BACKEND_NOT_INSTALLED = Code(
    "backend_not_installed",
    "The backend {backend} needs packages that are not installed ({missing}).",
    "Install them.",
    page=False,
)


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
NO_CLASS_FILE = Code(
    "no_class_file",
    "There is no {file} in {folder}.",
    "Grade the submissions of a class into a folder, and name that one.",
    page=False,
)
