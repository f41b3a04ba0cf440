"""HDF5 workspaces made to read other files of the machine: in the ways that HDF5 has, at random.

A marker file plays the part of a key: whatever a reader says of a workspace, none of its bytes may
be in it.
"""

from __future__ import annotations

import io
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

# Eight of these bytes appear in no honest answer: as text, as numbers, or as lengths of axes.
MARKER = b"".join(b"MARKER%02d" % n for n in range(64))
HEADER = b"MATLAB 7.3 MAT-file".ljust(116) + bytes(8) + b"\x00\x02IM"
CLASSES = (
    *("double", "single", "char", "cell", "struct", "logical", "uint8", "int64"),
    "table",
    "",
)
FLAGS = ("MATLAB_empty", "MATLAB_sparse", "MATLAB_object_decode", "MATLAB_int_decode")
Made = Callable[[Any, str, random.Random, Path], None]


def workspace(fill: Callable[[Any], None]) -> bytes:
    """Return a v7.3 workspace whose HDF5 file `fill` has filled."""
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        fill(file)
    data = bytearray(buffer.getvalue())
    data[: len(HEADER)] = HEADER
    return bytes(data)


def external(
    parent: Any, name: str, path: Path, offset: int = 0, rows: int = 8, **made: Any
) -> Any:
    """Make a dataset whose bytes lie in another file, as HDF5's external storage has it."""
    dtype = np.dtype(made.pop("dtype", "<u8"))
    size = dtype.itemsize * rows
    shape = made.pop("shape", (rows, 1))
    return parent.create_dataset(name, shape, dtype, external=[(str(path), offset, size)], **made)


def _dataset(parent: Any, name: str, chance: random.Random, marker: Path) -> Any:
    """Make one dataset that may lie elsewhere."""
    dtype = chance.choice(["<u8", "<f8", "<u2", "u1", "<i8", "<f4"])
    offset, rows = 8 * chance.randrange(8), chance.choice([1, 2, 8])
    way = chance.randrange(7)
    if way <= 1:
        return external(parent, name, marker, offset, rows, dtype=dtype)
    if way == 3:
        layout = h5py.VirtualLayout((rows, 1), dtype)
        layout[:, :] = h5py.VirtualSource(str(marker), "q", (rows, 1), dtype)
        return parent.create_virtual_dataset(name, layout)
    if way == 4:
        compound = np.dtype([("real", "<f8"), ("imag", "<f8")])
        return external(parent, name, marker, offset, rows, dtype=compound)
    return parent.create_dataset(name, data=np.arange(rows, dtype=dtype).reshape(-1, 1))


def _attributes(item: Any, file: Any, chance: random.Random, marker: Path) -> None:
    """Give an item MATLAB's attributes with values of any type."""
    for name in ("MATLAB_class", *FLAGS, "MATLAB_fields", "unit", "H5PATH"):
        if chance.random() < (0.4 if name == "MATLAB_empty" else 0.9):
            continue
        values: list[Any] = [np.bytes_(chance.choice(CLASSES)), np.uint8(1), np.int32(2)]
        values += [str(marker), np.arange(chance.choice([0, 3, 200]), dtype="u8")]
        values += [np.array([(1.0, 2.0)], dtype=[("real", "f8"), ("imag", "f8")])]
        value, dtype = chance.choice(values), None
        kind = chance.random()
        if name == "MATLAB_empty" and kind > 0.2:
            value = np.uint8(1)
        elif kind < 0.15:
            value, dtype = item.ref, h5py.ref_dtype
        elif kind < 0.25 and isinstance(item, h5py.Dataset) and item.shape:
            value, dtype = item.regionref[...], h5py.regionref_dtype
        elif kind < 0.35:
            value = np.array([np.arange(3), np.arange(2)], dtype=object)
            dtype = h5py.vlen_dtype(np.dtype("u1"))
        item.attrs.create(name, value, dtype=dtype)
    if chance.random() < 0.8:
        item.attrs["MATLAB_class"] = np.bytes_(chance.choice(CLASSES))


def made_at_random(seed: int, marker: Path) -> bytes:
    """Return a workspace that reaches for `marker` in ways drawn by `seed`."""
    chance = random.Random(seed)

    def fill(file: Any) -> None:
        refs = file.create_group("#refs#")
        items = [_dataset(refs, f"r{n}", chance, marker) for n in range(4)]
        if chance.random() < 0.4:
            subsystem = file.create_group("#subsystem#")
            items.append(_dataset(subsystem, "MCOS", chance, marker))
        for n in range(chance.randrange(1, 3)):
            items.append(_variable(file, f"v{n}", items, chance, marker))
        for item in items:
            _attributes(item, file, chance, marker)

    return workspace(fill)


def _variable(file: Any, name: str, items: list[Any], chance: random.Random, marker: Path) -> Any:
    way = chance.randrange(6)
    if way == 0:
        target = chance.choice(["/q", "/", "/keys"])
        file[name + "x"] = h5py.ExternalLink(str(marker), target)
        file[name + "s"] = h5py.SoftLink(f"/{name}x/q")
        return _dataset(file, name, chance, marker)
    if way == 1:
        group = file.create_group(name)
        for field in ("Data", "q"):
            _dataset(group, field, chance, marker)
        return group
    if way == 2:
        references = np.array([[item.ref] for item in items], dtype=h5py.ref_dtype)
        return file.create_dataset(name, data=references, dtype=h5py.ref_dtype)
    if way == 3:
        regions = [i.regionref[...] for i in items if isinstance(i, h5py.Dataset) and i.shape]
        data = file.create_dataset(name, (len(regions), 1), h5py.regionref_dtype)
        for n, region in enumerate(regions):
            data[n, 0] = region
        return data
    if way == 4:
        texts = [str(marker), "/#refs#/r0", f"/{name}"]
        return file.create_dataset(name, data=texts, dtype=h5py.string_dtype())
    return _dataset(file, name, chance, marker)


def leaked(said: str, marker: bytes = MARKER) -> str:
    """Return the first eight bytes of the marker that `said` holds, as text or as a number."""
    for at in range(0, len(marker) - 7, 8):
        piece = marker[at : at + 8]
        forms = [piece.decode(), piece.hex(), piece[:6].decode()]
        for dtype in ("<u8", ">u8", "<f8", "<u4", "<f4"):
            forms += [str(value) for value in np.frombuffer(piece, dtype).tolist()]
        for form in forms:
            if form in said:
                return form
    return ""
