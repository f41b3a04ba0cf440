"""What `mrlab check` refuses, beside what the check itself finds."""

from mrlab_ros.core.base.diagnostic import Code

ROBOTS_TWICE = Code(
    "robots_twice",
    "The scene {scene} is asked for, and {file} has robots and objects of its own; leave one of "
    "them out.",
)
PLACES_NOT_KNOWN = Code(
    "places_not_known",
    "{file} names robots, but not where they stand.",
    "Name the scene that has them (--scene), or put robots into the file.",
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
FOR_ONE_MOTION = Code(
    "for_one_motion", "--{option} is for one motion; {file} is a cell of several."
)
TOO_FAR_TO_MEASURE = Code(
    "too_far_to_measure",
    "--closest is {value:length}; expected at most {most:length}, as far as is measured.",
)
NO_LENGTH = Code(
    "no_length",
    "--{option} is '{text}'; expected a length up to 10 m, such as 5mm or 0.005.",
)
LENGTH_WITHOUT_UNIT = Code(
    "length_without_unit",
    "--{option} is '{text}', which would be {text} m; write {text}mm or {text}m.",
)
POINTS_NOT_READ = Code(
    "points_not_read",
    "The points in {file} cannot be read: {why:problem}; expected a CSV with x, y, z in m.",
)
PAGE_NOT_WRITTEN = Code("page_not_written", "{file} cannot be written: {why:problem}.")
NO_PAGE = Code(
    "no_page",
    "No page is written: the file holds no motion that could be rehearsed.",
)
