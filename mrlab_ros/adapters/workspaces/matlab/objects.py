"""Opens MATLAB's objects (timeseries, table, Simulink's logs and so on) with mat-io.

Runs in the sandboxed process, which has mat-io imported for a file that holds an object. mat-io
decodes the undocumented part of a workspace where MATLAB keeps the properties of objects; what
the properties of a class mean is known to `object_classes`. Every matrix that is handed on was
also found, bit for bit, by the own reader in that part of the file: two readers agree, as for
plain matrices.
"""

from __future__ import annotations

import importlib.util
import io
import re
import warnings
from collections.abc import Callable
from typing import Any

from mrlab_ros.adapters.workspaces.diagnostics import OBJECT_UNREADABLE
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged
from mrlab_ros.adapters.workspaces.matlab.mat5 import Mat5Reader
from mrlab_ros.adapters.workspaces.matlab.mat73 import read_contents_of_objects
from mrlab_ros.adapters.workspaces.matlab.object_classes import Opener
from mrlab_ros.adapters.workspaces.matlab.recognition import recognise
from mrlab_ros.adapters.workspaces.sinks import Digests, Found, ObjectSink, View
from mrlab_ros.core.base.diagnostic import Diagnostic

MISSING = (
    "the lab runs without the package mat-io, which opens it and needs Python 3.11 and numpy 2.2 "
    "or newer"
)

HAS_READER = importlib.util.find_spec("matio") is not None
NO_SUBSYSTEM = int.from_bytes(b" " * 8, "little")  # as old writers fill the field


def open_objects(
    data: memoryview, found: ObjectSink, limit: int, needs: Callable[[str], object]
) -> None:
    """Hand the parts of the objects in `found` to its sink, and name those that stay closed.

    data: the whole file, v5 to v7.3. limit: bytes that one variable may have. needs: imports a
    module. Raises MemoryError where the memory does not suffice.
    """
    if not found.closed:
        return
    if not HAS_READER:
        _leave_closed(found, set(), MISSING)
        return
    needs("matio")
    hdf5 = recognise(data) == "hdf5"
    roots = list(dict.fromkeys(re.split(r"[.({]", path)[0] for path in found.closed))
    opener: Opener | None = None
    try:
        known = Digests()
        if hdf5:
            read_contents_of_objects(io.BufferedReader(View(data)), known, limit)
        else:
            Mat5Reader(known, limit, inside_objects=True).read(data)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            loaded = _loaded_v73(data, roots) if hdf5 else _loaded(data, roots)
        opener = Opener(found, known)
        for root in roots:
            opener.variable(root, loaded.get(root))
    except MemoryError:
        raise
    except Damaged as error:
        _leave_closed(found, opener.opened if opener else set(), error.args[0])
        return
    except Exception as error:
        # what damage makes mat-io raise has no common base
        said = OBJECT_UNREADABLE(error=f"{type(error).__name__}: {error}")
        _leave_closed(found, opener.opened if opener else set(), said)
        return
    _leave_closed(found, opener.opened, "")


def _leave_closed(found: ObjectSink, opened: set[str], why: Diagnostic | str) -> None:
    for path, kind in found.closed.items():
        if path not in opened:
            found.sink.add(Found(path, kind, (), is_object=True, note=why))


def _subsystem(data: memoryview) -> tuple[int, str]:
    """Return where the objects of a v5 to v7 file begin, 0 without any, and its byte order."""
    little = bytes(data[126:128]) == b"IM"
    offset = int.from_bytes(data[116:124], "little" if little else "big")
    return 0 if offset == NO_SUBSYSTEM else offset, "<" if little else ">"


def _loaded(data: memoryview, names: list[str]) -> dict[str, Any]:
    """Return what mat-io reads of these variables of a v5 to v7 file, objects as properties.

    Its own function opens a file by its path, so its readers are given the bytes.
    """
    from matio.v5.matreader5 import MatFile5Reader, read_subsystem

    offset, order = _subsystem(data)
    file = io.BufferedReader(View(data))
    objects = read_subsystem(file, offset, order, raw_data=True, add_table_attrs=False)
    reader = MatFile5Reader(file, byte_order=order, subsystem=objects)
    found: dict[str, Any] = reader.get_variables(list(names))
    return found


def _loaded_v73(data: memoryview, names: list[str]) -> dict[str, Any]:
    """Return the same of a v7.3 file."""
    import h5py
    from matio.v7.matreader7 import MatRead7, read_subsystem

    with h5py.File(io.BufferedReader(View(data)), "r") as file:
        reader = MatRead7(file, read_subsystem(file, "<", True, False))
        found: dict[str, Any] = reader.get_variables(list(names))
        return found
