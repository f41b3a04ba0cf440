"""Conversion beside the least it could cost, a class that uploads at once, and the readers.

"ratio": ms of a whole conversion by those of scipy.io.loadmat and orjson.dumps in the same run; at
most 3 at 1,000,000 frames. "all" dumps every number of the trajectory file (t, q, dq, tau_proxy,
gripper), which is what the conversion writes; "q" the joint positions alone, a third of that. The
conversion is whole: in the sandbox a copy of the file is hashed, read, read again by the second
reader, checked and derived, and the catalogue's file is written; the lab's process reads that and
writes JSON. "stored" is the same without JSON, as in a running lab. MB/s are of the matrix. "peak"
is the memory of all processes above what they held before, in a run of its own; "bound" is four
times the matrix plus the file that is written.
"""

from __future__ import annotations

import io
import os
import tempfile
import threading
import time
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import psutil
import scipy.io
from lab import LIBRARY, MODEL, Lab, catalogue, running
from mrlab_msgs import srv
from mrlab_msgs.srv import SetLoop, Trigger
from partner import Failed
from sensor_msgs.msg import JointState
from size import Size

from mrlab_ros.adapters import share
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles, load_coefficients
from mrlab_ros.adapters.workspaces.matlab import mat5, second_reader
from mrlab_ros.adapters.workspaces.reader import (
    ConversionPool,
    Limits,
    WorkspaceReader,
    in_memory,
    opened,
)
from mrlab_ros.adapters.workspaces.results import Task
from mrlab_ros.adapters.workspaces.sinks import Found
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.trajectory.catalogue import TrajectoryName
from mrlab_ros.core.trajectory.document import document
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos

NEEDS = ()
CLASS = 150
SIZES = (1_000, 10_000, 100_000, 1_000_000)
SERVICES = {"/lab/list_scenes": srv.ListScenes, "/converter/list": srv.ListTrajectories}
UPLOADED_S = 300.0


def motion(frames: int) -> Any:
    """Return (frames, 7): sines of six joints inside any arm's range, and a gripper."""
    t = np.arange(frames) / 100
    arm = 0.3 * np.sin(t[:, None] * np.linspace(0.2, 0.7, 6)) + 0.1
    return np.column_stack([arm, (t % 20) > 10])


def task(name: str, options: Options) -> Task:
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    return Task(name, options, LIBRARY.model(MODEL), coefficients, None, "", 0, 100.0)


@contextmanager
def peak_memory() -> Iterator[list[int]]:
    """Yield a list whose only value becomes the most bytes above those at the start."""
    peak, ended, start = [0], threading.Event(), _memory()

    def watch() -> None:
        while not ended.wait(0.01):
            peak[0] = max(peak[0], _memory() - start)

    thread = threading.Thread(target=watch)
    thread.start()
    try:
        yield peak
    finally:
        ended.set()
        thread.join()


def _memory() -> int:
    total = 0
    for process in [psutil.Process(), *psutil.Process().children(recursive=True)]:
        try:
            total += process.memory_full_info().pss
        except psutil.Error:
            continue
    return total


def best_ms(work: Callable[[], Any], repeats: int, clock: Callable[[], float]) -> float:
    """Return the least time of `repeats` runs, ms."""
    times = []
    for _ in range(repeats):
        begin = clock()
        work()
        times.append(clock() - begin)
    return min(times) * 1e3


def conversion(frames: int, reader: WorkspaceReader, folder: Path, repeats: int) -> dict[str, Any]:
    path = folder / f"n{frames}.mat"
    size = frames * 7 * 8
    scipy.io.savemat(path, {"q": motion(frames)}, do_compression=True)
    store = catalogue(folder)
    files = TrajectoryFiles(store.store, folder / "fetched")
    this, target = task(path.name, Options(frame_rate=100.0)), folder / "written.json"

    def stored() -> str:
        return convert(reader, store, path, this)

    def whole() -> Trajectory:
        trajectory = files.load(*store.find(stored()))
        formats.write(trajectory, target)
        return trajectory

    def ms(work: Callable[[], Any]) -> float:
        return best_ms(work, repeats, time.perf_counter)

    without, ours = ms(stored), ms(whole)
    with peak_memory() as peak:
        trajectory = whole()
    numbers = document(trajectory)["frames"]
    load = ms(lambda: scipy.io.loadmat(path)["q"].sum())
    every, alone = ms(lambda: dumps(numbers)), ms(lambda: dumps(numbers["q"]))
    return {
        "frames": frames,
        "whole ms": ours,
        "stored ms": without,
        "loadmat ms": load,
        "dumps all ms": every,
        "dumps q ms": alone,
        "ratio all": ours / (load + every),
        "ratio q": ours / (load + alone),
        "MB/s": size / ours / 1e3,
        "us/frame": 1e3 * ours / frames,
        "peak MB": peak[0] / 1e6,
        "bound MB": (4 * size + target.stat().st_size) / 1e6,
    }


def dumps(numbers: Any) -> bytes:
    return orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY)


def convert(reader: WorkspaceReader, store: CatalogueWriter, path: Path, this: Task) -> str:
    """Convert a file into the store; return the trajectory's id."""
    with opened(path) as source, tempfile.TemporaryFile() as file:
        converted = reader.convert(source, this, file)
        assert converted.head is not None, converted.message
        name = str(converted.head["id"])
        store.publish(TrajectoryName("", name), converted.head, file)
        return name


def conversions(size: Size) -> list[dict[str, Any]]:
    rows = []
    with WorkspaceReader() as reader, tempfile.TemporaryDirectory() as folder:
        conversion(100, reader, Path(folder), 1)
        for frames in size.some(SIZES):
            repeats = size.of(1, 1, 3) if frames > 10_000 else 5
            rows.append(conversion(frames, reader, Path(folder), repeats))
            os.sync()
    return rows


def submission(number: int, rows: int = 600) -> bytes:
    """Return a workspace with a motion that the robot can follow."""
    u = np.linspace(0, 1, rows)[:, None]
    q = (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.1 - number * 1e-4
    file = io.BytesIO()
    scipy.io.savemat(file, {"q": q, "fs": 100.0}, do_compression=True)
    return file.getvalue()


def processor_s() -> float:
    """Return the processor time of this process and its children, those that ended too, s."""
    processes = [psutil.Process(), *psutil.Process().children(recursive=True)]
    return float(sum(sum(process.cpu_times()[:4]) for process in processes))


def pool(size: Size) -> list[dict[str, Any]]:
    """Convert small files that arrive at once by the pool of the converter node."""
    count = size.of(2, CLASS, CLASS)
    with tempfile.TemporaryDirectory() as name, ConversionPool(Limits()) as found:
        store = catalogue(Path(name))
        paths = [Path(name) / f"student{i}.mat" for i in range(count)]
        for i, path in enumerate(paths):
            path.write_bytes(submission(i))

        def submit(path: Path) -> Any:
            return found.submit(lambda r: convert(r, store, path, task(path.name, Options())), 0)

        for future in [submit(path) for path in paths[:8]]:
            future.result()  # every process has started
        used, begin = processor_s(), time.perf_counter()
        for future in [submit(path) for path in paths]:
            future.result()
        wall, used = time.perf_counter() - begin, processor_s() - used
    return [{"files": count, "processor s": used, "goal s": 5.0, "wall s": wall}]


def cold_and_warm(size: Size) -> list[dict[str, Any]]:
    """Time the first conversion of a process, and those after it."""
    taken = []
    with WorkspaceReader() as reader:
        for i in range(size.of(2, 6, 31)):
            begin = time.perf_counter()
            with in_memory(submission(i)) as source, tempfile.TemporaryFile() as stored:
                assert reader.convert(source, task("s.mat", Options()), stored).head is not None
            taken.append((time.perf_counter() - begin) * 1e3)
    return [{"cold ms": taken[0], "warm ms": float(np.median(taken[1:]))}]


def upload(number: int) -> srv.ConvertTrajectory.Request:
    return srv.ConvertTrajectory.Request(
        data=submission(number), file_name=f"student{number}.mat", robot_model=MODEL
    )


def meanwhile(lab: Lab, robot: str, states: list[float], going: Callable[[], bool]) -> Any:
    """Call services and pause the robot while `going`; return the figures, ms."""
    taken: dict[str, list[float]] = {name: [] for name in (*SERVICES, "pause")}
    gaps: list[float] = []
    while going():
        for name, kind in SERVICES.items():
            taken[name].append(lab.ms(kind, name))
        begin = len(states)
        time.sleep(0.3)
        gaps += list(np.diff(states[begin:]) * 1e3)
        taken["pause"].append(lab.ms(Trigger, f"/{robot}/pause"))
        lab.ask(Trigger, f"/{robot}/play")
    figures: dict[str, float] = {"calls": len(taken["pause"])}
    for name, values in taken.items():
        figures[f"{name} p50 ms"] = float(np.median(values))
        figures[f"{name} p95 ms"] = float(np.percentile(values, 95))
    return figures | {"longest gap ms": max(gaps, default=0.0)}


def uploads(size: Size) -> list[dict[str, Any]]:
    """Upload a class into a lab in which a robot plays: other services and a pause < 100 ms."""
    count = size.of(10, CLASS, CLASS)
    with (
        tempfile.TemporaryDirectory() as folder,
        running(Path(folder), ("lab", "playback"), robots=1) as lab,
    ):
        robot = f"{MODEL}_1"
        client = lab.client(srv.ConvertTrajectory, "/converter/convert")
        client.wait_for_service(60.0)
        first = client.call(upload(count))
        lab.ask(srv.LoadTrajectory, f"/{robot}/load", id=first.trajectory.id)
        states: list[float] = []
        lab.subscribe(
            JointState, f"/{robot}/joint_states", lambda _: states.append(time.monotonic()),
            qos.STREAM,
        )  # fmt: skip
        lab.ask(SetLoop, f"/{robot}/set_loop", loop=True)
        # The first call of a service also finds it, which is not measured.
        for name, kind in SERVICES.items():
            lab.ask(kind, name)
        for order in ("play", "pause", "play"):
            lab.ask(Trigger, f"/{robot}/{order}")
        end = time.monotonic() + size.of(1.0, 5.0, 5.0)
        idle = meanwhile(lab, robot, states, lambda: time.monotonic() < end)
        begin = time.monotonic()
        asked = [client.call_async(upload(i)) for i in range(count)]

        def waits() -> bool:
            return not all(f.done() for f in asked) and time.monotonic() < begin + UPLOADED_S

        busy = meanwhile(lab, robot, states, waits)
        took = time.monotonic() - begin
    wrong = sum(not (f.done() and f.result().success) for f in asked)
    if wrong:
        raise Failed(f"{wrong} of {count} uploads were not accepted")
    rows = [{"figure": key, "idle": idle[key], f"{count} uploads": busy[key]} for key in idle]
    return [*rows, {"figure": "all answered s", "idle": 0.0, f"{count} uploads": took}]


class LastMatrix:
    """A sink that keeps the last matrix."""

    def add(self, found: Found) -> None:
        if found.data is not None:
            self.values = np.frombuffer(found.data, found.dtype).reshape(found.shape, order="F")


def readers(size: Size) -> list[dict[str, Any]]:
    """Compare the processor time of our reader of v7, its checksum, scipy's and the second one."""
    return [read(count, size.of(1, 1, 3)) for count in size.some(SIZES)]


def read(count: int, repeats: int) -> dict[str, Any]:
    matrix, file, sink = motion(count), io.BytesIO(), LastMatrix()
    scipy.io.savemat(file, {"q": matrix}, do_compression=True)
    data, numbers = memoryview(file.getvalue()), matrix.tobytes()
    works: dict[str, Callable[[], Any]] = {
        "ours": lambda: mat5.Mat5Reader(sink, 1 << 30).read(data),
        "adler": lambda: zlib.adler32(numbers),
        "scipy": lambda: scipy.io.loadmat(io.BytesIO(data)),
        "second": lambda: second_reader.disagreement(data, "q", sink.values),
    }
    spent = {f"{k} ms": best_ms(w, repeats, time.process_time) for k, w in works.items()}
    return {"rows": count, "MB": len(data) / 1e6, **spent}


TABLES = {
    "Conversion of a v7 workspace, N x 7, to a trajectory file": conversions,
    "A class that submits at once, 600 x 6": pool,
    "The first conversion of a process and those after it, 600 x 6": cold_and_warm,
    "The rest of the lab while a class uploads": uploads,
    "Reading a v7 workspace, N x 7": readers,
}
