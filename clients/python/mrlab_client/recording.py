"""What robots did, recorded here as it came."""

from __future__ import annotations

import threading
from typing import Any

from mrlab_client.link import Link
from mrlab_client.table import data_frame


class Recording:
    """The joint states of some robots from now on; as a context manager it ends with the block.

    It is kept in this program's memory. A stream that the network cannot carry is thinned.
    """

    def __init__(self, link: Link, key: str) -> None:
        self._rows: list[tuple[float, dict[str, float]]] = []
        self._ends = threading.Event()
        link.subscribe(key, self._take)

    def _take(self, key: str, message: Any) -> None:
        if self._ends.is_set():
            return
        stamp = message.header.stamp
        robot = key.split("/")[0]
        found = zip(message.name, message.position, strict=True)
        self._rows.append(
            (
                stamp.sec + stamp.nanosec * 1e-9,
                {f"{robot}/{str(name).rsplit('/', 1)[-1]}": float(value) for name, value in found},
            )
        )

    def __len__(self) -> int:
        """Return how many joint states came."""
        return len(self._rows)

    def stop(self) -> None:
        """Take no more."""
        self._ends.set()

    async def __aenter__(self) -> Recording:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.stop()

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame: a column ROBOT/JOINT, rad or m, by the lab's time, s."""
        rows = list(self._rows)
        return data_frame([values for _, values in rows], [time for time, _ in rows])
