"""What a table and a matrix are called: headings, label, units and path together.

Columns named as joints are matched to a robot's joints by name, never by place.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import JOINT_NAMES, JOINTS_MATCHED
from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.names import Hint, Name, describe, without_units
from mrlab_ros.core.conversion.evidence.time_vectors import is_time_name
from mrlab_ros.core.conversion.workspace import Variable, Workspace, shortened
from mrlab_ros.core.robots.model import RobotModel

BRACKETS = re.compile(r"\s*[\[({]\s*([^\])}]*?)\s*[\])}]\s*$")
POINT = (("x", "y", "z"), ("px", "py", "pz"), ("posx", "posy", "posz"), ("tcpx", "tcpy", "tcpz"))
MOST_HEADINGS = 2000
SECONDS, NANOSECONDS = ("sec", "secs", "s"), ("nsec", "nsecs", "nanosec", "nanosecs", "ns")


@dataclass(frozen=True)
class Group:
    """Neighbouring headings that differ in one number alone: their columns, from 0."""

    columns: tuple[int, ...]
    headings: tuple[str, ...]

    @property
    def path(self) -> str:
        return f"{self.headings[0]}..{self.headings[-1]}"


def plain(heading: str) -> tuple[str, units.Unit | None]:
    """Return a heading without its unit, and that unit where it is one of angles."""
    match = BRACKETS.search(heading)
    if match is None or match[1].isdigit() or not match.start():
        name, unit = without_units(heading)
        return name, unit
    unit = units.parse(match[1])
    return heading[: match.start()].strip(), unit if unit is not None and unit.is_angle else None


def groups(headings: Sequence[str]) -> list[Group]:
    """Return the runs of headings that count upwards, such as q1 to q6, from 2 columns on."""
    found: list[Group] = []
    run: list[int] = []
    previous: tuple[str, str, int] | None = None
    for column, heading in enumerate([*headings, ""]):
        match = re.search(r"\d+(?=\D*$)", plain(heading)[0])
        now = None
        if match is not None:
            text = plain(heading)[0]
            now = (text[: match.start()], text[match.end() :], int(match[0]))
        continues = now and previous and now[:2] == previous[:2] and now[2] == previous[2] + 1
        if not continues:
            if len(run) > 1:
                found.append(Group(tuple(run), tuple(headings[i] for i in run)))
            run = []
        if now is not None:
            run.append(column)
        previous = now
    return found


def describe_table(variable: Variable) -> Name | None:
    """Return what the headings of a table say together, or None where they say nothing."""
    names = [plain(h)[0].lower() for h in variable.columns]
    if not names:
        return None
    bare = [re.sub(r"[^a-z]", "", n) for n in names]
    if any(tuple(bare[i : i + 3]) in POINT for i in range(len(bare) - 2)):
        return Name(Hint.AGAINST, "poses")
    foreign = foreign_quantity(variable.columns)
    if foreign:
        return Name(Hint.AGAINST, foreign)
    unit = next((found for h in variable.columns if (found := plain(h)[1])), None)
    runs = groups(variable.columns)
    if is_whole(variable, runs):
        said = describe(plain_path(runs[0]))
        return replace(said, unit=unit or said.unit)
    said_of = [describe(n.replace(".", "_")) for n in names if not is_time_name(n)]
    if said_of and {s.hint for s in said_of} == {Hint.AGAINST}:
        return Name(Hint.AGAINST, said_of[0].what)
    return Name(Hint.NEUTRAL, "", unit)


def foreign_quantity(headings: Sequence[str]) -> str:
    """Return the quantity whose units most headings give, where joints have others; or empty."""
    given = [h for h in headings if not is_time_name(plain(h)[0])]
    matches = [BRACKETS.search(h) for h in given]
    found = [units.foreign(m[1]) for m in matches if m and m.start()]
    found = [what for what in found if what]
    return found[0] if 2 * len(found) > len(given) else ""


def plain_path(group: Group) -> str:
    """Return the path of a group without units, for its name."""
    first, last = (plain(h)[0].replace(".", "_") for h in (group.headings[0], group.headings[-1]))
    return f"{first}..{last}"


def is_whole(table: Variable, runs: list[Group]) -> bool:
    """Say whether a table is one group, or one with a column behind it that is no time."""
    count = len(table.columns)
    if len(runs) != 1 or runs[0].columns[0] != 0:
        return False
    grouped = len(runs[0].columns)
    return grouped == count or (
        grouped == count - 1 and not is_time_name(plain(table.columns[-1])[0])
    )


def _stamps(table: Variable) -> list[Variable]:
    """Return the times of a table whose seconds and nanoseconds are two columns, as ROS has it."""
    assert table.values is not None
    words_of = [re.split(r"[^a-z]+", plain(h)[0].lower())[-1] for h in table.columns]
    for c, (first, second) in enumerate(itertools.pairwise(words_of)):
        if first in SECONDS and second in NANOSECONDS:
            whole = table.values[:, c : c + 1].astype(float)
            times = whole - whole[0] + table.values[:, c + 1 : c + 2] * 1e-9
            return [Variable("stamp", table.kind, times.shape, times - times[0])]
    return []


def _paired_stamps(workspace: Workspace) -> Iterator[Variable]:
    """Yield the times whose seconds and nanoseconds are two vectors, as ROS has it."""
    vectors = {
        v.path: v for v in workspace.variables if v.values is not None and min(v.shape) == 1
    }
    for path, v in vectors.items():
        match = re.search(r"(?:^|[._])([a-z]+)$", path.lower())
        if match is None or match[1] not in SECONDS or v.values is None or v.values.size < 3:
            continue
        begin = path[: match.start(1)]
        other = next((o for n in NANOSECONDS if (o := vectors.get(begin + n))), None)
        if other is None or other.values is None or other.values.size != v.values.size:
            continue
        whole = v.values.reshape(-1, 1).astype(float)
        times = whole - whole[0] + other.values.reshape(-1, 1) * 1e-9
        stamp = f"{begin}stamp"
        yield Variable(stamp, v.kind, times.shape, times - times[0], label=f"{path} {other.path}")


def with_stamps(workspace: Workspace) -> Workspace:
    """Return the workspace with each pair of seconds and nanoseconds as one vector of times."""
    stamps = [s for s in _paired_stamps(workspace) if workspace.find(s.path) is None]
    parts = {path for stamp in stamps for path in stamp.label.split()}
    if not stamps:
        return workspace
    kept = tuple(v for v in workspace.variables if v.path not in parts)
    return replace(workspace, variables=(*kept, *(replace(s, label="") for s in stamps)))


def split_tables(workspace: Workspace, robot: RobotModel) -> Workspace:
    """Return the workspace with the groups and the single columns of its tables as variables.

    A group is called by its first and last heading, such as actual_q_0..actual_q_5; a column by
    its heading. Tables of one group, and columns named as the robot's joints, stay as they are.
    """
    added: list[Variable] = []
    for v in workspace.variables:
        if v.values is None or not v.columns or v.is_message or len(v.columns) > MOST_HEADINGS:
            continue
        runs = groups(v.columns)
        if not names_joints(v, robot) and not is_whole(v, runs):
            for run in runs:
                values = v.values[:, run.columns[0] : run.columns[-1] + 1]
                given = {unit for h in run.headings if (unit := plain(h)[1])}
                stated = (given.pop().name,) if len(given) == 1 else ()
                added.append(
                    Variable(
                        run.path, v.kind, values.shape, values, columns=run.headings, units=stated
                    )
                )
        grouped = {c for run in runs for c in run.columns}
        added += _stamps(v)
        for c, heading in enumerate(v.columns):
            if c not in grouped and (is_time_name(plain(heading)[0]) or len(v.columns) > 1):
                column = v.values[:, c : c + 1]
                added.append(Variable(heading, v.kind, column.shape, column))
    taken = {v.path for v in workspace.variables}
    kept = [v for v in added if v.path and v.path not in taken]
    return replace(workspace, variables=(*workspace.variables, *kept)) if kept else workspace


PARAMETERS = Name(Hint.AGAINST, "parameters")
MOST_PARAMETERS = 20  # rows of a matrix of gains, masses or links
UNNAMED = ("CSV", "NumPy npy")  # formats whose matrix is called q by the reader
# Quantities that are angles as joint positions are: an angle as unit does not tell them apart.
STAYS_DOUBTFUL = frozenset(("errors", "obstacles", "parameters"))
KEYED = re.compile(r"\{:,.*\}$|\('[^']*'\)$")


def name_of(variable: Variable, file_format: str, robot: RobotModel) -> Name:
    """Return what path, label, headings and units of a variable say.

    The path of a table without headings was given by the reader and says nothing.
    """
    if names_joints(variable, robot):
        unit = describe(variable.path.rpartition("/")[2]).unit if variable.is_message else None
        return Name(Hint.POSITIONS, unit=unit)
    of_units = said_by_units(variable.units)
    if of_units.hint is Hint.AGAINST:
        return of_units
    said = describe(variable.path)
    if said == PARAMETERS and len(variable.path) == 1 and min(variable.shape) > 1:
        # no gains or masses, with a row a sample
        said = Name(Hint.NEUTRAL) if max(variable.shape) > MOST_PARAMETERS else said
    if KEYED.search(variable.path):
        # the columns of a table or an entry of a map: what holds them has any name
        of_columns = describe_table(variable) if variable.columns else None
        said = of_columns or describe(variable.label)
    elif variable.label and said.hint in (Hint.NEUTRAL, Hint.TWO_FACED):
        said = describe(variable.label)
    elif said.hint is Hint.DOUBTFUL and said.what not in STAYS_DOUBTFUL:
        said = _overruled(said, variable)
    elif file_format in UNNAMED:
        of_headings = describe_table(variable)
        if of_headings is not None:
            said = of_headings
        elif not variable.columns and variable.path == "q":
            said = Name(Hint.NEUTRAL)
    elif variable.columns and said.hint is not Hint.AGAINST:
        said = describe_table(variable) or said
    return replace(said, unit=of_units.unit) if of_units.unit else said


def _overruled(said: Name, variable: Variable) -> Name:
    """Return what label and unit in the file make of a doubtful name such as x.

    A label says what the numbers are; an angle as unit leaves a path of the tool alone possible.
    """
    of_label = describe(variable.label) if variable.label else said
    if of_label.hint in (Hint.POSITIONS, Hint.AGAINST):
        return of_label
    given = [units.parse(u) for u in variable.units if u.strip()]
    angles = given and all(u is not None and u.is_angle for u in given)
    return Name(Hint.TWO_FACED) if angles else said


def said_by_units(given: tuple[str, ...]) -> Name:
    """Return what the units of all columns say together; nothing where they differ."""
    spelled = {units.plain(u) for u in given if u.strip()}
    if len(spelled) != 1:
        return Name(Hint.NEUTRAL)
    text = spelled.pop()
    what, unit = units.foreign(text), units.parse(text)
    if what:
        return Name(Hint.AGAINST, what)
    return Name(Hint.NEUTRAL, unit=unit if unit is not None and unit.is_angle else None)


def units_of(variable: Variable, columns: Sequence[int]) -> list[units.Unit | None]:
    """Return the unit of angles that the file gives for each of some columns, from 0."""
    if len(variable.units) == variable.shape[1] > 1:
        given = [units.parse(text) for text in variable.units]
        return [u if (u := given[c]) is not None and u.is_angle else None for c in columns]
    if len(variable.columns) == variable.shape[1]:
        return [plain(variable.columns[c])[1] for c in columns]
    return [None] * len(columns)


GRIPPER = "gripper"


def prefixes(joints: Sequence[str], names: Sequence[str]) -> list[str]:
    """Return what stands before the names of all joints of a robot, such as left_ or cell/.

    Shortest first; empty where the joints are not among `names`.
    """
    ends = {
        name.removesuffix(joints[0])
        for name in names
        if name.endswith(joints[0]) and name.removesuffix(joints[0])[-1:] in ("", "_", "/", ".")
    }
    found = [prefix for prefix in ends if {prefix + joint for joint in joints} <= set(names)]
    return sorted(found, key=lambda prefix: (len(prefix), prefix))


def names_joints(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the columns are named as joints; headings of a table may be anything else."""
    return variable.is_message or not set(robot.joint_names).isdisjoint(variable.columns)


def misnamed(variable: Variable, robot: RobotModel) -> Diagnostic | None:
    """Return what keeps named joints from being the robot's, None where there is nothing."""
    if not names_joints(variable, robot):
        return None
    names, joints = variable.columns, robot.joint_names
    missing = [name for name in joints if name not in names]
    repeated = sorted({name for name in names if names.count(name) > 1})
    # a table may have columns for more than the arm; a message commands every joint it names
    unknown = [name for name in names if name not in joints and name != GRIPPER]
    unknown = unknown if missing or variable.is_message else []
    if not (missing or unknown or repeated):
        return None
    # columns by number keep the names of a message: they mend no joint that it lacks
    in_vain = variable.is_message and bool(missing or repeated)
    by_number = Fix("columns", f"1:{len(joints)}")
    return JOINT_NAMES(
        variable=variable.path,
        model=robot.id,
        missing=shortened(missing),
        unknown=shortened(unknown),
        repeated=shortened(repeated),
        joints=list(joints),
        fixes=(Fix(matlab="save('traj.mat', 'q', '-v7')") if in_vain else by_number,),
    )


def order(variable: Variable, robot: RobotModel) -> tuple[list[int], list[Diagnostic]]:
    """Return the columns, from 0, in the robot's order, a gripper last, and what was done.

    All columns as they are where they do not name joints. Raises BadInput where they name joints
    that are not the robot's.
    """
    names = variable.columns
    if not names_joints(variable, robot):
        return list(range(variable.shape[1])), []
    problem = misnamed(variable, robot)
    if problem is not None:
        raise BadInput(problem)
    wanted = [*robot.joint_names, *([GRIPPER] if GRIPPER in names else [])]
    indices = [names.index(name) for name in wanted]
    if indices == list(range(len(names))):
        return indices, []
    left_out = [name for name in names if name not in wanted]
    done = JOINTS_MATCHED(
        variable=variable.path,
        model=robot.id,
        order=[i + 1 for i in indices],
        left_out=shortened(left_out),
    )
    return indices, [done]
