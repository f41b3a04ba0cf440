"""The memory file of the reading process as a workspace."""

from __future__ import annotations

import hashlib
import json
import math
import mmap
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces.diagnostics import (
    FILE_CHANGED,
    READERS_DISAGREE,
    SECOND_READER_CRASHED,
    TOO_LARGE,
    TOO_SLOW,
    UNREADABLE,
)
from mrlab_ros.adapters.workspaces.matlab.mat5 import INTEGERS
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.workspace import Variable, Workspace

BLOCK = 1 << 20
# A matrix in the memory file of the first reading: path, shape, offset and numpy type.
Place = list[Any]
# characters of places in one request to the second reader, whose message is at most 64 KiB
MOST_ASKED = 32_000


def index(target: int) -> dict[str, Any]:
    """Return the index at the end of a memory file that the worker filled."""
    length = os.fstat(target).st_size
    with mmap.mmap(target, length, prot=mmap.PROT_READ) as tail:
        end = int.from_bytes(tail[length - 8 :], "little")
        words: dict[str, Any] = json.loads(tail[length - 8 - end : length - 8])
    return words


def collect(target: int, again: Callable[[list[Place]], None]) -> Workspace:
    """Return the workspace in the memory file `target`; raise BadInput where it says why not.

    The numbers stay in the memory file, which lives as long as they do. again: reads the
    matrices at some places with the second reader and raises BadInput unless it finds the same
    bits.
    """
    words = index(target)
    if words.get("refused"):
        raise BadInput(from_plain(words["refused"]))
    numbers = mmap.mmap(target, os.fstat(target).st_size, prot=mmap.PROT_READ)
    variables = tuple(_variable(numbers, *entry) for entry in words["variables"])
    confirm = _Confirmation(words["variables"], again)
    return Workspace(words["format"], variables, words["omitted"], words["sha256"], confirm)


class _Confirmation:
    """Reads matrices with certain paths again; those without numbers are passed over."""

    def __init__(self, entries: list[Any], again: Callable[[list[Place]], None]) -> None:
        self._again = again
        self._places: dict[str, Place] = {}
        for path, _, shape, offset, dtype, within_object, _ in entries:
            if offset >= 0 and not within_object:
                self._places.setdefault(path, [path, shape, offset, dtype])

    def __call__(self, paths: Sequence[str]) -> None:
        places = [self._places[p] for p in dict.fromkeys(paths) if p in self._places]
        if places:
            self._again(places)


def batches(places: list[Place]) -> Iterator[list[Place]]:
    """Yield places in as many requests as the messages to the second reader need."""
    batch: list[Place] = []
    size = 0
    for place in places:
        length = len(json.dumps(place))
        if batch and size + length > MOST_ASKED:
            yield batch
            batch, size = [], 0
        batch.append(place)
        size += length
    if batch:
        yield batch


def too_slow(status: int | None, name: str, time: float, wall: float) -> Diagnostic | None:
    """Return what is said of a file whose process ended at a limit; None where it did not.

    status: how it ended; None: it was given up. time: s of a processor; wall: s on a clock.
    """
    if status in (-signal.SIGPROF, -signal.SIGXCPU):
        return TOO_SLOW(file=name, limit=time, clock="processor")
    if status is None or status == -signal.SIGALRM:
        return TOO_SLOW(file=name, limit=wall)
    return None


def compare(
    status: int | None, target: int, name: str, places: list[Place], time: float, wall: float
) -> None:
    """Pass where the second reader found the same bits; raise BadInput otherwise.

    status: how its process ended; time, wall: its limits, as for too_slow(). target: its answer.
    """
    variable = places[0][0]
    slow = too_slow(status, name, time, wall)
    if slow is not None:
        raise BadInput(slow)
    why: Diagnostic | None = None
    if status:
        why = SECOND_READER_CRASHED(**death(status))
    else:
        answer = index(target)
        variable = answer.get("variable") or variable
        if answer["refused"]:
            why = from_plain(answer["refused"])
    if why is not None and why.code == TOO_LARGE.code:
        raise BadInput(why)
    if why is not None:
        raise BadInput(READERS_DISAGREE(variable=variable, file=name, why=why))


def death(status: int) -> dict[str, Any]:
    """Return how a process with this exit status ended, as the values of diagnostics.ENDED."""
    if status > 0:
        return {"exit": status}
    try:
        return {"signal": -status, "meaning": signal.strsignal(-status)}
    except ValueError:
        return {"signal": -status}


def cause(status: int) -> str:
    """Return how a process with this exit status ended, in a word of every language: exit 1,
    SIGSEGV."""
    if status > 0:
        return f"exit {status}"
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"signal {-status}"


def copied(source: int, most: int, name: str) -> int:
    """Copy a file into a memory file and return its descriptor.

    Nobody else can change or shorten the copy. Raises BadInput where the file has more than
    `most` bytes or changes its length meanwhile.
    """
    size = os.fstat(source).st_size
    copy = os.memfd_create("copy", os.MFD_CLOEXEC)
    try:
        at = 0
        while at <= most:
            count = os.sendfile(copy, source, at, min(BLOCK, most + 1 - at))
            if not count:
                break
            at += count
        if at != size or at > most:
            raise BadInput(UNREADABLE(file=name, why=FILE_CHANGED()))
    except BaseException:
        os.close(copy)
        raise
    return copy


def sha256(source: int) -> str:
    """Return the SHA-256 of a file, 64 hexadecimal digits."""
    digest, at = hashlib.sha256(), 0
    while block := os.pread(source, BLOCK, at):
        digest.update(block)
        at += len(block)
    return digest.hexdigest()


def _variable(
    numbers: mmap.mmap,
    path: str,
    kind: str,
    shape: list[int],
    offset: int,
    dtype: str,
    _within_object: bool,
    facts: dict[str, Any],
) -> Variable:
    values = None
    if offset >= 0:
        flat = np.frombuffer(numbers, np.dtype(dtype), math.prod(shape), offset)
        if kind in INTEGERS or kind == "logical":
            # times and rates: their differences must not wrap
            flat = flat.astype(np.float64)
        values = flat.reshape(tuple(shape), order="F")
    facts |= {name: tuple(facts[name]) for name in ("columns", "units")}
    if isinstance(facts["note"], dict):
        facts["note"] = from_plain(facts["note"])
    return Variable(path, kind, tuple(shape), values, **facts)
