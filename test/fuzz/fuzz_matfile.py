"""Fuzz the readers of files from outside: they refuse or read, and do nothing else.

    python test/fuzz/fuzz_matfile.py --runs 100000     a bounded run, without any extra package
    python test/fuzz/fuzz_matfile.py --atheris CORPUS -max_total_time=3600
                                                       coverage-guided, needs atheris; options of
                                                       libFuzzer follow the folder

The seeds are made here, by this project's own writers, with every kind of variable in them. In a
corpus the first byte of an input chooses the file's name, as the name chooses some readers.
"""

from __future__ import annotations

import argparse
import gzip
import inspect
import io
import random
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import scipy.io
from fakes import make_trajectory
from found_matrices import matrix
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore

from mrlab_ros.adapters.workspaces import file_formats, joint_trajectories
from mrlab_ros.adapters.workspaces.matlab import mat5, mat73
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, NotAWorkspace, TooLarge
from mrlab_ros.adapters.workspaces.sinks import Found
from mrlab_ros.adapters.workspaces.tables import table
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY

LIMIT = 1 << 24
NAMES = ("fuzz.mat", "fuzz.npz", "fuzz.csv", "fuzz.cdr")
EXPECTED = (Damaged, TooLarge, NotAWorkspace, MemoryError)


class Discard:
    """A sink that keeps nothing but checks that each matrix has the bytes it says."""

    def add(self, found: Found) -> None:
        matrix(found)


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
    trajectory = make_trajectory()
    files.append(("seed.cdr", joint_trajectories.serialized(trajectory)))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "seed.mcap")
        joint_trajectories.write_bag(trajectory, path)
        files.append((path.name, path.read_bytes()))
        with Writer(Path(folder, "seed"), version=9) as writer:
            topic = writer.add_connection(
                "/q", JOINT_TRAJECTORY, typestore=get_typestore(Stores.ROS2_JAZZY)
            )
            writer.write(topic, 1, joint_trajectories.serialized(trajectory))
        files.append(("seed.db3", Path(folder, "seed", "seed.db3").read_bytes()))
    return files


def one(data: bytes, name: str = "fuzz.mat") -> bool:
    """Read `data`; return whether it was taken. Anything but a refusal is raised."""
    try:
        file_formats.read(memoryview(data), name, Discard(), LIMIT)
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


def guided(corpus: Path, options: list[str]) -> None:
    """Run libFuzzer on the folder `corpus`, with the seeds in it; does not return."""
    import atheris

    corpus.mkdir(parents=True, exist_ok=True)
    for number, (name, data) in enumerate(seeds()):
        kind = next((i for i, n in enumerate(NAMES) if Path(n).suffix == Path(name).suffix), 0)
        (corpus / f"seed-{number}").write_bytes(bytes([kind]) + data)
    # the rest of what is loaded would take minutes and teach the fuzzer nothing
    for module in (joint_trajectories, mat5, mat73, file_formats, table):
        for name, member in vars(module).items():
            if inspect.isfunction(member) and member.__module__ == module.__name__:
                setattr(module, name, atheris.instrument_func(member))
            elif inspect.isclass(member) and member.__module__ == module.__name__:
                for part, method in vars(member).items():
                    if inspect.isfunction(method):
                        setattr(member, part, atheris.instrument_func(method))

    def target(data: bytes) -> None:
        one(data[1:], NAMES[data[0] % len(NAMES)] if data else NAMES[0])

    atheris.Setup([sys.argv[0], str(corpus), *options], target)
    atheris.Fuzz()


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--atheris", type=Path, metavar="CORPUS")
    options, rest = parser.parse_known_args()
    if options.atheris is not None:
        guided(options.atheris, rest)
    taken, refused = bounded(options.runs, options.seed)
    print(f"{options.runs} mutations: {taken} read, {refused} refused, nothing else")


if __name__ == "__main__":
    main()
