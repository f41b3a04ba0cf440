"""Bags of other recorders: made bags of this lab, with the robots whose joints they hold."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from mrlab_ros.adapters import share
from mrlab_ros.adapters.bags.diagnostics import BAG_EXISTS, NO_BAG
from mrlab_ros.adapters.bags.foreign import Imported, import_bag
from mrlab_ros.adapters.bags.other import OtherBag, open_bag
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.yaml_files import close_file
from mrlab_ros.commands import sandboxed
from mrlab_ros.core.base.diagnostic import from_plain, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.messages.definitions import definition


def imported(source: Path, folder: Path, models: Sequence[str]) -> Imported:
    """Make the bag `folder` of a foreign one; models: robots whose joints it holds."""
    if not source.exists():
        raise BadInput(NO_BAG(path=str(source), close=close_file(source)))
    if folder.exists():
        raise BadInput(BAG_EXISTS(folder=str(folder)))
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".importing-", dir=folder.parent) as work:
        made = Path(work, folder.name)
        done = sandboxed.run(
            import_of, str(source), str(made), list(models),
            name=source.name, read=[source], write=[Path(work)],
        )  # fmt: skip
        made.rename(folder)
    skipped = {topic: from_plain(why) for topic, why in done["skipped"].items()}
    return Imported(**{**done, "folder": folder, "skipped": skipped})


def import_of(source: str, folder: str, models: list[str]) -> dict[str, Any]:
    """Import a bag; return the fields of what became of it."""
    library = RobotLibrary(share.directory() / "robots")
    done = import_bag(Path(source), Path(folder), models, library, definition)
    found: dict[str, Any] = plain({**vars(done), "folder": folder})
    return found


def is_foreign(path: Path) -> bool:
    """Return whether a bag has no robots of a lab, or is compressed: a seek would inflate it."""
    if not path.exists():
        return False
    return bool(sandboxed.run(foreign_of, str(path), name=path.name, read=[path]))


def foreign_of(bag: str) -> bool:
    """See is_foreign()."""
    try:
        found = open_bag(Path(bag), definition)
    except BadInput:
        return True
    if isinstance(found, OtherBag) and found.compressed:
        return True
    kinds = {topic.type for topic in found.topics.values()}
    return "mrlab_msgs/msg/Robots" not in kinds and "sensor_msgs/msg/JointState" in kinds


@contextmanager
def imported_for_now(source: Path, models: Sequence[str]) -> Iterator[Imported]:
    """Yield a bag of this lab, which goes at the end."""
    with tempfile.TemporaryDirectory(prefix="mrlab-replay-") as folder:
        yield imported(source, Path(folder) / (source.stem or "bag"), models)
