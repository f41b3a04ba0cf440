"""Fuzz the opening of MATLAB's objects, each file in a process of its own.

    python test/fuzz/fuzz_objects.py --runs 100000

mat-io's parser is written in Cython and can crash on damaged bytes, as scipy's can. So each
mutation is read in a forked process under limits of memory and time, as the lab reads files. A
process may read, refuse or die; none may pass its limits, and what is read of a v7 file must be
what the whole file holds.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import random
import resource
import signal
from collections import Counter

import fuzz_matfile
import matlab_objects as matlab
import numpy as np
from differential import Matrices

from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.adapters.workspaces import file_formats

SECONDS = 10  # of processor time, for one small file
MEMORY = 1 << 30  # bytes
READ, REFUSED, DIFFERENT, FAILED = range(4)
NAMES = {READ: "read", REFUSED: "refused", DIFFERENT: "different", FAILED: "failed"}


def seeds() -> list[bytes]:
    """Return files with objects of every kind that is opened, v7, v6 and v7.3."""
    q = np.arange(60.0).reshape(10, 6) / 10
    times = np.arange(10) / 50
    series = matlab.timeseries(q, times, name="q", unit="rad")
    link = {name: np.float64(0.1) for name in ("a", "d", "alpha", "offset", "mdh")}
    robot = matlab.obj(
        "SerialLink",
        name="arm",
        links=matlab.cell(*[matlab.obj("Link", **link)] * 3),
        base=matlab.obj("SE3", data=np.eye(4)),
    )
    content = {
        "ts": series,
        "out": matlab.simulation_output(logsout=matlab.dataset(matlab.signal(series, "q"))),
        "T": matlab.table({"q1": q[:, [0]], "q2": q[:, [1]]}, ["rad", "rad"]),
        "TT": matlab.timetable({"q": q}, matlab.datetime(times + 0.0003)),
        "m": matlab.MatlabContainerMap({"q": q}),
        "s": matlab.string("text"),
        "robot": robot,
        "run": matlab.obj("Run", q=q, inner=matlab.struct(more=matlab.cell(q, "x"))),
    }
    return [matlab.saved(version, **content) for version in ("v7", "v6", "v7.3")]


def outcome(data: bytes, expected: Matrices | None) -> str:
    """Read a file in a process of its own; return how it ended."""
    child = os.fork()
    if child == 0:
        faulthandler.disable()
        code = FAILED
        try:
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
            memory = restrictions.address_space() + MEMORY
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
            code = _read(data, expected)
        finally:
            os._exit(code)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return NAMES.get(code) or signal.Signals(-code).name


def _read(data: bytes, expected: Matrices | None) -> int:
    found = Matrices()
    try:
        file_formats.read(memoryview(data), "fuzz.mat", found, fuzz_matfile.LIMIT)
    except fuzz_matfile.EXPECTED:
        return REFUSED
    for path, values in found.items() if expected else ():
        if not np.array_equal(expected.get(path, values), values):
            return DIFFERENT
    return READ


def compare(runs: int, seed: int) -> Counter[str]:
    """Read `runs` mutations; return how many ended in which way."""
    chance = random.Random(seed)
    originals = seeds()
    whole = []
    for data in originals:
        found = Matrices()
        file_formats.read(memoryview(data), "fuzz.mat", found, fuzz_matfile.LIMIT)
        whole.append(found)
    ends: Counter[str] = Counter()
    for number in range(runs):
        which = number % len(originals)
        mutation = fuzz_matfile.mutated(originals[which], chance)
        # only v7 has a checksum of everything
        ends[outcome(mutation, whole[which] if which == 0 else None)] += 1
    return ends


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    ends = compare(options.runs, options.seed)
    print(", ".join(f"{count} {name}" for name, count in ends.most_common()))


if __name__ == "__main__":
    main()
