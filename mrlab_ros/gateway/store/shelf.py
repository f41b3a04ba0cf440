"""The store as one gateway sees it: its catalogue, its files, and who may see what."""

from __future__ import annotations

import math
import shutil
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import orjson
from fastapi.requests import HTTPConnection

from mrlab_ros.adapters import private_folder
from mrlab_ros.adapters.store.port import ObjectStore, StoreFailure
from mrlab_ros.adapters.trajectories.catalogue import Catalogue, NoTrajectory
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles
from mrlab_ros.app.show.document import findings
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import Policy, Verb
from mrlab_ros.core.trajectory.catalogue import Record, Version
from mrlab_ros.core.trajectory.document import warnings_of
from mrlab_ros.gateway.assets.routes import Robots
from mrlab_ros.gateway.diagnostics import LAST_KNOWN
from mrlab_ros.gateway.people.person import LOCAL, Person
from mrlab_ros.gateway.store import downloads

STALE_AFTER_S = 3600.0  # a download this old was of a gateway that was killed


class Shelf:
    """Answers what a person may see; every method may block, so call them in a thread."""

    def __init__(
        self,
        store: ObjectStore,
        state_dir: Path,
        policy: Policy,
        robots: Robots,
        *,
        signs_in: bool,
    ) -> None:
        self.store = store
        self.catalogue = Catalogue(store)
        self.files = TrajectoryFiles(store, state_dir / "fetched")
        self.robots = robots
        # Folder of uploads and downloads in progress.
        self.work = private_folder.make(private_folder.make(state_dir) / "work")
        for path in self.work.glob(f"{downloads.FOLDER}*"):
            if path.stat().st_mtime < time.time() - STALE_AFTER_S:
                shutil.rmtree(path, ignore_errors=True)
        self._policy = policy
        self._signs_in = signs_in
        self._texts: dict[tuple[str, str], tuple[Record, bytes]] = {}

    def user(self, person: Person) -> str:
        """Return whose things a person makes; empty: the lab's, where nobody signs in."""
        return "" if person.name == LOCAL and not self._signs_in else person.id

    def find(self, person: Person, text: str, *, deleted: bool = False) -> tuple[Record, Version]:
        """Return what an id names; raise NoTrajectory where the person may not see it."""
        self._refresh()
        return self.catalogue.find(
            text, lambda record: self.may_see(person, record), deleted=deleted
        )

    def why_not_load(self, person: Person, text: str) -> Diagnostic | None:
        """Return why a person cannot load what an id names; None: it is there and may be seen.

        One that exists and may not be seen answers as one that does not exist.
        """
        if self._sees_all(person):
            return None
        try:
            self.find(person, text)
        except (NoTrajectory, BadInput) as error:
            return error.diagnostic
        return None

    def may_see(self, person: Person, record: Record) -> bool:
        return record.visible_to(self.user(person)) or self._sees_all(person)

    def may_change(self, person: Person, record: Record, service: str) -> bool:
        own = record.owner == self.user(person)
        return self._policy.may(person.role, Verb.CALL, service, own=own)

    def listing(self, person: Person, *, deleted: bool = False) -> bytes:
        """Return the JSON of all trajectories that a person may see, or of the deleted ones.

        While the store does not answer they are those that were last known, and `problem` says so.
        """
        away = self._refresh()
        user, every = self.user(person), self._sees_all(person)
        texts = [
            self._text(record)
            for record in self.catalogue.records()
            if bool(record.deleted_ns) == deleted and (every or record.visible_to(user))
        ]
        problem = orjson.dumps(finding_fields((away,))[0] if away else None)
        return b'{"trajectories":[' + b",".join(texts) + b'],"problem":' + problem + b"}"

    def _refresh(self) -> Diagnostic | None:
        """Read what changed; return why that is impossible now, if the catalogue was ever read."""
        try:
            self.catalogue.refresh()
        except StoreFailure as error:
            if not self.catalogue.known:
                raise
            return LAST_KNOWN(why=error.diagnostic)
        return None

    def _sees_all(self, person: Person) -> bool:
        return self._policy.may(person.role, Verb.CALL, "converter/get_any")

    def _text(self, record: Record) -> bytes:
        place = record.owner, record.name
        known = self._texts.get(place)
        if known is None or known[0] is not record:
            known = self._texts[place] = record, orjson.dumps(trajectory(record))
        return known[1]


def shelf_of(connection: HTTPConnection) -> Shelf:
    """Return the shelf of a gateway, as a dependency."""
    found: Shelf = connection.app.state.shelf
    return found


def trajectory(record: Record, version: Version | None = None) -> dict[str, Any]:
    """Return the fields of answers.Trajectory, of the newest version if none is named."""
    chosen = version or record.newest
    return of_head(
        chosen.head,
        id=record.id,
        owner=record.owner,
        version=chosen.number,
        shared=record.shared,
        deleted=record.deleted_ns * 1e-9 if record.deleted_ns else None,
    )


def of_head(head: Mapping[str, Any], **more: Any) -> dict[str, Any]:
    """Return the fields of answers.Trajectory from the metadata of a file, and those of `more`."""
    return {
        "id": head["id"],
        "robot_model": head["robot_model"],
        "end_effector": head["end_effector"] or "",
        "source_file": head["source"]["file"],
        "source_variable": head["source"]["variable"],
        "source_sha256": head["source"]["sha256"],
        "created": head["created_ns"] * 1e-9,
        "frame_rate": float(head["frame_rate"]),
        "frame_count": head["frame_count"],
        "duration": duration(head),
        "has_gripper": head["has_gripper"],
        "warnings": finding_fields(warnings_of(head)),
        **more,
    }


def duration(head: Mapping[str, Any]) -> float:
    """Return the time of the last frame, s."""
    seconds = (head["frame_count"] - 1) / head["frame_rate"]
    return float(seconds) if math.isfinite(seconds) else 0.0


def finding_fields(diagnostics: tuple[Diagnostic, ...]) -> list[dict[str, Any]]:
    """Return the fields of answers.Finding for each one."""
    return findings(diagnostics)
