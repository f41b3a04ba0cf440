"""The one writer of a store's catalogue: every change is one record, replaced as a whole.

A version's file is written first, under a key of its own that never comes again; then the record
that names it. So whoever is killed leaves a file that nobody names, which is swept later, and
readers see the catalogue before the change or after it.
"""

from __future__ import annotations

import contextlib
import itertools
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import partial
from typing import Any, BinaryIO

import orjson

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import Missing, ObjectStore, StoreFailure
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.catalogue import Catalogue, changes_document
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.trajectory import catalogue as records
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.catalogue import Record, TrajectoryName, Version, checked_id, parse
from mrlab_ros.core.trajectory.diagnostics import (
    NOBODYS_TRAJECTORIES,
    OVER_QUOTA,
    REMOVED_MEANWHILE,
)
from mrlab_ros.core.trajectory.trajectory import Trajectory

MOST_RECENT = 200  # changes that changes.json names
DAY_S = 86_400.0
# A file that nobody names may belong to a change in progress.
ORPHAN_AFTER_S = 3600.0
DAMAGED = "damaged"


class CatalogueWriter(Catalogue):
    """The catalogue of a store that this process alone changes.

    versions_kept: of one trajectory. quota: bytes of one user's trajectories; 0: no limit.
    """

    def __init__(
        self,
        store: ObjectStore,
        log: Callable[[str], None] = lambda text: None,
        *,
        now_ns: Callable[[], int] = time.time_ns,
        versions_kept: int = 10,
        quota: int = 0,
    ) -> None:
        super().__init__(store, log)
        self.versions_kept, self.quota = versions_kept, quota
        self._now_ns = now_ns
        self._changing = threading.Lock()
        # Records whose writing failed: the store may hold the old one or the new one.
        self._uncertain: set[tuple[str, str]] = set()
        self._unannounced = False
        self._recent: deque[tuple[int, str, str]] = deque(maxlen=MOST_RECENT)

    def open(self) -> None:
        """Read the whole catalogue and begin to count its changes anew; raise StoreFailure.

        A store that cannot be written, such as one on a full disk, is still read.
        """
        with self._changing:
            self._replace(self._read_all())
            self._epoch, self._number = keys.unique(), 0
            self._recent.clear()
            self._announce()

    def refresh(self) -> bool:
        """Do nothing: what this process writes it knows."""
        return False

    def publish(
        self,
        name: TrajectoryName,
        head: Mapping[str, Any],
        source: BinaryIO | str,
        *,
        shared: bool = False,
    ) -> tuple[Record, Version]:
        """Add a version to a trajectory; raise BadInput beyond the quota, StoreFailure.

        source: the open file that `npz_file.write` filled, or the key of a draft, whose head it
        is. A draft that was published before is published once.
        """
        name = replace(name, name=checked_id(name.name))
        draft = source if isinstance(source, str) else ""
        if draft and (before := self._published_before(name, draft)) is not None:
            return before, before.newest
        size = self.store.size(draft) if draft else _size(source)  # type: ignore[arg-type]
        self._check_quota(name.owner, size)
        key = keys.version(name.owner, name.name)
        if draft:
            self.store.copy(draft, key)
        else:
            self.store.put_file(key, source)  # type: ignore[arg-type]
        version = Version(0, key, size, head, self._now_ns(), draft)
        record = self._change(
            name,
            lambda before: records.published(
                before, name, version, shared=shared, kept=self.versions_kept
            ),
        )
        if draft:
            with contextlib.suppress(StoreFailure):
                self.store.delete([draft])
        found = next(v for v in record.versions if v.key == key)
        return record, found

    def save(self, trajectory: Trajectory, *, shared: bool = False) -> tuple[Record, Version]:
        """Add a trajectory as the next version of its id; raise as publish()."""
        name = parse(trajectory.id)
        with tempfile.TemporaryFile() as file:
            npz_file.write(trajectory, file)  # type: ignore[arg-type]
            head = document.metadata(trajectory)
            return self.publish(name, head, file, shared=shared)  # type: ignore[arg-type]

    def share(self, text: str, shared: bool) -> Record:
        """Let everybody see a trajectory, or its owner and instructors alone."""
        return self._change_existing(text, lambda r: records.shared(r, shared))

    def delete(self, text: str) -> Record:
        """Delete a trajectory; restore() brings it back until it is swept."""
        return self._change_existing(text, lambda r: records.deleted(r, self._now_ns()))

    def restore(self, text: str, version: int) -> Record:
        """Bring back a deleted trajectory (version 0), or make an older version the next one."""
        return self._change_existing(
            text,
            lambda r: records.restored(r, version, self._now_ns(), self.versions_kept),
            deleted=True,
        )

    def hand_over(self, owner: str, to: str) -> int:
        """Give all trajectories of `owner`, the deleted ones too, to `to`; return how many.

        One whose name is taken gets a number behind it. What was never published is erased. Raises
        BadInput where one of the two is nobody, StoreFailure; then some have changed hands.
        """
        if not owner or not to or owner == to:
            raise BadInput(NOBODYS_TRAJECTORIES(owner=owner, to=to))
        found = [record for record in self.records() if record.owner == owner]
        for record in found:
            taken = {each.name for each in self.records() if each.owner == to}
            numbered = (f"{record.name}-{number}" for number in itertools.count(2))
            name = next(n for n in itertools.chain([record.name], numbered) if n not in taken)
            given = replace(record, owner=to, name=name)
            self._change(TrajectoryName(to, name), partial(_becomes, given))
            self._change(TrajectoryName(owner, record.name), lambda before: None)
        self._erase(keys.user(owner))
        return len(found)

    def erase(self, owner: str) -> int:
        """Remove all that somebody uploaded and published, for good; return how many trajectories.

        Raises BadInput for the lab's own, StoreFailure; then some are gone.
        """
        if not owner:
            raise BadInput(NOBODYS_TRAJECTORIES(owner=owner, to=""))
        found = [record for record in self.records() if record.owner == owner]
        for record in found:
            self._change(TrajectoryName(owner, record.name), lambda before: None)
        mine = [f"{place}/{keys.segment(owner)}" for place in (keys.RECORDS, keys.VERSIONS)]
        with self._changing:
            used = {key for record in self._records.values() for key in record.keys}
        self._erase(keys.user(owner), *mine, *(f"{DAMAGED}/{each}" for each in mine), keep=used)
        return len(found)

    def _erase(self, *prefixes: str, keep: Collection[str] = ()) -> None:
        entries = (entry.key for prefix in prefixes for entry in self.store.list(prefix))
        self.store.delete([key for key in entries if key not in keep])

    def set_aside(self, record: Record, version: Version) -> str:
        """Take a damaged file and its versions out of the catalogue; return where it is then."""
        place = f"{DAMAGED}/{version.key}"
        with contextlib.suppress(Missing):
            self.store.copy(version.key, place)
        self._change(
            TrajectoryName(record.owner, record.name),
            lambda before: before and records.without(before, version.key),
        )
        path = self.store.path(place)
        return f"{self.store.place}/{place}" if path is None else str(path)

    def sweep(self, trash_s: float, unpublished_s: float) -> None:
        """Remove what is no longer of use: old trash, files that nobody names, old uploads.

        trash_s: how long a deleted trajectory can be brought back. unpublished_s: how long
        uploads, drafts and what a page shows of them stay.
        """
        now = self._now_ns() * 1e-9
        for record in self.records():
            if record.deleted_ns and record.deleted_ns * 1e-9 < now - trash_s:
                name = TrajectoryName(record.owner, record.name)
                self._change(name, lambda before: None)
        old = [e for e in self.store.list(keys.VERSIONS) if e.modified < now - ORPHAN_AFTER_S]
        with self._changing:
            for place in list(self._uncertain):
                self._certain(*place)
            used = {key for r in self._records.values() for key in r.keys}
        self.store.delete([e.key for e in old if e.key not in used])
        unpublished = self.store.list(keys.USERS)
        self.store.delete([e.key for e in unpublished if e.modified < now - unpublished_s])
        self.store.clear_interrupted(ORPHAN_AFTER_S)
        if self._unannounced:
            with self._changing:
                self._announce()

    def _published_before(self, name: TrajectoryName, draft: str) -> Record | None:
        with self._changing:
            self._certain(name.owner, name.name)
        record = self._records.get((name.owner, name.name))
        if record is None or record.newest.draft != draft or record.deleted_ns:
            return None
        return record

    def _check_quota(self, owner: str, size: int) -> None:
        used = self.usage(owner) if owner and self.quota else 0
        if owner and self.quota and used + size > self.quota:
            raise BadInput(OVER_QUOTA(owner=owner, used=used, size=size, limit=self.quota))

    def _change_existing(
        self, text: str, change: Callable[[Record], Record], *, deleted: bool = False
    ) -> Record:
        record, _ = self.find(text, deleted=deleted)
        name = TrajectoryName(record.owner, record.name)

        def changed(before: Record | None) -> Record:
            if before is None:
                raise BadInput(REMOVED_MEANWHILE(id=record.id))
            return change(before)

        after: Record = self._change(name, changed)
        return after

    def _change(self, name: TrajectoryName, change: Callable[[Record | None], Any]) -> Any:
        """Replace a record by what `change` makes of it; None removes it."""
        key, place = keys.record(name.owner, name.name), (name.owner, name.name)
        with self._changing:
            self._certain(*place)
            before = self._records.get(place)
            after: Record | None = change(before)
            try:
                if after is not None:
                    self.store.put(key, orjson.dumps(records.to_document(after)))
                else:
                    self.store.delete([key])
            except StoreFailure:
                self._uncertain.add(place)
                raise
            self._put(place, after)
            self._number += 1
            self._recent.append((self._number, *place))
            self._announce()
            dropped = (before.keys if before else frozenset()) - (after.keys if after else set())
            # One that changes hands has two records for a moment.
            dropped -= {key for r in self._records.values() if dropped for key in r.keys}
        self._drop(dropped)
        return after

    def _certain(self, owner: str, name: str) -> None:
        """Read a record again of which the store may hold another one."""
        if (owner, name) in self._uncertain:
            self._read_one(owner, name)
            self._uncertain.discard((owner, name))

    def _announce(self) -> None:
        """Write down that something changed; a failure is mended by the next change or sweep."""
        document = changes_document(self._epoch, self._number, self._recent)
        try:
            self.store.put(keys.CHANGES, document)
            self._unannounced = False
        except StoreFailure as error:
            self._unannounced = True
            self._log(f"readers of the store do not know of the last change yet: {error}")

    def _drop(self, files: Collection[str]) -> None:
        try:
            self.store.delete(files)
        except LabError as error:
            self._log(f"files of older versions stay until they are swept: {error}")

    def _unreadable(self, key: str, why: str) -> None:
        """Keep what is no record under another key, so that nothing overwrites it."""
        place = f"{DAMAGED}/{key}"
        self.store.copy(key, place)
        self.store.delete([key])
        super()._unreadable(key, f"{why}; it is now {place}")


def _becomes(record: Record, before: Record | None) -> Record:
    """Return a record, whatever was there before."""
    return record


def _size(file: BinaryIO) -> int:
    file.seek(0, 2)
    return file.tell()
