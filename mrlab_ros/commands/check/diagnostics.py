"""Diagnostics of `mrlab check`, beside the findings of the check itself."""

from mrlab_ros.core.base.diagnostic import Code

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
NO_PAGE = Code(
    "no_page",
    "No page is written: the file holds no motion that could be rehearsed.",
)
