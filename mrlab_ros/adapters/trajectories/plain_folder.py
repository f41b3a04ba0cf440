"""Takes over the trajectories that earlier versions of MR-Lab kept as files in one folder."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.trajectories import formats, npz_file
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.npz_file import Damaged
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.catalogue import ID
from mrlab_ros.core.trajectory.diagnostics import NAMED_OTHERWISE, NOT_A_TRAJECTORY_FILE

JSON_SUFFIX = ".json"
# Folders inside it for files that are no longer part of it.
DAMAGED, IMPORTED = "damaged", "imported"


def import_folder(
    folder: Path, catalogue: CatalogueWriter, log: Callable[[str], None]
) -> list[str]:
    """Publish every trajectory file of a folder as the lab's own; return their ids.

    An imported file is moved to the folder `imported` and a damaged one to `damaged`; what cannot
    be taken stays, and `log` takes a sentence. Killed in between, it goes on where it was: what
    is in the catalogue already is not published again. Raises StoreFailure.
    """
    taken: list[str] = []
    # An npz is newer than the JSON of its name, which an earlier version read instead.
    for suffix in (JSON_SUFFIX, npz_file.SUFFIX):
        for path in sorted(folder.glob(f"[!.]*{suffix}")):
            try:
                taken.append(_take(path, catalogue))
                _move(path, IMPORTED)
            except Damaged as error:
                log(f"left out of the catalogue: {error}; it was moved to {_move(path, DAMAGED)}")
            except BadInput as error:
                log(f"left out of the catalogue: {error}")
    return taken


def _take(path: Path, catalogue: CatalogueWriter) -> str:
    if not path.is_file():
        found = "folder" if path.is_dir() else "none"
        raise Damaged(NOT_A_TRAJECTORY_FILE(file=path.name, found=found))
    if path.suffix == JSON_SUFFIX:
        try:
            trajectory = formats.parse(path.read_bytes(), path.name)
        except BadInput as error:
            raise Damaged(error.diagnostic) from None
        head = document.metadata(trajectory)
    else:
        trajectory = npz_file.read(path)
        head = npz_file.read_head(path)
    name = trajectory.id
    if name != path.stem or not ID.fullmatch(name):
        raise BadInput(NAMED_OTHERWISE(file=path.name, id=name, name=f"{name}{path.suffix}"))
    if not _is_there(head, catalogue):
        catalogue.save(trajectory)
    return name


def _is_there(head: dict[str, Any], catalogue: CatalogueWriter) -> bool:
    """Say whether a version was made from the same file at the same time."""
    try:
        record, _ = catalogue.find(head["id"], deleted=True)
    except BadInput:
        return False
    same = ("created_ns", "source", "frame_count")
    return any(all(v.head[n] == head[n] for n in same) for v in record.versions)


def _move(path: Path, folder: str) -> Path:
    """Move a file into a folder beside it, numbered where its name is taken there."""
    (path.parent / folder).mkdir(exist_ok=True)
    unused, number = path.parent / folder / path.name, 1
    while os.path.lexists(unused):
        number += 1
        unused = unused.with_name(f"{path.stem}-{number}{path.suffix}")
    os.rename(path, unused)
    return unused
