"""Batch forward kinematics of 100 000 poses, and the time to load each robot.

Prints one line a robot: ms for the batch, million poses a second, ms to read model, URDF and
meshes. `--quick` takes 10 000 poses.
"""

from __future__ import annotations

import time

import numpy as np
import report
import trimesh

from mrlab_ros.adapters.robots import checks, urdf
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.ros import share

LOAD_BOUND_MS = 300.0


def best(job: object, repeats: int) -> float:
    """Return the shortest time of `repeats` calls, s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        job()  # type: ignore[operator]
        times.append(time.perf_counter() - start)
    return min(times)


def load(robot: str) -> None:
    """Read a robot as a fresh process would: model, URDF and every mesh."""
    library = RobotLibrary(share.directory() / "robots")
    library.model(robot)
    root = urdf.parse(library.description(robot), robot)
    for mesh in checks.meshes(root):
        path = library.mesh_path(str(mesh.get("filename")))
        if path.suffix == ".glb":
            trimesh.load_scene(path)


def main() -> None:
    """Measure all robots and say whether loading keeps its bound."""
    given = report.options(__doc__.splitlines()[0]).parse_args()
    count = report.scaled(given, 100, 10_000, 100_000)
    library = RobotLibrary(share.directory() / "robots")
    rng = np.random.default_rng(0)
    total, slowest = 0.0, 0.0
    for robot in library.ids():
        model = library.model(robot)
        low = [joint.lower for joint in model.joints]
        high = [joint.upper for joint in model.joints]
        poses = rng.uniform(low, high, (count, len(low)))
        seconds = best(lambda m=model, q=poses: m.chain.tool0(q), 3)
        loading = best(lambda r=robot: load(r), 2) * 1e3
        total, slowest = total + seconds, max(slowest, loading)
        rate = count / seconds / 1e6
        print(
            f"{robot:24} {seconds * 1e3:7.1f} ms for {count} poses  {rate:5.2f} M poses/s"
            f"  load {loading:6.1f} ms"
        )
    kept = "kept" if slowest < LOAD_BOUND_MS else "MISSED"
    print(f"all robots: {total:.2f} s")
    print(f"slowest load {slowest:.0f} ms, bound {LOAD_BOUND_MS:.0f} ms: {kept}")


if __name__ == "__main__":
    main()
