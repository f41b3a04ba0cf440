"""Names in the catalogue: `quintic` is the lab's, `anna/quintic` anna's, `@3` names a version."""

from __future__ import annotations

import re
from dataclasses import dataclass

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.diagnostics import BAD_TRAJECTORY_ID, BAD_TRAJECTORY_NAME

LONGEST_NAME = 128
ID = re.compile(rf"[A-Za-z0-9][A-Za-z0-9._-]{{0,{LONGEST_NAME - 1}}}")
VERSION = re.compile(r"[1-9][0-9]{0,8}")


@dataclass(frozen=True, order=True)
class TrajectoryName:
    """What an id says. owner: empty: the lab's. version: 0: the newest one."""

    owner: str
    name: str
    version: int = 0

    @property
    def id(self) -> str:
        """The id without a version, unique in the catalogue."""
        return f"{self.owner}/{self.name}" if self.owner else self.name

    def __str__(self) -> str:
        return f"{self.id}@{self.version}" if self.version else self.id


def checked_id(name: str) -> str:
    """Return a trajectory's name without its owner; raise BadInput where it cannot be one."""
    if not ID.fullmatch(name):
        raise BadInput(BAD_TRAJECTORY_NAME(name=name, most=LONGEST_NAME))
    return name


def parse(text: str) -> TrajectoryName:
    """Return what an id such as `quintic`, `anna/quintic` or `anna/quintic@3` names.

    An owner may hold any characters, so the last slash ends it. Raises BadInput where the text
    cannot be an id.
    """
    owner, slash, rest = text.rpartition("/")
    name, at, version = rest.partition("@")
    if not ID.fullmatch(name) or (slash and not owner) or (at and not VERSION.fullmatch(version)):
        raise BadInput(BAD_TRAJECTORY_ID(id=text))
    return TrajectoryName(owner, name, int(version) if at else 0)
