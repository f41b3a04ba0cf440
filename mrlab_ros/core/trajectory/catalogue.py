"""Records of the trajectory catalogue: names, versions, visibility.

A name is `quintic` for the lab's trajectory, `anna/quintic` for anna's; `@3` selects a version.
Where a person writes another character, as in `Übung 3`, every door takes `Uebung_3` for it.
Every change makes a new record, so that it is stored before it takes effect.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import cached_property
from typing import Any

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import without_accents
from mrlab_ros.core.trajectory.diagnostics import (
    BAD_TRAJECTORY_ID,
    BAD_TRAJECTORY_NAME,
    DELETED_ALREADY,
    NAME_OF_ANOTHER_MODEL,
    NEWER_RECORD,
    NEWEST_ALREADY,
    NO_RECORD,
    NO_SUCH_VERSION,
    NOT_DELETED,
    SEEN_BY_ALL,
)

FORMAT = 1


@dataclass(frozen=True)
class Version:
    """One version of a trajectory.

    key: of its file in the store, which several versions may share. size: of that file, bytes.
    head: the metadata in that file. published_ns: wall time. draft: the key of the draft that it
    was published from; empty: converted into the catalogue at once.
    """

    number: int
    key: str
    size: int
    head: Mapping[str, Any]
    published_ns: int
    draft: str = ""


@dataclass(frozen=True)
class Record:
    """A trajectory of the catalogue.

    versions: oldest first, at least one. deleted_ns: wall time; 0: it is there.
    """

    owner: str
    name: str
    shared: bool
    versions: tuple[Version, ...]
    deleted_ns: int = 0

    @cached_property
    def id(self) -> str:
        return TrajectoryName(self.owner, self.name).id

    @property
    def newest(self) -> Version:
        return self.versions[-1]

    @property
    def size(self) -> int:
        """Bytes that its files take in the store."""
        return sum({version.key: version.size for version in self.versions}.values())

    @property
    def keys(self) -> frozenset[str]:
        return frozenset(version.key for version in self.versions)

    def version(self, number: int) -> Version:
        """Return a version, the newest for 0; raise BadInput where it is not kept."""
        for version in self.versions:
            if number in (version.number, 0):
                return self.newest if number == 0 else version
        kept = [version.number for version in self.versions]
        raise BadInput(NO_SUCH_VERSION(id=self.id, version=number, kept=kept))

    def visible_to(self, user: str) -> bool:
        """Say whether a user who is no instructor may see it; an empty one: everybody."""
        return self.shared or not self.owner or (bool(user) and self.owner == user)


def published(
    record: Record | None, name: TrajectoryName, version: Version, *, shared: bool, kept: int
) -> Record:
    """Return the record with `version` as its next one, of which the newest `kept` stay.

    record: what was there, deleted or not; None: nothing. The lab's own are always shared. Raises
    BadInput where what is there is another model's motion: its robot could not load it any more.
    """
    if record is not None and not record.deleted_ns:
        there, model = record.newest.head["robot_model"], version.head["robot_model"]
        if there != model:
            raise BadInput(
                NAME_OF_ANOTHER_MODEL(id=record.id, there=there, robot_model=model, name=name.name)
            )
    before = record.versions if record is not None else ()
    number = before[-1].number + 1 if before else 1
    versions = (*before, replace(version, number=number))[-kept:]
    return Record(name.owner, name.name, shared or not name.owner, versions)


def shared(record: Record, value: bool) -> Record:
    """Return the record shared or not; raise BadInput for one of the lab's own."""
    if not record.owner and not value:
        raise BadInput(SEEN_BY_ALL(id=record.id))
    return replace(record, shared=value)


def deleted(record: Record, now_ns: int) -> Record:
    """Return the record as deleted; it can be brought back until its time is over."""
    if record.deleted_ns:
        raise BadInput(DELETED_ALREADY(id=record.id))
    return replace(record, deleted_ns=now_ns)


def restored(record: Record, number: int, now_ns: int, kept: int) -> Record:
    """Return the record as there, with version `number` as its next one; 0: as it was."""
    if number == 0:
        if not record.deleted_ns:
            raise BadInput(NOT_DELETED(id=record.id))
        return replace(record, deleted_ns=0)
    version = record.version(number)
    if version is record.newest:
        if record.deleted_ns:
            return replace(record, deleted_ns=0)
        raise BadInput(NEWEST_ALREADY(id=record.id, version=number))
    again = replace(version, number=record.newest.number + 1, published_ns=now_ns, draft="")
    return replace(record, deleted_ns=0, versions=(*record.versions, again)[-kept:])


def without(record: Record, key: str) -> Record | None:
    """Return the record without the versions whose file is `key`; None: there is no other."""
    versions = tuple(version for version in record.versions if version.key != key)
    return replace(record, versions=versions) if versions else None


def head_of(record: Record, version: Version) -> dict[str, Any]:
    """Return a version's metadata as the catalogue has it: with id, owner, version, shared."""
    return {
        **version.head,
        "id": record.id,
        "owner": record.owner,
        "version": version.number,
        "shared": record.shared,
    }


def free_name(name: str, owner: str, robot_model: str, found: Iterable[Record]) -> str:
    """Return `name`, or with the robot model behind it where `name` is another model's motion.

    The same file converted for two robots is two trajectories: neither takes the other's place.
    """
    for record in found:
        if (record.owner, record.name) == (owner, name) and not record.deleted_ns:
            if record.newest.head["robot_model"] != robot_model:
                return f"{name[: LONGEST_NAME - len(robot_model) - 1]}_{robot_model}"
            break
    return name


def newest(found: Sequence[Record], most: int) -> list[Record]:
    """Return the `most` records that were published last, in the order in which they come."""
    if len(found) <= most:
        return list(found)
    ages = sorted((record.newest.published_ns for record in found), reverse=True)
    return [record for record in found if record.newest.published_ns >= ages[most - 1]][:most]


def to_document(record: Record) -> dict[str, Any]:
    """Return the record as plain data."""
    return {"format": FORMAT, **asdict(record)}


def from_document(document: Mapping[str, Any]) -> Record:
    """Build a record from plain data; raise BadInput where it is none of this format."""
    try:
        if document["format"] != FORMAT:
            raise BadInput(NEWER_RECORD(found=document["format"], known=FORMAT))
        versions = tuple(
            Version(**{name: version[name] for name in _names(Version)})
            for version in document["versions"]
        )
        values = {name: document[name] for name in _names(Record)} | {"versions": versions}
        record = Record(**values)
        numbers = [version.number for version in versions]
        if not versions or numbers != sorted(set(numbers)) or not isinstance(record.name, str):
            raise ValueError("versions that are not in order")
        for version in versions:
            _ = version.head["id"], version.head["frame_count"] + 0, version.key + ""
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BadInput(NO_RECORD(error=repr(error))) from None
    return record


def _names(kind: type[Version] | type[Record]) -> Iterable[str]:
    return (field.name for field in fields(kind))


LONGEST_NAME = 128
ID = re.compile(rf"[A-Za-z0-9][A-Za-z0-9._-]{{0,{LONGEST_NAME - 1}}}")
VERSION = re.compile(r"[1-9][0-9]{0,8}")


@dataclass(frozen=True, order=True)
class TrajectoryName:
    """An id in its parts. owner: empty: the lab's. version: 0: the newest one."""

    owner: str
    name: str
    version: int = 0

    @property
    def id(self) -> str:
        """The id without a version, unique in the catalogue."""
        return f"{self.owner}/{self.name}" if self.owner else self.name

    def __str__(self) -> str:
        return f"{self.id}@{self.version}" if self.version else self.id


def spelled(name: str) -> str:
    """Return a name as the catalogue spells it: Uebung_3 for `Übung 3`. It may still be none."""
    if ID.fullmatch(name):
        return name
    return re.sub(r"[^A-Za-z0-9./@-]+", "_", without_accents(name)).strip("._-")


def checked_id(name: str) -> str:
    """Return a trajectory's name without its owner, spelled(); raise BadInput where it is none."""
    found = spelled(name)
    if not ID.fullmatch(found):
        raise BadInput(BAD_TRAJECTORY_NAME(name=name, most=LONGEST_NAME))
    return found


def parse(text: str) -> TrajectoryName:
    """Return what an id such as `quintic`, `anna/quintic` or `anna/quintic@3` names.

    An owner may hold any characters, so the last slash ends it; the name is spelled(). Raises
    BadInput where the text cannot be an id.
    """
    owner, slash, rest = text.rpartition("/")
    name, at, version = rest.partition("@")
    name = spelled(name)
    if not ID.fullmatch(name) or (slash and not owner) or (at and not VERSION.fullmatch(version)):
        raise BadInput(BAD_TRAJECTORY_ID(id=text))
    return TrajectoryName(owner, name, int(version) if at else 0)
