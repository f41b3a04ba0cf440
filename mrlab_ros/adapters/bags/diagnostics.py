"""Diagnostics of bags: damaged files, and records that cannot be read."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# what is wrong with a bag that is read all the same
BAG_NOT_BEGUN = Code(
    "bag_not_begun",
    "{file} ends before its first record: its writer was killed",
    severity=WARNING,
)
BAG_DAMAGED = Code(
    "bag_damaged",
    "{file} is damaged at byte {offset:integer}[ ({problem})].",
    "Bring back a copy of the file, or repair the bag, which leaves that part out.",
    severity=WARNING,
)
BAG_NO_INDEX = Code(
    "bag_no_index",
    "{file} has no index: its writer was killed or lost its disk",
    severity=WARNING,
)
BAG_CUT_SHORT = Code(
    "bag_cut_short",
    "{file} ends within a record at byte {offset:integer}; what is before it is read",
    severity=WARNING,
)
BAG_LIVE = Code(
    "bag_live",
    "it is being recorded; this is what it holds so far",
    severity=INFO,
)
# what a report says of a session
NOTHING_RECORDED = Code("nothing_recorded", "Nothing was recorded in it", severity=WARNING)
BAG_WITHOUT_ROBOTS = Code(
    "bag_without_robots",
    "No robot of a lab is in it; it holds {topics:list}[ and {more:integer} more]",
    severity=WARNING,
    meaning="A bag without robots of a lab. Where it holds joint states, importing it makes a "
    "session of it by the joints' names.",
    data=("types",),
)
TRAJECTORY_UNREADABLE = Code(
    "trajectory_unreadable",
    "{attachment} cannot be read, so runs of it are compared with nothing",
    severity=WARNING,
)
MESSAGES_UNREADABLE = Code(
    "messages_unreadable",
    "{messages:count message|messages} of {topic} cannot be read and were left out",
    severity=WARNING,
)
CLOCK_SET_BACK = Code(
    "clock_set_back",
    "At {time:time} the clock was set back by {by:time}; {then:choice even=the times of this "
    "report go on evenly|piled=what was recorded until it had caught up stands at that instant}",
    severity=WARNING,
)
BAD_MESSAGE = Code(
    "bad_bag_message",
    "a message is no {type} ({problem})",
    "Bring back a copy of the bag.",
)

# bags that cannot be read
NO_BAG = Code(
    "no_bag",
    "There is no bag {path}.[ Did you mean '{close}'?]",
    "Name the folder of a bag or an MCAP file.",
)
BAG_GONE = Code(
    "bag_gone",
    "{path} cannot be read any more ({problem}).",
    "Was the bag renamed, removed, or its disk taken away? Name it where it is now.",
)
BAG_UNREADABLE = Code(
    "bag_unreadable", "{path} cannot be read ({problem}).", "Check its permissions."
)
BAG_EMPTY_FILE = Code(
    "bag_empty_file",
    "{path} is empty or was cut off in its first bytes: there is nothing to read or mend in it.",
    "Bring back a copy.",
)
BAG_COMPRESSED = Code(
    "bag_compressed",
    "{path} is compressed as a whole.",
    "Import it, which makes a plain bag of it.",
)
NOT_MCAP = Code(
    "not_mcap",
    "{path} is no MCAP file: it does not begin with MCAP's magic bytes.",
    "Another ROS 2 bag becomes one of the lab by an import.",
)
MCAP_WITHOUT_CHUNKS = Code(
    "mcap_without_chunks",
    "{path} has messages outside of chunks and no index.",
    "Import it, which makes a bag of the lab of it.",
)
METADATA_NOT_YAML = Code(
    "metadata_not_yaml",
    "{file} is no YAML ({problem}).",
    "Remove it, or repair the bag, which writes it anew.",
)
BAG_LACKS_FILES = Code(
    "bag_lacks_files",
    "{path} lacks {files:list}, which its metadata.yaml lists.",
    "Bring the files back, give them these names again, or read what is left by itself.",
)
BAG_WITHOUT_FILES = Code(
    "bag_without_files",
    "{path} holds no MCAP file.",
    "Name the folder of a bag; a bag of another kind becomes one of the lab by an import.",
)
NO_ATTACHMENT = Code(
    "no_attachment",
    "{path} has no attachment '{attachment}'[; it has: {known:list}].",
)
BAG_WITHOUT_MODEL = Code(
    "bag_without_model",
    "{path} names no robot, so nothing in it can be compared with a file.",
)
NOT_ROS_BAG = Code(
    "not_ros_bag",
    "{path} cannot be read as a ROS 2 bag ({why:problem}); expected its folder with "
    "metadata.yaml, an MCAP file, or a .db3 file.",
)
DATABASE_DAMAGED = Code(
    "database_damaged",
    "{path} is damaged ({problem}).",
    "Bring back a copy, or read on with what is left.",
    meaning="A database of sqlite3 is damaged.",
)
MESSAGE_TOO_LARGE = Code(
    "message_too_large", "A message of {topic} holds more than {limit:bytes}."
)
FIELD_CHANGED = Code(
    "field_changed",
    "The field {field} of {type} is of another kind in the bag than here.",
    "Replay it with the lab that recorded it.",
)
BAD_MESH_ADDRESS = Code("bad_mesh_address", "The mesh '{uri}' has no {expected} address.")

# bags that cannot be written
BAG_EXISTS = Code(
    "bag_exists",
    "{folder} exists already; a bag is made in a new folder.",
    "Name another.",
)
BAG_FOLDER_NOT_MADE = Code(
    "bag_folder_not_made",
    "The folder {folder} cannot be made ({problem}).",
    "Name one where you may write.",
)
BAG_MOVED = Code(
    "bag_moved",
    "The bag {folder} was renamed or removed while it was recorded; what was recorded is whole "
    "where it is now.",
    "Start a new recording.",
)
BAG_NOT_WRITTEN = Code(
    "bag_not_written",
    "The bag {folder} cannot be written ({problem}); what was recorded stays readable.",
    "Check that folder, then start a new recording.",
)
BAG_DISK_FULL = Code(
    "bag_disk_full",
    "The bag {folder} cannot be written: {cause:choice disk=its disk is full|quota=your quota "
    "there is used up}[ ({free:bytes} of {size:bytes} are free)]; a recording needs "
    "{needed:bytes}; what was recorded stays readable.",
    "Make room on that disk, or name a folder on another one, then start a new recording.",
)

# repairs
REPAIR_RUNS = Code("repair_runs", "Another repair of {path} is at work.", "Wait for its end.")
BAG_BEING_RECORDED = Code(
    "bag_being_recorded",
    "The bag {path} is being recorded and needs no repair.",
    "End the recording first.",
)
BAG_NOT_REPAIRED = Code(
    "bag_not_repaired",
    "The bag {path} cannot be repaired ({problem}).",
    "Make room on that disk, or copy the bag to where you may write and repair the copy.",
)
ORIGINAL_IN_THE_WAY = Code(
    "original_in_the_way",
    "{path} is there from an earlier repair.",
    "Move it away, then repair again.",
)

# attachments
BAD_ATTACHMENT_NAME = Code(
    "bad_attachment_name",
    "The attachment '{attachment}' {problem:choice unprintable=cannot be the name of a "
    "file|outside=would be written outside of the folder|hidden=would be a hidden "
    "file|within=would lie in another attachment, not in a folder}; nothing was written.",
    "The bag is made by hand: a lab names its attachments such as robots/ur5e_1.urdf.",
)
NOT_A_NEW_FOLDER = Code(
    "not_a_new_folder",
    "{folder} {problem:choice file=is no folder|full=is not empty}.",
    "Name a new folder.",
)

# imports
BAG_IMPORTED = Code(
    "bag_imported",
    "{bag} holds {messages:count message|messages}[:{notes:problems}]",
    severity=INFO,
)
JOINTS_MOVE = Code("joints_move", "the joints move {robot} ({model})", severity=INFO)
MOVES_NO_ROBOT = Code(
    "moves_no_robot",
    "{topic} moves no robot, for none of the lab has its joints[ ({joints:list})].",
    "A robot is added by an import of its URDF.",
    severity=WARNING,
)
NOT_CDR = Code("not_cdr", "it is {format}, not CDR")
TYPE_UNKNOWN = Code("type_unknown", "the bag does not define {type}, and it is not installed here")
