"""End-to-end conversion beside the least it could cost, in the same run.

The yardstick is scipy.io.loadmat of the file plus orjson.dumps of the same numbers, which can be
read in two ways; both ratios are shown. "all" dumps every number of the trajectory file (t, q,
dq, tau_proxy, gripper), which is what the conversion writes; "q" dumps the joint positions alone,
a third of that. The conversion is whole: behind the wall a copy of the file is hashed, read, read
again by the second reader, checked and derived, and the catalogue's file is written; the lab's
process reads that and writes JSON. "stored" is the same without JSON, as in a running lab. Memory
is the peak of all processes above what they held before, in a run of its own; its bound is four
times the matrix plus the file that is written.

"class": 150 submissions of 600 x 6 by as many clients at once, converted by the pool of the
converter node; to reach: less than 5 s of processor time of all processes together.
"""

from __future__ import annotations

import os
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import psutil
import report
import scipy.io

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles, load_coefficients
from mrlab_ros.adapters.workspaces.reader import ConversionPool, Limits, WorkspaceReader, opened
from mrlab_ros.adapters.workspaces.results import Task
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.trajectory.catalogue import TrajectoryName
from mrlab_ros.core.trajectory.document import document
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.ros import share

SAME_NUMBERS = """\
ratio = ms / (loadmat + dumps of the same numbers); to reach: at most 3 at 1,000,000 frames.
"all": the same numbers as are written: t, q, dq, tau_proxy, gripper. "q": the positions alone,
which leaves out two thirds of what the conversion derives and writes.
MB/s: of the matrix, end to end. bound: four times the matrix plus the file written."""
CLASS = 150


def motion(frames: int) -> Any:
    """Return (frames, 7): sines of six joints inside any arm's range, and a gripper."""
    t = np.arange(frames) / 100
    arm = 0.3 * np.sin(t[:, None] * np.linspace(0.2, 0.7, 6)) + 0.1
    return np.column_stack([arm, (t % 20) > 10])


class PeakMemory:
    """Samples the memory of this process and its children above what it was at the start."""

    def __enter__(self) -> PeakMemory:
        self.peak, self._stop = 0, threading.Event()
        self._start = self._now()
        self._thread = threading.Thread(target=self._watch)
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()

    def _now(self) -> int:
        total = 0
        for process in [psutil.Process(), *psutil.Process().children(recursive=True)]:
            try:
                total += process.memory_full_info().pss
            except psutil.Error:
                continue
        return total

    def _watch(self) -> None:
        while not self._stop.wait(0.01):
            self.peak = max(self.peak, self._now() - self._start)


def timed(work: Any, repeats: int) -> tuple[float, Any]:
    """Return the shortest time of `repeats` runs, s, and the last result."""
    best = np.inf
    for _ in range(repeats):
        begin = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - begin)
    return float(best), result


def measure(frames: int, reader: WorkspaceReader, folder: Path, repeats: int) -> dict[str, Any]:
    path = folder / f"n{frames}.mat"
    matrix = motion(frames)
    size = matrix.nbytes
    scipy.io.savemat(path, {"q": matrix}, do_compression=True)
    del matrix
    robot = RobotLibrary(share.directory() / "robots").model("ur5e")
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    store = opened_catalogue(folder / "store")
    files = TrajectoryFiles(store.store, folder / "fetched")
    task = Task(path.name, Options(frame_rate=100.0), robot, coefficients, None, "", 0, 100.0)
    target = folder / "written.json"

    def stored() -> str:
        return convert(reader, store, path, task)

    def whole() -> Trajectory:
        trajectory = files.load(*store.find(stored()))
        formats.write(trajectory, target)
        return trajectory

    without, _ = timed(stored, repeats)
    ours, trajectory = timed(whole, repeats)
    del trajectory
    with PeakMemory() as memory:
        trajectory = whole()
    written = target.stat().st_size
    numbers = document(trajectory)["frames"]
    load, _ = timed(lambda: scipy.io.loadmat(path)["q"].sum(), repeats)
    same, _ = timed(lambda: len(dumps(numbers)), repeats)
    alone, _ = timed(lambda: len(dumps(numbers["q"])), repeats)
    return {
        "frames": frames,
        "ms": round(ours * 1e3, 1),
        "stored ms": round(without * 1e3, 1),
        "loadmat ms": round(load * 1e3, 1),
        "dumps all": round(same * 1e3, 1),
        "dumps q": round(alone * 1e3, 1),
        "ratio all": ours / (load + same),
        "ratio q": ours / (load + alone),
        "MB/s": size / ours / 1e6,
        "us/frame": ours / frames * 1e6,
        "peak MB": round(memory.peak / 1e6),
        "bound MB": round((4 * size + written) / 1e6),
    }


def opened_catalogue(folder: Path) -> CatalogueWriter:
    catalogue = CatalogueWriter(open_store(str(folder)))
    catalogue.open()
    return catalogue


def convert(reader: WorkspaceReader, store: CatalogueWriter, path: Path, task: Task) -> str:
    """Convert a file into the store; return the trajectory's id."""
    with opened(path) as source, tempfile.TemporaryFile() as file:
        converted = reader.convert(source, task, file)
        assert converted.head is not None, converted.message
        name = str(converted.head["id"])
        store.publish(TrajectoryName("", name), converted.head, file)
        return name


def processor_time() -> float:
    """Return the processor time of this process and its children, those that ended too, s."""
    total = 0.0
    for process in [psutil.Process(), *psutil.Process().children(recursive=True)]:
        times = process.cpu_times()
        total += times.user + times.system + times.children_user + times.children_system
    return total


def submissions(folder: Path, count: int) -> dict[str, Any]:
    """Convert `count` files that arrive at once."""
    robot = RobotLibrary(share.directory() / "robots").model("ur5e")
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    store = opened_catalogue(folder / "class")
    paths = []
    for i in range(count):
        paths.append(folder / f"student{i}.mat")
        content = {"q": motion(600)[:, :6] + i * 1e-4, "fs": 100.0}
        scipy.io.savemat(paths[-1], content, do_compression=True)

    def task(path: Path) -> Task:
        return Task(path.name, Options(), robot, coefficients, None, "", 0, 100.0)

    with ConversionPool(Limits()) as pool:

        def submit(path: Path) -> Any:
            return pool.submit(lambda r: convert(r, store, path, task(path)), 0)

        for future in [submit(path) for path in paths[:8]]:
            future.result()  # every process has started
        used, begin = processor_time(), time.perf_counter()
        for future in [submit(path) for path in paths]:
            future.result()
        wall, used = time.perf_counter() - begin, processor_time() - used
    return {"files": count, "processor s": used, "goal s": 5.0, "wall s": wall}


def dumps(numbers: Any) -> bytes:
    return orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY)


def main() -> None:
    options = report.options(__doc__).parse_args()
    repeats = report.scaled(options, 1, 1, 3)
    rows = []
    with WorkspaceReader() as reader, tempfile.TemporaryDirectory() as folder:
        reader.start()
        measure(100, reader, Path(folder), 1)
        for frames in report.some(options, (1_000, 10_000, 100_000, 1_000_000)):
            fewer = repeats if frames > 10_000 else 5
            rows.append(measure(frames, reader, Path(folder), fewer))
            os.sync()
        students = submissions(Path(folder), report.scaled(options, 2, CLASS, CLASS))
    report.show("Conversion of a v7 workspace, N x 7, to a trajectory file", rows, options.json)
    print(SAME_NUMBERS)
    report.show("A class that submits at once", [students], options.json)


if __name__ == "__main__":
    main()
