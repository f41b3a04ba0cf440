"""What the file itself calls a matrix: its path, label, headings and units together."""

from __future__ import annotations

import re
from dataclasses import replace

from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.headings import describe_table
from mrlab_ros.core.conversion.evidence.names import Hint, Name, describe
from mrlab_ros.core.conversion.named_columns import names_joints
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel

UNNAMED = ("CSV",)  # formats whose matrix is called q by the reader
# Quantities that are angles as joint positions are: an angle as unit does not tell them apart.
STAYS_DOUBTFUL = frozenset(("errors", "obstacles", "parameters"))
KEYED = re.compile(r"\{:,.*\}$|\('[^']*'\)$")


def name_of(variable: Variable, file_format: str, robot: RobotModel) -> Name:
    """Return what path, label, headings and units of a variable say.

    The path of a table without headings was given by the reader and says nothing.
    """
    if names_joints(variable, robot):
        return Name(Hint.POSITIONS)
    of_units = said_by_units(variable.units)
    if of_units.hint is Hint.AGAINST:
        return of_units
    said = describe(variable.path)
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
