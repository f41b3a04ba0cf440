"""What `mrlab rubric` refuses."""

from mrlab_ros.core.base.diagnostic import Code

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
EXAMPLE_NOT_READ = Code("example_not_read", "{file} cannot be read: {why:problem}.")
