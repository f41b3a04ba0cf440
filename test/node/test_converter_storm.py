"""A class that uploads at once, with bombs, a truncated file and killed processes among it."""

from __future__ import annotations

import io
import threading
import time
import zlib

import numpy as np
import psutil
import pytest
import scipy.io
from graph import Graph, wait_for
from kept import Kept
from mrlab_msgs import srv

from mrlab_ros.adapters.workspaces.reader import MiB
from mrlab_ros.messages import qos
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.nodes.lab.node import LabNode

UPLOADS = 150
LIMIT = 120.0  # s; a busy machine too ends far below


def workspace(seed: int, rows: int = 100) -> tuple[bytes, np.ndarray]:
    u = np.linspace(0, 1, rows)[:, None]
    q = (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.1 - seed * 1e-4
    file = io.BytesIO()
    scipy.io.savemat(file, {"q": q, "fs": 100.0}, do_compression=True)
    return file.getvalue(), q


def zeros(size: int) -> bytes:
    """A v7 workspace of some kB whose one matrix q has `size` bytes of zeros."""
    header = bytearray(b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM")
    rows = size // 48

    def element(kind: int, data: bytes) -> bytes:
        return np.array([kind, len(data)], "<u4").tobytes() + data + bytes(-len(data) % 8)

    head = element(6, np.array([6, 0], "<u4").tobytes())
    head += element(5, np.array([rows, 6], "<i4").tobytes()) + element(1, b"q")
    values = np.array([9, rows * 48], "<u4").tobytes()
    total = len(head) + 8 + rows * 48
    packer = zlib.compressobj(9)
    packed = packer.compress(np.array([14, total], "<u4").tobytes() + head + values)
    left = rows * 48
    while left:
        packed += packer.compress(bytes(min(left, MiB)))
        left -= min(left, MiB)
    packed += packer.flush()
    return bytes(header) + np.array([15, len(packed)], "<u4").tobytes() + packed


@pytest.fixture
def lab(graph: Graph, tmp_path):
    graph.add(LabNode)
    return graph.add(ConverterNode, state_dir=str(tmp_path / "state"), time_limit=8.0)


def workers() -> list[psutil.Process]:
    found = psutil.Process().children(recursive=True)
    return [p for p in found if p.is_running()]


def test_every_upload_is_answered_and_the_honest_ones_rightly(graph, lab, tmp_path):
    honest = {f"run{i}": workspace(i) for i in range(UPLOADS - 3)}
    bomb = zeros(600 * MiB)
    assert len(bomb) < MiB
    client = graph.client.create_client(
        srv.ConvertTrajectory, "/converter/convert", qos_profile=qos.SERVICES
    )
    scenes = graph.client.create_client(
        srv.ListScenes, "/lab/list_scenes", qos_profile=qos.SERVICES
    )
    for each in (client, scenes):
        assert each.wait_for_service(LIMIT)

    changing = tmp_path / "changing.mat"
    changing.write_bytes(workspace(0, 20_000)[0])
    stop = threading.Event()

    def truncate() -> None:
        content = changing.read_bytes()
        while not stop.is_set():
            changing.write_bytes(content[:1000])
            changing.write_bytes(content)

    peak = [0]

    def watch() -> None:
        while not stop.wait(0.05):
            total = 0
            for process in workers():
                try:
                    total += process.memory_full_info().pss
                except (psutil.Error, OSError):
                    continue
            peak[0] = max(peak[0], total)

    threads = [threading.Thread(target=work) for work in (truncate, watch)]
    for thread in threads:
        thread.start()
    try:
        asked = {}
        for name in ("bomb1", "bomb2"):
            asked[name] = client.call_async(
                srv.ConvertTrajectory.Request(
                    data=bomb, file_name=f"{name}.mat", robot_model="ur5e"
                )
            )
        asked["changing"] = client.call_async(
            srv.ConvertTrajectory.Request(path=str(changing), robot_model="ur5e")
        )
        for name, (data, _) in honest.items():
            asked[name] = client.call_async(
                srv.ConvertTrajectory.Request(
                    data=data, file_name=f"{name}.mat", robot_model="ur5e"
                )
            )
        wait_for(lambda: sum(f.done() for f in asked.values()) > 10, "the first answers", LIMIT)
        (first, *_) = [p for p in psutil.Process().children() if p.is_running()]
        first.kill()
        deadline = time.monotonic() + LIMIT
        while not all(asked[name].done() for name in honest):
            assert time.monotonic() < deadline, "some uploads were never answered"
            listed = scenes.call_async(srv.ListScenes.Request())
            wait_for(listed.done, "another service of the lab", LIMIT)
        wait_for(lambda: all(f.done() for f in asked.values()), "every answer", LIMIT)
    finally:
        stop.set()
        for thread in threads:
            thread.join()
    kept = Kept(lab.trajectories.catalogue, lab.trajectories.files)
    for name, (_, q) in honest.items():
        answer = asked[name].result()
        assert answer.success, answer.message
        assert answer.trajectory.id == name
        np.testing.assert_array_equal(kept.load(name).positions, q)
    for name in ("bomb1", "bomb2"):
        assert (asked[name].result().success, asked[name].result().code) == (False, "too_large")
    # read while it was whole, or while it was cut
    answer = asked["changing"].result()
    assert answer.success or answer.code in ("unreadable", "unsupported_format")
    assert peak[0] < 3 * 2048 * MiB
    listed = graph.call(srv.ListTrajectories, "/converter/list").trajectories
    assert {t.id for t in listed} - {"changing"} == set(honest)
