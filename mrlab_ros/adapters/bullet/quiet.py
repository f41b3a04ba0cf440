"""Imports pybullet without the line that its C code writes to stderr: when it was built."""

from __future__ import annotations

import os


def _imported_quietly() -> None:
    kept = os.dup(2)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
            import pybullet as pybullet
    finally:
        os.dup2(kept, 2)
        os.close(kept)


_imported_quietly()
import pybullet as pybullet  # noqa: E402
