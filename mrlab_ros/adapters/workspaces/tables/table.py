"""Reads CSV, JSON, NumPy npy and npz files into the same variables as a workspace."""

from __future__ import annotations

import contextlib
import io
import json
import zipfile
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.diagnostics import LIBRARY_FAILED, NO_JSON_OBJECT, NO_MATRIX_Q
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, TooLarge, is_vector
from mrlab_ros.adapters.workspaces.matlab.mat5 import INTEGERS, LONGEST_TEXT
from mrlab_ros.adapters.workspaces.sinks import Found, Sink, View
from mrlab_ros.adapters.workspaces.tables import matlab_text, text
from mrlab_ros.adapters.workspaces.tables.cells import is_instant, seconds
from mrlab_ros.core.conversion.evidence.headings import GRIPPER
from mrlab_ros.core.conversion.workspace import COMMENT

MOST_COMMENTS = 200
DEEPEST = 8  # objects of JSON inside one another
RECORDS = "records"
TIME_HEADINGS = ("t", "time", "time_from_start")


def _add(sink: Sink, name: str, values: Any, columns: tuple[str, ...] = ()) -> None:
    if values.dtype.names:
        _add_fields(sink, name, values)
        return
    if values.dtype.kind == "f" and values.dtype.str[1:] not in ("f8", "f4"):
        values = values.astype(np.float32 if values.dtype.itemsize == 2 else np.float64)
    kinds = {"f8": "double", "f4": "single"}
    kind = kinds.get(values.dtype.str[1:], values.dtype.name)
    if values.dtype.kind == "c":
        sink.add(Found(name, "double", values.shape, note="complex"))
        return
    if values.dtype.kind == "U":
        texts = values.reshape(-1)[:MOST_COMMENTS]
        for number, line in enumerate(texts, 1):
            path = name if values.size == 1 else f"{name}{{{number}}}"
            sink.add(Found(path, "string", (1, 1), text=str(line)[:LONGEST_TEXT]))
        return
    if values.dtype.kind == "b" and values.size == 1:
        sink.add(Found(name, "logical", (1, 1), text="true" if values.all() else "false"))
        return
    if values.dtype.kind == "b":
        values, kind = values.astype(np.uint8), "logical"
    shape = values.shape if values.ndim >= 2 else (values.size, 1)
    kept = kind in ("double", "single") or (
        kind in (*INTEGERS, "logical")
        and is_vector(shape)
        and values.size > 1 - (kind != "logical")
    )
    data = np.asfortranarray(values).tobytes(order="F") if kept else None
    sink.add(Found(name, kind, shape, data, values.dtype.str, columns=columns))


def _add_fields(sink: Sink, name: str, records: Any) -> None:
    """Hand a structured array to the sink: its numbers as a table, its matrices by their names."""
    flat = records.reshape(-1)
    headings = []
    for field in records.dtype.names:
        column = flat[field]
        if column.ndim == 1 and column.dtype.kind in "fiu" and field.lower() not in TIME_HEADINGS:
            headings.append(field)
        elif column.dtype.names is None:
            _add(sink, field, column)
    if headings:
        _add(sink, name, np.column_stack([flat[h] for h in headings]), tuple(headings))


def read_csv(data: memoryview, sink: Sink) -> None:
    """Hand the table to the sink as the matrix `q` with its headings, a time column as `t`.

    Numbers that lines above the table name, such as a sample rate, are scalars of those names;
    the lines themselves are texts of the kind COMMENT.
    Raises NotATable with the line that is not numbers.
    """
    table = text.parsed(bytes(data))
    for name, number in table.stated.items():
        _add(sink, name, np.array([number]))
    for number, comment in enumerate(table.comments[:MOST_COMMENTS], 1):
        sink.add(Found(f"comment{{{number}}}", COMMENT, text=comment[:LONGEST_TEXT]))
    values, headings = table.values, list(table.headings)
    time = table.instants
    if time is None and len(headings) == values.shape[1]:
        named = [i for i, h in enumerate(headings) if h.lower() in TIME_HEADINGS]
        time = named[0] if len(named) == 1 else None
    if time is not None:
        _add(sink, "t", values[:, [time]])
        values = np.delete(values, time, axis=1)
        headings = headings[:time] + headings[time + 1 :]
    _add(sink, "q", values, tuple(headings) if len(headings) == values.shape[1] else ())


def read_matlab(data: memoryview, sink: Sink) -> None:
    """Hand the numbers, texts, matrices and comments of a file of MATLAB code to the sink."""
    for number, comment in enumerate(matlab_text.comments(bytes(data))[:MOST_COMMENTS], 1):
        sink.add(Found(f"comment{{{number}}}", COMMENT, text=comment[:LONGEST_TEXT]))
    for name, value in matlab_text.statements(bytes(data)):
        if isinstance(value, str):
            sink.add(Found(name, "char", (1, len(value)), text=value[:LONGEST_TEXT]))
        else:
            _add(sink, name, value)


def read_npy(data: memoryview, sink: Sink) -> None:
    """Hand the array of a npy file to the sink as `q`; nothing pickled is opened."""
    try:
        values = np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except MemoryError:
        raise
    except Exception as error:
        raise Damaged(LIBRARY_FAILED(part="npz", error=str(error))) from None
    _add(sink, "q", values)


def _are_records(content: Any) -> bool:
    return (
        isinstance(content, list) and bool(content) and all(isinstance(c, dict) for c in content)
    )


def _add_records(records: list[Any], sink: Sink) -> None:
    """Hand a list of objects to the sink, a row each: numbers as a table, lists as matrices.

    A text that all of them have is a text of the file.
    """
    headings: dict[str, Any] = {}
    for key in dict.fromkeys(name for record in records for name in record):
        name, column = str(key), [record.get(key) for record in records]
        if isinstance(column[0], str) and column.count(column[0]) == len(column):
            sink.add(Found(name, "string", (1, 1), text=column[0][:LONGEST_TEXT]))
        elif (times := _instants(column)) is not None:
            _add(sink, name, times)
        elif (values := _numbers(column)) is None:
            sink.add(Found(name, "cell", (len(column), 1)))
        elif values.ndim == 2 or name.lower() in TIME_HEADINGS:
            _add(sink, name, values)
        else:
            headings[name] = values
    if headings:
        # no name that says more than the headings
        _add(sink, RECORDS, np.column_stack(list(headings.values())), tuple(headings))


def _instants(column: list[Any]) -> NDArray[np.float64] | None:
    """Return dates and times of day as s since the first, or None where they are none."""
    if not all(isinstance(text, str) and is_instant(text) for text in column):
        return None
    found = [s for s in seconds(column) if s is not None]
    return np.array(found, dtype=np.float64) if len(found) == len(column) else None


def read_json(data: memoryview, sink: Sink) -> None:
    """Hand the arrays and numbers of a JSON object to the sink, each as the variable of its name.

    A trajectory file of the lab (trajectory.schema.json) gives q in rad, its gripper as the last
    column, the joints' names and fs.
    """
    document = _parsed(data)
    frames = document.get("frames") if isinstance(document, dict) else None
    if isinstance(frames, dict) and "schema_version" in document:
        _add_frames(document, frames, sink)
    elif not add_document(document, sink):
        raise Damaged(NO_JSON_OBJECT())


def add_document(document: Any, sink: Sink) -> bool:
    """Hand rows, a list of objects or an object to the sink; return whether it is one of them."""
    if (rows := _numbers(document)) is not None and rows.ndim == 2:
        _add(sink, "q", rows)
    elif _are_records(document):
        _add_records(document, sink)
    elif isinstance(document, dict):
        add_members({str(key): each for key, each in document.items()}, "", sink, DEEPEST)
    else:
        return False
    return True


def _parsed(data: memoryview) -> Any:
    """Return the document in a JSON file, with NaN and Infinity as Python writes them."""
    try:
        return orjson.loads(data)
    except orjson.JSONDecodeError as error:
        text = bytes(data)
        if b"NaN" in text or b"Infinity" in text:
            with contextlib.suppress(ValueError, RecursionError):
                return json.loads(text)
        raise Damaged(LIBRARY_FAILED(part="json", error=str(error))) from None


def add_members(document: dict[str, Any], path: str, sink: Sink, deepest: int) -> None:
    """Hand the members of an object to the sink, those of objects in it by their path."""
    for key, content in document.items():
        name = f"{path}{key}"
        if isinstance(content, dict) and deepest:
            add_members(content, f"{name}.", sink, deepest - 1)
        elif isinstance(content, str | bool):
            said = content if isinstance(content, str) else "true" if content else "false"
            kind = "string" if isinstance(content, str) else "logical"
            sink.add(Found(name, kind, (1, 1), text=said[:LONGEST_TEXT]))
        elif isinstance(content, list) and content and all(isinstance(c, str) for c in content):
            times = _instants(content)
            _add(sink, name, np.array(content[:MOST_COMMENTS]) if times is None else times)
        elif _are_records(content):
            _add_records(content, sink)
        elif (values := _numbers(content)) is not None:
            _add(sink, name, values)


def _add_frames(document: dict[str, Any], frames: dict[str, Any], sink: Sink) -> None:
    degrees, gripper = _numbers(frames.get("q")), _numbers(frames.get("gripper"))
    if degrees is None or degrees.ndim != 2:
        raise Damaged(NO_MATRIX_Q())
    values, names = np.radians(degrees), document.get("joint_names")
    headings = [str(name) for name in names] if isinstance(names, list) else []
    if gripper is not None and gripper.shape == values.shape[:1]:
        values = np.column_stack([values, gripper])
        headings.append(GRIPPER)
    _add(sink, "q", values, tuple(headings) if len(headings) == values.shape[1] else ())
    if (rate := _numbers(document.get("frame_rate"))) is not None:
        _add(sink, "fs", rate)


def _numbers(content: Any) -> Any:
    """Return numbers, or rows of equally many, as an array; None for anything else."""
    if isinstance(content, bool) or not isinstance(content, int | float | list) or content == []:
        return None
    try:
        values = np.array(content, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return None
    return values if values.ndim <= 2 else None


def read_npz(data: memoryview, sink: Sink, limit: int) -> None:
    """Hand every array of an npz file to the sink; nothing pickled is opened."""
    try:
        with zipfile.ZipFile(io.BufferedReader(View(data))) as archive:
            for entry in archive.infolist():
                if entry.file_size > limit:
                    raise TooLarge("variable", limit, entry.file_size)
                with archive.open(entry) as file:
                    values = np.lib.format.read_array(file, allow_pickle=False)
                _add(sink, entry.filename.removesuffix(".npy"), values)
    except (TooLarge, MemoryError):
        raise
    except Exception as error:
        # damage, encryption and foreign kinds of compression each raise another error
        raise Damaged(LIBRARY_FAILED(part="npz", error=str(error))) from error
