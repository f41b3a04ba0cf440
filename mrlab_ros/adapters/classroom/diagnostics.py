"""What is said of an export of submissions, of the folder of results and of what checks them."""

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# the export
NO_EXPORT = Code("no_export", "There is no folder or archive {file}; check the path and the name.")
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
TWICE_IN_ARCHIVE = Code(
    "twice_in_archive", "It is in the archive twice; the last one is read.", severity=INFO
)
# the folder of results
NO_CLASS_FOLDER = Code(
    "no_class_folder",
    "{folder} holds {found} and is no folder of an earlier class; give an empty or a new folder.",
)
NOT_WRITABLE = Code("not_writable", "{file} cannot be written: {why:problem}.")
# processes that check
UNKNOWN_BACKEND = Code("unknown_backend", "The backend is '{backend}'; expected {known:either}.")
SCHEDULER_NEEDS_CLUSTER = Code(
    "scheduler_needs_cluster",
    "A scheduler needs the backend dask or ray; loky uses this machine alone.",
)
SCHEDULER_NOT_REACHED = Code(
    "scheduler_not_reached",
    "The dask scheduler {address} is not reached ({why:problem}).",
    "Start one.",
    commands=("dask scheduler",),
)
BACKEND_NOT_INSTALLED = Code(
    "backend_not_installed",
    "The backend {backend} needs packages that are not installed ({missing}).",
    "Install them.",
)
