"""The catalogue as the store holds it: one record a trajectory, read once, then what changed.

The object `changes.json` counts the changes and names the last ones, so that a reader anywhere
asks for one small object and fetches the records that it lacks.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor

import orjson

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import Missing, ObjectStore
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.trajectory import catalogue as records
from mrlab_ros.core.trajectory.catalogue import Record, TrajectoryName, Version, parse
from mrlab_ros.core.trajectory.diagnostics import NO_TRAJECTORY_OF_NAME, RECORD_OF_ANOTHER

READERS = 8  # requests at once to a store that is no folder
MOST_NAMED = 10  # ids in the sentence about one that is not there


class NoTrajectory(BadInput):
    """There is no such trajectory, or not for who asks."""


class Catalogue:
    """The records of a store; safe from several threads."""

    def __init__(self, store: ObjectStore, log: Callable[[str], None] = lambda text: None) -> None:
        self.store = store
        self._log = log
        self._records: dict[tuple[str, str], Record] = {}
        self._ordered: list[Record] | None = None
        self._table = threading.Lock()
        self._reading = threading.Lock()
        self._epoch, self._number = "", -1

    def refresh(self) -> bool:
        """Read what changed since the last call; say whether anything did."""
        with self._reading:
            epoch, number, recent = read_changes(self.store)
            if (epoch, number) == (self._epoch, self._number):
                return False
            names = [(owner, name) for n, owner, name in recent if n > self._number]
            if epoch != self._epoch or len(names) < number - self._number:
                self._replace(self._read_all())
            else:
                for name in dict.fromkeys(names):
                    self._read_one(*name)
            self._epoch, self._number = epoch, number
            return True

    @property
    def known(self) -> bool:
        """Whether it was read at least once."""
        return self._number >= 0

    def records(self) -> list[Record]:
        """Return every record, ordered by id, the deleted ones too."""
        with self._table:
            if self._ordered is None:
                self._ordered = sorted(self._records.values(), key=lambda record: record.id)
            return self._ordered.copy()

    def usage(self, owner: str) -> int:
        """Return how many bytes a user's trajectories take, the deleted ones too."""
        return sum(record.size for record in self.records() if record.owner == owner)

    def find(
        self,
        text: str,
        visible: Callable[[Record], bool] = lambda record: True,
        *,
        named: Callable[[Record], bool] | None = None,
        deleted: bool = False,
    ) -> tuple[Record, Version]:
        """Return the trajectory and the version that an id such as `anna/pick@3` names.

        visible: whether who asks may see a record; one that is not visible is not there. named:
        which ones the error may name; None: the visible ones. deleted: a deleted one counts too.
        Raises NoTrajectory, and BadInput for a version that is gone.
        """
        try:
            name = parse(text)
        except BadInput:
            name = TrajectoryName("", "")
        record = self._records.get((name.owner, name.name))
        if record is None or (record.deleted_ns and not deleted) or not visible(record):
            shown = named or visible
            ids = [r.id for r in self.records() if not r.deleted_ns and shown(r)]
            known, close = ids[:MOST_NAMED], close_to(text, ids)
            raise NoTrajectory(NO_TRAJECTORY_OF_NAME(id=text, known=known, close=close))
        return record, record.version(name.version)

    def _put(self, place: tuple[str, str], record: Record | None) -> None:
        """Take note of a record; None: it is gone."""
        with self._table:
            if record is None:
                self._records.pop(place, None)
            else:
                self._records[place] = record
            self._ordered = None

    def _replace(self, found: dict[tuple[str, str], Record]) -> None:
        with self._table:
            self._records, self._ordered = found, None

    def _read_all(self) -> dict[tuple[str, str], Record]:
        found = [entry.key for entry in self.store.list(keys.RECORDS)]
        with ThreadPoolExecutor(READERS) as pool:
            read = pool.map(self._read, found) if not self._is_folder() else map(self._read, found)
            return {(r.owner, r.name): r for r in read if r is not None}

    def _is_folder(self) -> bool:
        return self.store.path(keys.CHANGES) is not None

    def _read_one(self, owner: str, name: str) -> None:
        self._put((owner, name), self._read(keys.record(owner, name)))

    def _read(self, key: str) -> Record | None:
        """Return the record under a key; None where it is gone, or none."""
        try:
            record = records.from_document(orjson.loads(self.store.get(key)))
            if keys.record(record.owner, record.name) != key:
                raise BadInput(RECORD_OF_ANOTHER(id=record.id))
        except Missing:
            return None
        except (BadInput, orjson.JSONDecodeError) as error:
            self._unreadable(key, str(error))
            return None
        return record

    def _unreadable(self, key: str, why: str) -> None:
        self._log(f"left out of the catalogue: '{key}' of {self.store.place}: {why}")


def read_changes(store: ObjectStore) -> tuple[str, int, list[tuple[int, str, str]]]:
    """Return the writer's epoch, the number of its changes, and the last ones: number and name."""
    try:
        document = orjson.loads(store.get(keys.CHANGES))
        recent = [(int(n), str(owner), str(name)) for n, owner, name in document["recent"]]
        return str(document["epoch"]), int(document["number"]), recent
    except Missing:
        return "", 0, []
    except (orjson.JSONDecodeError, KeyError, TypeError, ValueError):
        return "damaged", 0, []


def changes_document(epoch: str, number: int, recent: Iterable[tuple[int, str, str]]) -> bytes:
    """Return what read_changes() reads."""
    return orjson.dumps({"epoch": epoch, "number": number, "recent": list(recent)})
