"""The formats of files from outside: which reader takes a file, by its bytes and its name."""

from __future__ import annotations

import gzip
import importlib
import io
import zlib
from collections.abc import Callable, Sequence

from mrlab_ros.adapters.sandbox.inflate import Incomplete, inflate_zstd
from mrlab_ros.adapters.workspaces import joint_trajectories, messages_as_yaml
from mrlab_ros.adapters.workspaces.diagnostics import NOT_INFLATED
from mrlab_ros.adapters.workspaces.matlab import mat5, objects
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, NotAWorkspace, TooLarge
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
    if form in ("mat5", "hdf5"):
        found = ObjectSink(sink)
        if form == "mat5":
            mat5.Mat5Reader(found, limit).read(data)
        else:
            read_hdf5(io.BufferedReader(View(data)), found, limit)
        objects.open_objects(data, found, limit, needs)
        return "MATLAB v5 to v7" if form == "mat5" else "MATLAB v7.3"
    if form == "mat4":
        mat5.read_mat4(data, sink)
        return "MATLAB v4"
    if form in joint_trajectories.SUFFIXES or name.lower().endswith(".cdr"):
        needs("rosbags")
    if form in joint_trajectories.SUFFIXES:
        joint_trajectories.read_bag(data, form, sink, limit, joints)
        return "rosbag2"
    if name.lower().endswith(".cdr"):
        joint_trajectories.read_cdr(data, name[: -len(".cdr")], sink)
        return "CDR"
    if form == "numpy":
        table.read_npy(data, sink)
        return "NumPy npy"
    if name.lower().endswith(".npz"):
        table.read_npz(data, sink, limit)
        return "NumPy npz"
    if name.lower().endswith(".json"):
        table.read_json(data, sink)
        return "JSON"
    if form in TEXTS and name.lower().endswith(messages_as_yaml.SUFFIXES):
        needs("yaml")
        messages_as_yaml.read_yaml(data, sink, joints)
        return "YAML"
    if form in TEXTS and name.lower().endswith(".m"):
        table.read_matlab(data, sink)
        return "MATLAB code"
    # save -ascii of MATLAB writes a table of numbers, and calls it .mat where it is told to.
    ascii_table = form == TEXTS[0] and bytes(data[:64]).lstrip()[:1] in NUMBER_BEGINS
    if form in TEXTS and (name.lower().endswith(TABLES) or ascii_table):
        table.read_csv(data, sink)
        return "CSV"
    raise NotAWorkspace(form)
