"""Diagnostics of trajectories, their files, and the catalogue that keeps them."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code, Severity

INFO = Severity.INFO

# names
BAD_TRAJECTORY_NAME = Code(
    "bad_trajectory_name",
    "The name '{name}' cannot be used.",
    "Write letters, digits, '.', '_' and '-', at most {most:integer}, beginning with a letter or "
    "digit.",
)
BAD_TRAJECTORY_ID = Code(
    "bad_trajectory_id",
    "'{id}' cannot be the id of a trajectory.",
    "Write NAME or USER/NAME with letters, digits, '.', '_' and '-' in NAME, such as quintic, "
    "anna/quintic or quintic@3.",
)
NOT_A_NEW_NAME = Code(
    "not_a_new_name",
    "'{id}' cannot be published.",
    "Give a name without a version and without another owner, such as {name}.",
)
# the numbers
POSITIONS_SHAPE = Code(
    "positions_shape",
    "The positions of '{id}' are {size}; expected at least 2 rows and "
    "{joints:count column|columns}, one a joint.",
)
POSITIONS_NOT_FINITE = Code(
    "positions_not_finite", "The positions of '{id}' hold NaN or Inf.", "Save finite radians."
)
FRAME_RATE_NOT_POSITIVE = Code(
    "frame_rate_not_positive",
    "The frame rate of '{id}' is {value:number}; expected a number of frames per second above 0.",
)
CHANNEL_SHAPE = Code(
    "channel_shape",
    "The {channel:choice gripper=gripper's states|derived=derived channels} of '{id}' are {size}; "
    "expected {expected}, a row for each frame.",
)
# files of trajectories
NOT_AS_SCHEMA = Code(
    "not_as_schema",
    "'{file}' is no trajectory file: [at {place}, ]{error}.",
    "Convert the workspace again.",
)
NOT_JSON = Code("not_json", "'{file}' is no JSON ({error}).", "Convert the workspace again.")
COLUMN_SHAPE = Code(
    "column_shape",
    "'{column}' of the trajectory file is {size}; expected {expected}, as frame_count and "
    "joint_names say.",
    "Convert the workspace again.",
)
COLUMN_NOT_FINITE = Code(
    "column_not_finite",
    "'{column}' of the trajectory file holds NaN or Inf.",
    "Convert the workspace again.",
)
COLUMN_OF_TIME = Code(
    "column_of_time",
    "'t' of the trajectory file does not count i / {rate:number}.",
    "Convert the workspace again.",
)
DAMAGED_TRAJECTORY = Code(
    "damaged_trajectory",
    "'{file}' is damaged ({error}).",
    "Convert the workspace again.",
)
DAMAGED_VERSION = Code(
    "damaged_version",
    "Version {version:integer} of '{id}' was moved to {folder}: {why:problem}.",
)
NEWER_FORMAT = Code(
    "newer_format",
    "Trajectory '{id}' is kept in format {found}; this MR-Lab reads format {known:integer}.",
    "Update the lab, or convert the workspace again.",
)
NO_SUCH_FRAME = Code(
    "no_such_frame", "'{id}' has no frame {frame:integer}; expected 0 to {last:integer}."
)
NO_EXPORT_FORMAT = Code(
    "no_export_format",
    "'{format}' is no format that is written.[ Did you mean {close}?]",
    "Choose one of {known:list}.",
)
# which robot plays it
OF_ANOTHER_MODEL = Code(
    "of_another_model",
    "Trajectory '{id}' was made for {made_for}; this robot is a {robot_model}.",
    "Convert the file again for {robot_model}.",
)
OF_OTHER_JOINTS = Code(
    "of_other_joints",
    "Trajectory '{id}' has the joints {found:list}; expected {expected:list}.",
    "Convert the file again.",
)
OF_ANOTHER_END_EFFECTOR = Code(
    "of_another_end_effector",
    "Trajectory '{id}' was made for the end effector {made_for}, which this robot does not carry"
    "[; it carries {carried}].",
    "Exchange the end effector, or convert the file again.",
)
# the catalogue
NO_TRAJECTORY_OF_NAME = Code(
    "no_trajectory_of_name",
    "There is no trajectory '{id}'.[ Did you mean {close}?]",
    "Convert a file[ or take one of these: {known:list}].",
)
NO_SUCH_VERSION = Code(
    "no_such_version",
    "'{id}' has no version {version:integer}; kept are {kept:list}.",
)
NAME_OF_ANOTHER_MODEL = Code(
    "name_of_another_model",
    "'{id}' is a trajectory of {there} already, and this one is for {robot_model}.",
    "Choose another name, such as {name}_{robot_model}, or delete '{id}' first.",
)
SEEN_BY_ALL = Code(
    "seen_by_all",
    "'{id}' is the lab's own, which everybody may see.",
    "Give it an owner by publishing it as a user's.",
)
DELETED_ALREADY = Code(
    "deleted_already", "'{id}' is deleted already.", "Restore it to bring it back."
)
NOT_DELETED = Code(
    "not_deleted", "'{id}' is not deleted.", "Name the version that becomes the next one."
)
NEWEST_ALREADY = Code(
    "newest_already", "Version {version:integer} of '{id}' is the newest already."
)
NEWER_RECORD = Code(
    "newer_record",
    "A record of the catalogue has format {found}; this MR-Lab reads format {known:integer}.",
    "Update the lab.",
)
NO_RECORD = Code("no_record", "It is no record of a trajectory ({error}).")
RECORD_OF_ANOTHER = Code("record_of_another", "It holds '{id}'.")
OVER_QUOTA = Code(
    "trajectory_quota",
    "The trajectories of {owner} take {used:bytes} and this one {size:bytes}; expected at most "
    "{limit:bytes}.",
    "Delete what is no longer used.",
)
REMOVED_MEANWHILE = Code("removed_meanwhile", "'{id}' was removed meanwhile.")
VERSION_REMOVED = Code(
    "version_removed",
    "Version {version:integer} was removed meanwhile.",
    "Ask for it again.",
)
VERSION_GONE = Code(
    "version_gone",
    "The file of version {version:integer} is gone from {place}.",
    "Convert the workspace again.",
)
NO_ROOM_FOR_COPY = Code(
    "no_room_for_copy",
    "A trajectory cannot be kept in {folder} ({error}).",
    "Make room on the disk.",
)
# the converter's services
REPLACED_MEANWHILE = Code(
    "replaced_meanwhile", "'{id}' was replaced while it was fetched.", "Load it again."
)
UPLOAD_OF_ANOTHER = Code(
    "upload_of_another", "The upload is not one of {owner}'s.", "Send the file again."
)
DRAFT_OF_ANOTHER = Code(
    "draft_of_another", "The draft is not one of {owner}'s.", "Publish it as its owner."
)
PUBLISHED_ALREADY = Code("published_already", "That draft was published already, as '{id}'.")
TRAJECTORY_PUBLISHED = Code(
    "trajectory_published", "'{id}' was published, version {version:integer}.", severity=INFO
)
TRAJECTORY_DELETED = Code(
    "trajectory_deleted", "'{id}' was deleted.", "Restore it to bring it back.", severity=INFO
)
NOBODYS_TRAJECTORIES = Code(
    "nobodys_trajectories",
    "Trajectories of '{owner}' cannot be given to '{to}' or erased.",
    "Expected the ids of two people; the lab's own trajectories stay.",
)
HANDED_OVER = Code(
    "handed_over",
    "{count:count trajectory|trajectories} of {owner} belong to {to} now.",
    severity=INFO,
)
OWNER_ERASED = Code(
    "owner_erased",
    "{count:count trajectory|trajectories} of {owner} and all that {owner} uploaded were erased.",
    severity=INFO,
)
TRAJECTORY_SHARED = Code("trajectory_shared", "'{id}' is seen by everybody.", severity=INFO)
TRAJECTORY_HIDDEN = Code(
    "trajectory_hidden", "'{id}' is seen by {owner} and instructors.", severity=INFO
)
TRAJECTORY_RESTORED = Code(
    "trajectory_restored", "'{id}' is there, version {version:integer}.", severity=INFO
)
