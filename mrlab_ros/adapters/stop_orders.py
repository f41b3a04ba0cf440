"""Orders to end a recording that wait for a recorder: a file for each in a folder of the lab."""

from __future__ import annotations

import json
import secrets
from contextlib import suppress
from pathlib import Path

from mrlab_ros.adapters.whole_file import TEMPORARY, replaced
from mrlab_ros.core.recording.recorder import StopOrder

FOLDER = "stop_orders"


class StopOrders:
    """The orders in a state folder; without one none waits and none can be left."""

    def __init__(self, state_dir: str) -> None:
        self._folder = Path(state_dir) / FOLDER if state_dir else None

    def leave(self, bag: str) -> bool:
        """Leave the order to end the recording into `bag`; return whether it waits.

        bag: empty: the recording that runs when the order is carried out.
        """
        if self._folder is None:
            return False
        try:
            self._folder.mkdir(mode=0o700, exist_ok=True)
            with replaced(self._folder / secrets.token_hex(8), 0o600) as file:
                file.write(json.dumps({"bag": bag}).encode())
        except OSError:
            return False
        return True

    def waiting(self) -> list[StopOrder]:
        """Return the orders that wait; a file that holds none is removed."""
        if self._folder is None:
            return []
        try:
            files = [file for file in self._folder.iterdir() if TEMPORARY not in file.name]
        except OSError:
            return []
        orders = []
        for file in files:
            try:
                orders.append(StopOrder(file.name, str(json.loads(file.read_bytes())["bag"])))
            except OSError:
                continue
            except (KeyError, TypeError, ValueError):
                self.remove(StopOrder(file.name))
        return orders

    def remove(self, order: StopOrder) -> None:
        """Remove an order that was carried out, or has no recording any more."""
        if self._folder is not None:
            with suppress(OSError):
                (self._folder / order.id).unlink()
