"""Tables whose headings say what their columns hold, such as actual_q_0 ... actual_qd_0 ..."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.names import Hint, Name, describe, without_units
from mrlab_ros.core.conversion.evidence.time_vectors import is_time_name
from mrlab_ros.core.conversion.named_columns import names_joints
from mrlab_ros.core.conversion.workspace import Variable, Workspace
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
