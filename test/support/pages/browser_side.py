"""A page in a real browser: what goes wrong in it, and what it shows."""

from __future__ import annotations

import io
import time
from collections.abc import Callable

import numpy as np
from PIL import Image
from playwright.sync_api import Locator, Page

DEADLINE_MS = 90_000


class Watched:
    """A page and all that went wrong in it."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.errors: list[str] = []
        self.requests: list[str] = []
        page.set_default_timeout(DEADLINE_MS)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", self._heard)
        page.on("request", lambda request: self.requests.append(request.url))

    def _heard(self, message: object) -> None:
        if message.type == "error":
            self.errors.append(message.text)

    def foreign(self) -> list[str]:
        """Return the addresses outside of the page itself that it asked for."""
        return [url for url in self.requests if not url.startswith(("file:", "data:", "blob:"))]


def pixels(drawn: Locator) -> np.ndarray:
    """Return what an element shows, (height, width, 3)."""
    image = Image.open(io.BytesIO(drawn.screenshot(timeout=DEADLINE_MS)))
    return np.asarray(image.convert("RGB")).astype(int)


def difference(one: np.ndarray, other: np.ndarray) -> float:
    """Return the share of pixels that differ clearly."""
    return float((np.abs(one - other).max(axis=2) > 24).mean())


def eventually(page: Page, condition: Callable[[], bool]) -> None:
    """Return once a condition holds; raise AssertionError where it does not in time."""
    deadline = time.monotonic() + DEADLINE_MS / 1000
    while not condition():
        assert time.monotonic() < deadline, "it did not become so in time"
        page.wait_for_timeout(100)
