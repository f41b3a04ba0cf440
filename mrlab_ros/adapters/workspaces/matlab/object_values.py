"""Values that mat-io loads: text, numbers, structs, cells, properties of objects."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray


def text(value: Any) -> str:
    """Return the text in a char array, empty where it is none."""
    if isinstance(value, str):
        return value
    if isinstance(value, np.ndarray) and value.dtype.kind in "US" and value.size == 1:
        return str(value.flat[0])
    return ""


def number(value: Any) -> float:
    """Return the one number in an array, NaN where there is none."""
    if isinstance(value, np.ndarray) and value.size == 1 and value.dtype.kind in "fiub":
        return float(value.flat[0])
    return float("nan")


def decoded_strings(stored: Any) -> Iterator[str]:
    """Yield the strings of a MATLAB string array, which is stored as 64-bit numbers.

    Version, number of dimensions, dimensions, length of each string, then UTF-16 code units.
    """
    if not isinstance(stored, np.ndarray) or stored.dtype != np.uint64 or stored.size < 4:
        return
    flat = stored.reshape(-1)
    dimensions = int(flat[1])
    count = int(np.prod(flat[2 : 2 + dimensions].astype(np.float64)))
    begin = 2 + dimensions
    if flat[0] != 1 or begin + count > len(flat):
        return
    units = flat[begin + count :].view(np.uint16)
    at = 0
    for length in flat[begin : begin + count].tolist():
        if length >= 1 << 40:  # a missing string
            yield ""
            continue
        yield units[at : at + length].astype("<u2").tobytes().decode("utf-16-le", "replace")
        at += length


def is_numbers(value: Any) -> bool:
    """Say whether a value is an array of floating-point numbers."""
    return isinstance(value, np.ndarray) and value.dtype.kind == "f"


def kind_of(values: NDArray[Any]) -> str:
    """Return MATLAB's name of the class of floating-point numbers."""
    return "single" if values.dtype.itemsize == 4 else "double"


def places(value: NDArray[Any]) -> list[tuple[int, ...]]:
    """Return the subscripts of all elements in MATLAB's order."""
    return [place[::-1] for place in np.ndindex(value.shape[::-1])]


def inner(value: Any) -> dict[str, Any]:
    """Return the properties of an object or the fields of a 1x1 struct, else nothing."""
    properties = getattr(value, "properties", None)
    if isinstance(properties, dict):
        return properties
    return struct(value)


def struct(value: Any) -> dict[str, Any]:
    """Return the fields of a 1x1 struct, else nothing."""
    if isinstance(value, np.ndarray) and value.dtype.names and value.size == 1:
        return {name: value[name].flat[0] for name in value.dtype.names}
    return {}


def cells(value: Any) -> list[Any]:
    """Return the elements of a cell array or an object array in MATLAB's order."""
    if not isinstance(value, np.ndarray) or value.dtype.names:
        return []
    flat = value.reshape(-1, order="F")
    return list(flat) if value.dtype == object else [flat[i : i + 1] for i in range(len(flat))]


def texts(value: Any) -> list[str]:
    """Return the elements of a cell array as texts, in MATLAB's order."""
    return [text(element) for element in cells(value)]


def names_of(stored: dict[str, Any], usual: str, flag: str, original: str) -> list[str]:
    """Return names of a table: the usual ones, or where a flag says so the original ones."""
    newer = f"{usual or 'VariableNames'}2048"
    if newer in stored and number(stored.get(f"use{newer[0].upper()}{newer[1:]}")) == 1:
        return texts(stored[newer])
    if number(stored.get(flag)) == 1:
        return texts(stored.get(original))
    return texts(stored.get(usual))


def elements(properties: dict[str, Any], depth: int) -> Any:
    """Return the elements of a Dataset, which versions of MATLAB keep at different depths."""
    own = properties.get("Elements")
    if isinstance(own, np.ndarray) and own.size:
        return own
    for name in ("any", "Storage", "Storage_"):
        within = inner(properties.get(name))
        if within and depth:
            found = elements(within, depth - 1)
            if found is not None:
                return found
    return own if isinstance(own, np.ndarray) else None


def unit_of(value: Any) -> str:
    """Return a unit, which is text or an object with a name."""
    return text(value) or text(inner(value).get("Name"))


def key_of(value: Any) -> str:
    """Return a key of a map as MATLAB writes it."""
    name = text(value)
    return f"'{name}'" if name else f"{number(value):g}"


def as_rows(data: NDArray[Any], count: int) -> NDArray[Any]:
    """Return the samples of a timeseries as rows, where the second axis alone has `count`.

    More than two dimensions, such as 6 x 1 x N, stay as they are: `dimensions` takes them.
    """
    if data.ndim != 2 or not count or data.shape[0] == count or data.shape[1] != count:
        return data
    return np.ascontiguousarray(data.T)


def shape_of(value: Any) -> tuple[int, ...]:
    """Return the shape of an array, empty where it is none."""
    return tuple(int(n) for n in value.shape) if isinstance(value, np.ndarray) else ()
