"""Bags of other recorders: made bags of this lab, with the robots whose joints they hold."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from mrlab_ros.adapters.bags.foreign import Imported, import_bag
from mrlab_ros.adapters.bags.other import OtherBag, open_bag
from mrlab_ros.adapters.nearby import like_file
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.errors import BadInput
from mrlab_ros.messages.definitions import definition
from mrlab_ros.ros import share


def imported(source: Path, folder: Path, models: Sequence[str]) -> Imported:
    """Make the bag `folder` of a foreign one; models: robots whose joints it holds."""
    if not source.exists():
        raise BadInput(
            f"there is no bag {source}; name the folder of a bag, or a .db3 file"
            f"{like_file(source)}"
        )
    library = RobotLibrary(share.directory() / "robots")
    return import_bag(source, folder, models, library, definition)


def is_foreign(path: Path) -> bool:
    """Return whether a bag has no robots of a lab, or is compressed: a seek would inflate it."""
    try:
        bag = open_bag(path, definition)
    except BadInput:
        return path.exists()
    if isinstance(bag, OtherBag) and bag.compressed:
        return True
    kinds = {topic.type for topic in bag.topics.values()}
    return "mrlab_msgs/msg/Robots" not in kinds and "sensor_msgs/msg/JointState" in kinds


@contextmanager
def imported_for_now(source: Path, models: Sequence[str]) -> Iterator[Imported]:
    """Yield a bag of this lab, which goes at the end."""
    with tempfile.TemporaryDirectory(prefix="mrlab-replay-") as folder:
        yield imported(source, Path(folder) / (source.stem or "bag"), models)
