"""Numeric arrays as JSON carries them: base64 of their little-endian bytes."""

from __future__ import annotations

import base64
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Dtype = Literal["float32", "float64", "uint32", "uint8"]


def packed(values: NDArray[Any], dtype: Dtype) -> dict[str, Any]:
    """Return `values` of any shape as PackedArray of web/src/playback/motion.ts, row by row."""
    stored = np.ascontiguousarray(values, dtype=np.dtype(dtype).newbyteorder("<"))
    data = base64.b64encode(stored.tobytes()).decode("ascii")
    return {"dtype": dtype, "shape": list(stored.shape), "data": data}


def unpacked(document: dict[str, Any]) -> NDArray[Any]:
    """Return the array of a document that packed() made."""
    dtype = np.dtype(document["dtype"]).newbyteorder("<")
    return np.frombuffer(base64.b64decode(document["data"]), dtype).reshape(document["shape"])
