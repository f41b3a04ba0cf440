"""The formats of files from outside: which reader takes a file, by its bytes and its name."""

from __future__ import annotations

import gzip
import importlib
import io
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import PurePath

from mrlab_ros.adapters.sandbox.inflate import Incomplete, inflate_zstd
from mrlab_ros.adapters.workspaces import joint_trajectories, messages_as_yaml
from mrlab_ros.adapters.workspaces.diagnostics import NOT_INFLATED
from mrlab_ros.adapters.workspaces.matlab import mat5, objects
from mrlab_ros.adapters.workspaces.matlab.elements import (
    Damaged,
    NotATable,
    NotAWorkspace,
    TooLarge,
)
from mrlab_ros.adapters.workspaces.matlab.mat73 import read_hdf5
from mrlab_ros.adapters.workspaces.matlab.recognition import recognise
from mrlab_ros.adapters.workspaces.sinks import ObjectSink, Sink, View
from mrlab_ros.adapters.workspaces.tables import table

# how many bytes one byte of them can hold at most
COMPRESSED = {"gzip": 1100, "zstd": 33_000}
# what a table may look like before its rows are read
TEXTS = ("text", "unknown")
TABLES = (".csv", ".txt", ".tsv", ".lvm")
NUMBER_BEGINS = tuple(b"%c" % c for c in b"+-.0123456789")


def inflate(data: memoryview, form: str, limit: int) -> memoryview:
    """Return the contents of a gzip or zstd file.

    Raises Damaged, or TooLarge above `limit` bytes.
    """
    inflated: bytes | bytearray | None
    try:
        if form == "zstd":
            inflated = inflate_zstd(data, limit)
        else:
            with gzip.open(View(data)) as file:
                inflated = file.read(limit + 1)
    except (OSError, EOFError, zlib.error, ValueError) as error:
        raise Damaged(NOT_INFLATED(form=form, why=str(error))) from error
    except Incomplete as error:
        raise Damaged(NOT_INFLATED(form=form, why=error)) from error
    if inflated is None or len(inflated) > limit:
        raise TooLarge("inflated", limit)
    return memoryview(inflated)


@dataclass(frozen=True)
class Source:
    """A file to read. name: without an ending of compression; needs, joints: as for `read`."""

    data: memoryview
    form: str
    name: str
    sink: Sink
    limit: int
    needs: Callable[[str], object]
    joints: Sequence[str]


def _mat5(source: Source) -> None:
    found = ObjectSink(source.sink)
    mat5.Mat5Reader(found, source.limit).read(source.data)
    objects.open_objects(source.data, found, source.limit, source.needs)


def _hdf5(source: Source) -> None:
    found = ObjectSink(source.sink)
    read_hdf5(io.BufferedReader(View(source.data)), found, source.limit)
    objects.open_objects(source.data, found, source.limit, source.needs)


def _bag(source: Source) -> None:
    source.needs("rosbags")
    joint_trajectories.read_bag(source.data, source.form, source.sink, source.limit, source.joints)


def _cdr(source: Source) -> None:
    source.needs("rosbags")
    joint_trajectories.read_cdr(source.data, source.name[: -len(".cdr")], source.sink)


def _yaml(source: Source) -> None:
    source.needs("yaml")
    messages_as_yaml.read_yaml(source.data, source.sink, source.joints)


Reader = Callable[[Source], None]
# The first bytes say more than the name; a text says what it is by its name, then by its begin.
BY_CONTENT: dict[str, tuple[str, Reader]] = {
    "mat4": ("MATLAB v4", lambda s: mat5.read_mat4(s.data, s.sink)),
    "mat5": ("MATLAB v5 to v7", _mat5),
    "hdf5": ("MATLAB v7.3", _hdf5),
    "numpy": ("NumPy npy", lambda s: table.read_npy(s.data, s.sink)),
    "npz": ("NumPy npz", lambda s: table.read_npz(s.data, s.sink, s.limit)),
    **dict.fromkeys(joint_trajectories.SUFFIXES, ("rosbag2", _bag)),
}
CSV: tuple[str, Reader] = ("CSV", lambda s: table.read_csv(s.data, s.sink))
JSON: tuple[str, Reader] = ("JSON", lambda s: table.read_json(s.data, s.sink))
TEXTS_BY_NAME: dict[str, tuple[str, Reader]] = {
    ".m": ("MATLAB code", lambda s: table.read_matlab(s.data, s.sink)),
    **dict.fromkeys(messages_as_yaml.SUFFIXES, ("YAML", _yaml)),
}
MESSAGE = ".cdr"  # has no first bytes of its own
JSON_BEGINS = (b"{", b"[")


def read(
    data: memoryview,
    name: str,
    sink: Sink,
    limit: int,
    needs: Callable[[str], object] = importlib.import_module,
    joints: Sequence[str] = (),
) -> str:
    """Hand the variables of a file of any known format to the sink; return the format's name.

    joints: of the robot whose motion is wanted, by which it is found in recorded joint states.
    needs: is told the modules that this file needs beside those of all files.
    """
    form = recognise(data)
    if form in COMPRESSED:
        data = inflate(data, form, limit)
        form = recognise(data)
        for suffix in (".gz", ".zst", ".zstd"):
            name = name.removesuffix(suffix)
    source = Source(data, form, name, sink, limit, needs, joints)
    if form in BY_CONTENT:
        said, reader = BY_CONTENT[form]
    elif name.lower().endswith(MESSAGE):
        said, reader = "CDR", _cdr
    elif form in TEXTS:
        return _read_text(source)
    else:
        raise NotAWorkspace(form)
    reader(source)
    return said


def _read_text(source: Source) -> str:
    """Read a text by its name where that says what it is, else by how it begins."""
    ending = PurePath(source.name.lower()).suffix
    begins = bytes(source.data[:64]).lstrip()[:1]
    is_json = source.form == "text" and begins in JSON_BEGINS and ending not in TEXTS_BY_NAME
    said, reader = TEXTS_BY_NAME.get(ending, JSON if is_json else CSV)
    if is_json or ending in (*TEXTS_BY_NAME, *TABLES):
        reader(source)
        return said
    if source.form == "unknown":
        raise NotAWorkspace(source.form)
    try:
        reader(source)
    except NotATable:
        # save -ascii of MATLAB writes a table of numbers, and calls it .mat where it is told to
        if begins in NUMBER_BEGINS:
            raise
        raise NotAWorkspace(source.form) from None
    return said
