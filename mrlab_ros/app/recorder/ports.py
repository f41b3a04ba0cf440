"""What the recorder needs of the graph and of the disk, and what it publishes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.recording.metadata import BagFacts, Gap
from mrlab_ros.core.recording.recorder import RecorderState
from mrlab_ros.core.recording.stops import Stop
from mrlab_ros.core.recording.topics import Split, Topics


class RunningRecording(Protocol):
    """A bag that is written. position: s since it began; size: bytes."""

    @property
    def bag(self) -> Path: ...
    @property
    def position(self) -> float: ...
    @property
    def messages(self) -> int: ...
    @property
    def size(self) -> int: ...

    def start(self) -> None:
        """Begin; raise LabError where the recording has ended by itself."""

    def discover(self) -> None:
        """Follow the topics that are new in the graph."""

    def split(self) -> None:
        """Continue in a new file; raise LabError where the recording ends by itself."""

    def close(self) -> None:
        """End it; raise LabError where the bag could not be closed."""


class RunningReplay(Protocol):
    """A bag that is replayed. left_out: topics that are not; duration, position: s."""

    left_out: list[Diagnostic]
    messages: int

    @property
    def bag(self) -> Bag: ...
    @property
    def position(self) -> float: ...
    @property
    def rate(self) -> float: ...

    def prepare(self) -> None:
        """Wait until the lab's own nodes have left; raise Misuse where others stay."""

    def start(self) -> None: ...
    def pause(self) -> None: ...
    @property
    def standing(self) -> bool: ...
    def resume(self, until: float = math.inf, arrived: Callable[[], None] | None = None) -> None:
        """Play on; pause at `until`, s, and call `arrived` in another thread."""

    def seek(self, position: float) -> None: ...
    def set_rate(self, rate: float) -> None: ...
    def set_loop(self, loop: bool) -> None: ...

    def close(self) -> None:
        """End it and take its topics out of the graph; may be called twice."""


class Streams(Protocol):
    """The topics of the graph, which are recorded and replayed."""

    def record(
        self,
        folder: Path,
        topics: Topics,
        split: Split,
        on_trouble: Callable[[LabError], None],
        after: BagFacts | None = None,
        gap: Gap | None = None,
    ) -> RunningRecording:
        """Make a bag, or continue one that holds `after`, with a note of the gap since then.

        on_trouble: gets in another thread what ended the recording; the bag is closed by then.
        Raises LabError where the bag cannot be made.
        """

    def replay(
        self,
        path: Path,
        rate: float,
        start: float,
        loop: bool,
        on_end: Callable[[Diagnostic | None], None],
    ) -> RunningReplay:
        """Open a bag; raise LabError where it, or what is asked for, cannot be replayed.

        on_end: called in another thread at the end, with what ended the replay, or None.
        """

    def publish(self, status: Status) -> None:
        """Publish what the recorder does."""

    def publish_stops(self, stops: Sequence[Stop]) -> None:
        """Publish the stops of what is replayed."""


class Journal(Protocol):
    """One mapping that outlives the process."""

    def load(self) -> dict[str, Any]: ...
    def save(self, content: Mapping[str, Any]) -> bool: ...


@dataclass(frozen=True)
class Settings:
    """folder: of bags that are named without one. split_size: bytes; 0: never."""

    folder: Path
    topics: tuple[str, ...]
    split_size: int


@dataclass(frozen=True)
class Status:
    """What is published. trouble: of the bag at hand, or what ended it; times s, size bytes."""

    state: RecorderState
    trouble: Diagnostic | None = None
    bag: str = ""
    position: float = 0.0
    duration: float = 0.0
    rate: float = 1.0
    messages: int = 0
    size: int = 0
