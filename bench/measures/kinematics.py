"""Forward kinematics of many poses, and the time to load each robot as a fresh process would."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import trimesh
from lab import LIBRARY
from size import Size

from mrlab_ros.adapters.robots import checks, urdf
from mrlab_ros.adapters.robots.library import RobotLibrary

NEEDS = ()
LOAD_BOUND_MS = 300.0


def best_ms(job: Callable[[], object], repeats: int) -> float:
    """Return the shortest time of `repeats` calls, ms."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        job()
        times.append(time.perf_counter() - start)
    return min(times) * 1e3


def load(robot: str) -> None:
    """Read a robot: model, URDF and every mesh."""
    library = RobotLibrary(LIBRARY.folder)
    library.model(robot)
    root = urdf.parse(library.description(robot), robot)
    for mesh in checks.meshes(root):
        path = library.mesh_path(str(mesh.get("filename")))
        if path.suffix == ".glb":
            trimesh.load_scene(path)


def robots(size: Size) -> list[dict[str, Any]]:
    count = size.of(100, 10_000, 100_000)
    rng = np.random.default_rng(0)
    rows = []
    for robot in size.some(LIBRARY.ids()):
        model = LIBRARY.model(robot)
        limits = ([joint.lower for joint in model.joints], [joint.upper for joint in model.joints])
        poses = rng.uniform(*limits, (count, len(model.joints)))
        ms = best_ms(lambda m=model, q=poses: m.chain.tool0(q), 3)
        rows.append(
            {
                "robot": robot,
                "poses": count,
                "batch ms": ms,
                "M poses/s": count / ms / 1e3,
                "load ms": best_ms(lambda r=robot: load(r), 2),
                "load bound ms": LOAD_BOUND_MS,
            }
        )
    return rows


TABLES = {"Forward kinematics and loading": robots}
