#!/usr/bin/env python3
"""Render the README's picture: the shipped hand-over at the frame where both grippers hold."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy.io
from picture import surfaces
from ray_tracer import Camera, Surface, draw

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.geometry import Array, transform_from_xyz_rpy

ROOT = Path(__file__).resolve().parents[2]
FRAME = 430
CAST = (
    ("ur5e", "two_robot_handover_ur5e", transform_from_xyz_rpy([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])),
    (
        "kuka_kr6_r900_sixx",
        "two_robot_handover_kr6",
        transform_from_xyz_rpy([1.2, 0.0, 0.0], [0.0, 0.0, np.pi]),
    ),
)


def placed(part: Surface, pose: Array) -> Surface:
    """Return `part` moved by the (4, 4) transform `pose`."""
    turn = pose[:3, :3].T
    return replace(part, vertices=part.vertices @ turn + pose[:3, 3], normals=part.normals @ turn)


def main() -> None:
    library = RobotLibrary(ROOT / "robots")
    parts = []
    for model, file, pose in CAST:
        rows = scipy.io.loadmat(ROOT / "examples" / f"{file}.mat")["q"]
        arm = rows[FRAME, : len(library.model(model).joints)]
        parts += [placed(p, pose) for p in surfaces(library, model, "parallel_gripper", arm)]
    camera = Camera((0.6, -2.6, 1.25), (0.6, 0.0, 0.52), 30.0)
    draw(parts, camera, (1200, 700), 6, ROOT / "docs" / "images" / "lab.png")


if __name__ == "__main__":
    main()
