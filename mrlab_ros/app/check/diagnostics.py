"""Diagnostics of what cannot be checked: a cell, a motion, a robot of a lab."""

from mrlab_ros.core.base.diagnostic import Code

TOO_LONG_FOR_LAB = Code(
    "too_long_for_lab",
    "'{trajectory}' lasts {duration:time}; expected {most:time} at most in the lab.",
    "Download it and check it on your own machine.",
)
NOT_IN_LAB = Code(
    "not_in_lab",
    "There is no robot '{robot}' in the lab[; its robots are: {robots:list}].",
)
FOR_ANOTHER_MODEL = Code(
    "for_another_model",
    "'{trajectory}' is for {found}, and {robot} is a {model}; load it on a {found}.",
)
CHECK_OUT_OF_MEMORY = Code(
    "check_out_of_memory", "The check needs more than {most:bytes} of memory."
)
ROBOTS_TWICE = Code(
    "robots_twice",
    "The scene {scene} is asked for, and {file} has robots and objects of its own; leave one of "
    "them out.",
)
PLACES_NOT_KNOWN = Code(
    "places_not_known",
    "{file} names robots, but not where they stand.",
    "Name the scene that has them, or put robots into the file.",
)
NOT_ONE_SYSTEM = Code(
    "not_one_system",
    "{file} has {count:count system|systems}[ ({names:list})]; expected one to check.",
)
MEMBER_NOT_IN_SCENE = Code(
    "member_not_in_scene",
    "The member {robot} is not among the robots of [the scene {scene}][{file}][; they are: "
    "{robots:list}].",
)
MEMBER_REFUSED = Code("member_refused", "{robot} cannot play {file}: {why:problem}.")
MEMBER_WITHOUT_MOTION = Code(
    "member_without_motion",
    "{file} names no trajectory of {robot}; add one, such as trajectory: run.mat",
)
MEMBER_FILE_MISSING = Code(
    "member_file_missing",
    "The trajectory '{trajectory}' of {robot} is no file in {folder}; a check reads files, not "
    "the catalogue of a running lab.",
)
MEMBER_FILE_NOT_BESIDE = Code(
    "member_file_not_beside",
    "The trajectory '{trajectory}' of {robot} is no file beside {file}; a cell that is handed in "
    "reaches only files of the same submission.",
)
PLAYS_BACKWARDS = Code(
    "plays_backwards",
    "The cell plays backwards (rate {rate:number}); a check plays forwards.",
)
MOTION_OF_ANOTHER_ROBOT = Code(
    "motion_of_another_robot",
    "'{file}' is a motion of {found}; expected one of {model}.",
    "Convert the workspace again for this robot.",
)
MODEL_NOT_IN_SCENE = Code(
    "model_not_in_scene",
    "The scene {scene} has no robot {robot}, so its place there is not known; its robots are: "
    "{robots:list}.",
    "Take one of these, or another scene.",
)
