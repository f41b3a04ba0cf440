"""Workspace files as students save them: right, doubtful and wrong ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.io
from numpy.typing import NDArray

HOME = np.radians([0, -90, 90, -90, -90, 0])
RATE = 100.0


def wave(frames: int = 201, size: float = 0.5) -> NDArray[np.float64]:
    """Return a motion there and back from the home pose of a UR5e, (frames, 6) rad."""
    share = 0.5 - 0.5 * np.cos(np.linspace(0, 2 * np.pi, frames))
    moved: NDArray[np.float64] = HOME + size * share[:, None] * np.array(
        [1, 0.5, -0.6, 0.3, 0.4, 1]
    )
    return moved


def good(folder: Path, name: str = "wave.mat", size: float = 0.5) -> Path:
    """Write a motion with its rate."""
    return _saved(folder / name, q=wave(size=size), fs=RATE)


def ambiguous(folder: Path) -> Path:
    """Write two motions with names that say nothing."""
    return _saved(folder / "two.mat", first=wave(), second=wave(size=0.8), fs=RATE)


def jumping(folder: Path) -> Path:
    """Write a motion with a jump by a full turn in joint 6, which unwrap removes."""
    q = wave()
    q[:, 5] = np.mod(q[:, 5] + np.pi + 2.8, 2 * np.pi) - np.pi
    return _saved(folder / "jump.mat", q=q, fs=RATE)


def beyond(folder: Path) -> Path:
    """Write a motion that leaves the range of the elbow in the middle."""
    q = wave()
    q[90:111, 2] = np.radians(200)
    return _saved(folder / "beyond.mat", q=q, fs=RATE)


def into_the_floor(folder: Path) -> Path:
    """Write a motion within all limits that leads the hand through the floor."""
    q = wave()
    q[:, 1] = HOME[1] + 4.6 * (q[:, 0] - HOME[0])
    return _saved(folder / "floor.mat", q=q, fs=RATE / 2)


def _saved(path: Path, **variables: object) -> Path:
    scipy.io.savemat(path, variables)
    return path
