"""What a playback host writes into its journal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mrlab_ros.core.playback.playback import Kept

ROBOTS = "robots"


def plain(model: str, kept: Kept) -> dict[str, Any]:
    """Return a robot's entry in the journal. model: of the robot."""
    return {
        "model": model,
        "trajectory": kept.trajectory_id,
        "version": kept.version,
        "position": kept.position,
        "rate": kept.rate,
        "loop": kept.loop,
        "halted": kept.halted,
        "begun": kept.begun,
        "arm": [float(value) for value in kept.arm],
    }


def read(content: Mapping[str, Any]) -> dict[str, tuple[str, Kept]]:
    """Return by robot its model and what it had; entries of another form are left out."""
    found = {}
    for name, entry in content.get(ROBOTS, {}).items():
        try:
            kept = Kept(
                str(entry["trajectory"]),
                int(entry["version"]),
                float(entry["position"]),
                float(entry["rate"]),
                bool(entry["loop"]),
                halted=bool(entry["halted"]),
                begun=bool(entry["begun"]),
                arm=np.array(entry["arm"], dtype=float),
            )
            if kept.arm.ndim == 1 and np.isfinite(kept.arm).all():
                found[str(name)] = str(entry["model"]), kept
        except (KeyError, TypeError, ValueError):
            continue
    return found
