"""What the recorder writes into its journal while it records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Entry:
    """A recording under way. split_duration: s after which a new file begins; 0: never."""

    folder: Path
    topics: tuple[str, ...]
    split_duration: float


def plain(folder: Path, topics: Sequence[str], split_duration: float) -> dict[str, Any]:
    """Return the content of the journal."""
    return {"folder": str(folder), "topics": list(topics), "split_duration": split_duration}


def read(content: Mapping[str, Any]) -> Entry | None:
    """Return what was recorded; None where nothing was."""
    try:
        return Entry(
            Path(content["folder"]),
            tuple(map(str, content["topics"])),
            float(content["split_duration"]),
        )
    except (KeyError, TypeError, ValueError):
        return None
