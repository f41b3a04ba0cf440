"""Fuzz the readers of workspace files: they refuse or read, and do nothing else.

    python test/fuzz/fuzz_matfile.py --runs 100000     a bounded run, without any extra package
    python test/fuzz/fuzz_matfile.py --atheris CORPUS  coverage-guided, needs atheris; the
                                                       options of libFuzzer may follow

The seeds are made here, by this project's own writers, with every kind of variable in them.
"""

from __future__ import annotations

import argparse
import gzip
import io
import random
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import scipy.io

from mrlab_ros.adapters import matfile_worker
from mrlab_ros.adapters.matfile import Damaged, NotAWorkspace, TooLarge

LIMIT = 1 << 24
EXPECTED = (Damaged, TooLarge, NotAWorkspace, MemoryError)


class Discard:
    """A sink that keeps nothing but checks that each matrix has the bytes it says."""

    def add(
        self,
        path: str,
        kind: str,
        shape: tuple[int, ...],
        data: memoryview | bytes | None = None,
        dtype: str = "",
        *,
        is_object: bool = False,
        note: str = "",
    ) -> None:
        if data is not None:
            np.frombuffer(data, dtype).reshape(shape, order="F")


def seeds() -> list[tuple[str, bytes]]:
    """Return (file name, bytes) of small files of every format."""
    q = np.arange(60.0).reshape(10, 6)
    cells = np.empty((1, 2), object)
    cells[:] = [[q, "text"]]
    pair = np.zeros((1, 2), dtype=[("q", object)])
    pair[0, 0] = pair[0, 1] = (q,)
    content = {"q": q, "i": q.astype(np.int16), "z": q * 1j, "c": cells, "s": pair}
    content["e"], content["p"] = np.zeros((0, 6)), scipy.sparse.csc_matrix(np.eye(3))
    files = []
    for form, compressed in (("5", False), ("5", True), ("4", False)):
        buffer = io.BytesIO()
        chosen = {"q": q, "z": q * 1j, "t": "text"} if form == "4" else content
        scipy.io.savemat(buffer, chosen, format=form, do_compression=compressed)
        files.append(("seed.mat", buffer.getvalue()))
    files.append(("seed.mat.gz", gzip.compress(files[0][1])))
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        file.create_dataset("q", data=q.T).attrs["MATLAB_class"] = np.bytes_("double")
        group = file.create_group("s")
        group.create_dataset("q", data=q.T, chunks=True, compression="gzip")
    files.append(("seed.mat", buffer.getvalue()))
    buffer = io.BytesIO()
    np.savez(buffer, q=q, fs=50.0)
    files.append(("seed.npz", buffer.getvalue()))
    files.append(("seed.csv", b"t,a,b\n0,1,2\n0.1,3,4\n"))
    return files


def one(data: bytes, name: str = "fuzz.mat") -> bool:
    """Read `data`; return whether it was taken. Anything but a refusal is raised."""
    try:
        matfile_worker.read(memoryview(data), name, Discard(), LIMIT)
    except EXPECTED:
        return False
    return True


def mutated(data: bytes, chance: random.Random) -> bytes:
    """Return a copy with some bytes changed, cut out, doubled or set to telling values."""
    copy = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        at = chance.randrange(len(copy)) if copy else 0
        kind = chance.randrange(5)
        if kind == 0 and copy:
            copy[at] = chance.randrange(256)
        elif kind == 1 and copy:
            copy[at] ^= 1 << chance.randrange(8)
        elif kind == 2:
            del copy[at : at + chance.randrange(1, 64)]
        elif kind == 3:
            copy[at:at] = copy[at : at + chance.randrange(1, 64)]
        else:
            value = chance.choice((0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFF8))
            copy[at : at + 4] = value.to_bytes(4, chance.choice(("little", "big")))
    return bytes(copy)


def bounded(runs: int, seed: int) -> tuple[int, int]:
    """Try `runs` mutations; return how many were taken and how many refused."""
    chance = random.Random(seed)
    files = seeds()
    taken = 0
    for number in range(runs):
        name, data = files[number % len(files)]
        mutation = mutated(data, chance)
        try:
            taken += one(mutation, name)
        except Exception:
            Path(f"crash-{seed}-{number}").write_bytes(mutation)
            raise
    return taken, runs - taken


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--atheris", type=Path, metavar="CORPUS")
    options, rest = parser.parse_known_args()
    if options.atheris is None:
        taken, refused = bounded(options.runs, options.seed)
        print(f"{options.runs} mutations: {taken} read, {refused} refused, nothing else")
        return
    import atheris

    options.atheris.mkdir(parents=True, exist_ok=True)
    for number, (_, data) in enumerate(seeds()):
        (options.atheris / f"seed-{number}").write_bytes(data)
    atheris.instrument_all()

    def target(data: Any) -> None:
        one(bytes(data))

    atheris.Setup([sys.argv[0], str(options.atheris), *rest], target)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
