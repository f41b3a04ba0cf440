"""A motion as a small drawing: a robot of sticks in some poses, seen from the front right."""

from __future__ import annotations

from typing import Any

import numpy as np

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.library import TIP
from mrlab_ros.core.robots.model import ShownRobot
from mrlab_ros.core.trajectory.trajectory import Trajectory

WIDTH, HEIGHT, MARGIN = 96, 64, 5  # px
POSES = 48
# The view of the other small pictures: web/src/report/plot/thumbnail.tsx.
VIEW = np.array([(-0.6, 0.8, 0.0), (-0.36, -0.27, 0.89)])
NEAR = 0.5  # px; joints that are never farther apart are drawn as one


def sketch(trajectory: Trajectory, robot: ShownRobot) -> dict[str, Any]:
    """Return {"poses": P lists of x0, y0, x1, y1, ... px}, evenly spaced in time.

    Points are the robot's joints, base first, and the tool; y points down. All poses of a drawing
    have one scale, which fits its box of WIDTH x HEIGHT.
    """
    origin = f"{robot.model}.urdf"
    root = urdf.parse(robot.urdf, origin)
    links = {link.get("name") for link in root.iterfind("link")}
    last = {joint.name: joint.child for joint in urdf.joints(root, origin)}
    chain, _ = urdf.chain(root, TIP if TIP in links else last[robot.joints[-1].name], origin)
    frames = np.linspace(0, trajectory.frame_count - 1, POSES).round().astype(int)
    links_at = chain.links(trajectory.positions[frames])
    places = np.stack([T_base_link[:, :3, 3] for T_base_link in links_at.values()], axis=1)
    flat = places @ VIEW.T
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    room = np.array([WIDTH, HEIGHT]) - 2 * MARGIN
    scale = float((room / np.maximum(high - low, 1e-3)).min())
    x, y = np.moveaxis((flat - (low + high) / 2) * scale, -1, 0)
    points = np.stack([WIDTH / 2 + x, HEIGHT / 2 - y], axis=-1)
    steps = np.linalg.norm(np.diff(points, axis=1), axis=-1).max(axis=0)
    kept = points[:, [True, *(steps > NEAR)]]
    return {"poses": kept.reshape(POSES, -1).round(1).tolist()}
