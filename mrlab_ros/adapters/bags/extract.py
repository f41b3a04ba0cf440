"""Writes a bag's attachments into a new folder, whatever the bag calls them."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from mrlab_ros.adapters.bags.diagnostics import BAD_ATTACHMENT_NAME, NOT_A_NEW_FOLDER
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.core.base.errors import BadInput

LONGEST_PART = 255  # bytes of a name in a folder


def extract(bag: Bag, folder: Path) -> list[str]:
    """Write every attachment below `folder`, which is new or empty; return their names.

    Raises BadInput, with nothing written, where the folder holds something, or an attachment's
    name is absolute, hidden, leads out of the folder, cannot be printed, or is twice in the way.
    """
    names = sorted(bag.attachments())
    for name in names:
        problem = _problem(name, names)
        if problem:
            raise BadInput(BAD_ATTACHMENT_NAME(attachment=name, problem=problem))
    free(folder)
    for name in names:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("xb") as file:
            file.write(bag.attachment(name).data)
    return names


def free(folder: Path) -> Path:
    """Return a folder that is new or empty; raise BadInput for another."""
    if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
        raise BadInput(NOT_A_NEW_FOLDER(folder=str(folder), problem="file"))
    if folder.exists() and any(folder.iterdir()):
        raise BadInput(NOT_A_NEW_FOLDER(folder=str(folder), problem="full"))
    return folder


def _problem(name: str, names: list[str]) -> str:
    """Return why no file may be called so, by BAD_ATTACHMENT_NAME; empty: it may."""
    parts = name.split("/")
    if not name.isprintable() or any(len(part.encode()) > LONGEST_PART for part in parts):
        return "unprintable"
    if name.startswith("/") or ".." in parts:
        return "outside"
    if any(not part or part.startswith(".") for part in parts):
        return "hidden"
    if any(str(above) in names for above in PurePosixPath(name).parents):
        return "within"
    return ""
