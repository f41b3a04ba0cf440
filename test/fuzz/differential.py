"""Compare this project's readers with scipy and h5py on damaged files.

    python test/fuzz/differential.py --runs 100000      a longer run

Files written by scipy, Octave and h5py in v4, v6, v7 and v7.3 are mutated. Whatever our reader
takes as a matrix, the second reader must read as the same matrix, bit for bit: a file that we
read and they refuse, or read differently, is a failure. The second reader runs in a forked
process, because scipy's parser can crash on damaged bytes; a crash is counted on its own.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import pickle
import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import fuzz_matfile
from found_matrices import matrix
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.matlab import second_reader
from mrlab_ros.adapters.workspaces.sinks import Found

EXAMPLES = Path(__file__).parents[2] / "examples"
BATCH = 50


class Matrices(dict[str, NDArray[Any]]):
    """A sink that keeps the matrices, by path."""

    def add(self, found: Found) -> None:
        if found.data is not None and len(found.data) and len(found.shape) == 2:
            self[found.path] = matrix(found)


@dataclass
class Totals:
    """What a run found. differences: (number of the mutation, what differs)."""

    refused: int = 0
    agreed: int = 0
    crashed: int = 0
    differences: list[tuple[int, str]] = field(default_factory=list)


def seeds() -> list[bytes]:
    """Return files of the four versions, by scipy, Octave and h5py."""
    files = [data for name, data in fuzz_matfile.seeds() if name == "seed.mat"]
    return files + [
        path.read_bytes()
        for path in sorted(EXAMPLES.glob("*.mat"))
        if path.stat().st_size < 100_000
    ]


def read(data: bytes) -> Matrices | None:
    """Return what our reader takes from a file, None where it refuses the file."""
    found = Matrices()
    try:
        file_formats.read(memoryview(data), "fuzz.mat", found, fuzz_matfile.LIMIT)
    except fuzz_matfile.EXPECTED:
        return None
    return found


def verdict(data: bytes, matrices: Matrices) -> str:
    """Return what the second reader finds different in a file, empty where it agrees."""
    for path, values in matrices.items():
        found = second_reader.disagreement(memoryview(data), path, values)
        if found is not None:
            return f"{path}: {found}"
    return ""


def verdicts(files: list[tuple[bytes, Matrices]]) -> Iterator[str | None]:
    """Yield the verdict on each file, None where the second reader crashed on it."""
    done = 0
    while done < len(files):
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            faulthandler.disable()
            os.close(reader)
            with os.fdopen(writer, "wb") as pipe:
                for data, found in files[done:]:
                    pickle.dump(verdict(data, found), pipe)
                    pipe.flush()
            os._exit(0)
        os.close(writer)
        with os.fdopen(reader, "rb") as pipe:
            while done < len(files):
                try:
                    yield pickle.load(pipe)
                except EOFError:
                    yield None
                    done += 1
                    break
                done += 1
        os.waitpid(child, 0)


def compare(runs: int, seed: int) -> Totals:
    """Compare the readers on `runs` mutations."""
    chance = random.Random(seed)
    originals = seeds()
    totals = Totals()
    batch: list[tuple[bytes, Matrices]] = []
    numbers: list[int] = []

    def judge() -> None:
        for number, said in zip(numbers, verdicts(batch), strict=True):
            if said is None:
                totals.crashed += 1
            elif said:
                totals.differences.append((number, said))
            else:
                totals.agreed += 1
        batch.clear()
        numbers.clear()

    for number in range(runs):
        mutation = fuzz_matfile.mutated(originals[number % len(originals)], chance)
        found = read(mutation)
        if found is None:
            totals.refused += 1
            continue
        batch.append((mutation, found))
        numbers.append(number)
        if len(batch) == BATCH:
            judge()
    judge()
    return totals


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    totals = compare(options.runs, options.seed)
    for number, said in totals.differences:
        print(number, said)
    print(
        f"{options.runs} mutations: {totals.refused} refused, {totals.agreed} read alike, "
        f"{len(totals.differences)} read differently, {totals.crashed} crashed the second reader"
    )


if __name__ == "__main__":
    main()
