"""How long a robot takes to load a trajectory, and what a catalogue of many costs.

Loading: from the call of `load` to its answer. "first": the file was not read since it was
written; "again": the median of the loads after it; "message": the same frames as one answer of
/converter/get, which is what a client on another machine gets. The baseline is reading JSON.

Listing, of a catalogue half of which is shared. "http": GET /api/trajectories of a gateway, all of
them, answered and received; "page": a thousand of /converter/list_any; "list": all of them as one
answer; "announce": from a change to the latched message on /trajectories, and its size; "start":
reading the whole catalogue; "follow": a reader that asks what one change was.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from gateway_process import gateway
from lab import MODEL, Lab, catalogue, running, sine
from mrlab_msgs import msg, srv
from partner import until
from size import Size

from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.catalogue import Catalogue
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos

NEEDS = ()
# Label, frames, with a gripper, goal in ms.
SIZES = (
    ("10,000 x 6", 10_000, False, 100.0),
    ("360,000 x 6", 360_000, False, 200.0),
    ("1,000,000 x 7", 1_000_000, True, 500.0),
)
PROCESSES = ("lab", "playback")
GOAL_LIST_MS = 100.0


def ms_of(work: Callable[[], Any], repeats: int = 5) -> float:
    """Return the median time of a call, ms."""
    taken = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        taken.append((time.perf_counter() - begin) * 1e3)
    return float(np.median(taken))


def json_ms(trajectory: Trajectory) -> float:
    """Return the time to read the trajectory from JSON, ms."""
    data = b"".join(bytes(c) for c in formats.chunks(trajectory))
    return ms_of(lambda: formats.parse(data, "bench"), 1)


def written(folder: Path, size: Size) -> list[dict[str, Any]]:
    """Write the motions into a catalogue; return the figures of that."""
    kept = catalogue(folder, [sine("m100", 100)])
    files = TrajectoryFiles(kept.store, folder / "fetched")
    rows = []
    for label, frames, gripper, goal in size.some(SIZES):
        trajectory = sine(f"m{frames}", frames, gripper=gripper)
        begin = time.perf_counter()
        _, version = kept.save(trajectory)
        rows.append(
            {
                "frames": label,
                "goal ms": goal,
                "write ms": (time.perf_counter() - begin) * 1e3,
                "MB": files.path(version).stat().st_size / 1e6,
                "JSON ms": json_ms(trajectory),
            }
        )
    return rows


def loading(size: Size) -> list[dict[str, Any]]:
    with tempfile.TemporaryDirectory() as name:
        rows = written(Path(name), size)
        with running(Path(name), PROCESSES, robots=1) as lab:
            for row, (_, frames, _, _) in zip(rows, SIZES, strict=False):
                row |= loaded(lab, f"m{frames}", size.of(1, 3, 9))
    return rows


def loaded(lab: Lab, name: str, repeats: int) -> dict[str, float]:
    load = (srv.LoadTrajectory, f"/{MODEL}_1/load")
    get = (srv.GetTrajectory, "/converter/get")
    for service in (load, get):
        lab.ask(*service, id="m100")
    first, again = lab.ms(*load, id=name), []
    for _ in range(repeats):
        lab.ask(*load, id="m100")  # what was loaded is forgotten
        again.append(lab.ms(*load, id=name))
    lab.ask(*get, id="m100")
    return {
        "first ms": first,
        "again ms": float(np.median(again)),
        "max ms": max(again),
        "message ms": lab.ms(*get, id=name),
    }


def listing(size: Size) -> list[dict[str, Any]]:
    """Measure a catalogue of short trajectories of a hundred users, every second one shared."""
    entries = size.of(20, 1_000, 10_000)
    with tempfile.TemporaryDirectory() as name:
        folder, short = Path(name), sine("m", 50)
        kept = catalogue(folder)
        for i in range(entries):
            kept.save(replace(short, id=f"user{i % 100}/m{i}"), shared=i % 2 == 0)
        with running(folder, PROCESSES) as lab:
            row = {"entries": entries, **listed(lab, entries), **changed(lab, folder)}
        with gateway(folder, "tcp/127.0.0.1:9") as found:
            client = found.client
            content = client.get("/api/trajectories").content
            assert content.count(b'"id":') == entries
            row |= {
                "http ms": ms_of(lambda: client.get("/api/trajectories").content),
                "goal http ms": GOAL_LIST_MS,
                "http MB": len(content) / 1e6,
            }
    return [row]


def listed(lab: Lab, entries: int) -> dict[str, float]:
    every = (srv.ListTrajectories, "/converter/list_any")
    assert lab.ask(*every).total == entries
    return {
        "page ms": ms_of(lambda: lab.ask(*every, count=1000)),
        "list ms": ms_of(lambda: lab.ask(*every)),
    }


def changed(lab: Lab, folder: Path) -> dict[str, float]:
    """Share a trajectory and take it back; measure who hears of it, and how soon."""
    received: list[tuple[float, int]] = []
    lab.subscribe(
        msg.TrajectoryCatalogue, "/trajectories",
        lambda data: received.append((time.perf_counter(), len(data))), qos.LATCHED, raw=True,
    )  # fmt: skip
    until(lambda: received, "the catalogue's message")
    store = open_store(str(folder / "store"))
    start = ms_of(lambda: Catalogue(store).refresh(), 1)
    announced, follow, reader = [], [], Catalogue(store)
    reader.refresh()
    for number in range(6):
        time.sleep(0.3)  # what one change costs, not a burst
        before, count = time.perf_counter(), len(received)
        lab.ask(srv.ShareTrajectory, "/converter/share", id="user1/m1", shared=number % 2 == 0)
        follow.append(ms_of(reader.refresh, 1))
        until(lambda count=count: len(received) > count, "the announcement")
        announced.append((received[-1][0] - before) * 1e3)
    return {
        "announce ms": float(np.median(announced)),
        "announce MB": received[-1][1] / 1e6,
        "start ms": start,
        "follow ms": float(np.median(follow)),
    }


TABLES = {"Loading a trajectory": loading, "A catalogue of many trajectories": listing}
