"""The engine port, implemented with pybullet."""

import os
import sys


def _imported_quietly() -> None:
    """Import pybullet without the line that its C code writes to stderr: when it was built."""
    kept = os.dup(2)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
            import pybullet as pybullet
    finally:
        os.dup2(kept, 2)
        os.close(kept)


if "pybullet" not in sys.modules:
    _imported_quietly()
