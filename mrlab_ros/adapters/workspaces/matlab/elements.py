"""Elements of a MATLAB file of version 5: types, names, shapes, and a cursor over the bytes."""

from __future__ import annotations

import math
import struct

from mrlab_ros.adapters.workspaces.diagnostics import (
    BAD_DIMENSIONS,
    BAD_NAME_BYTES,
    ENDS_EARLY,
    TOO_FEW_BYTES,
    WRONG_TYPE,
)

MI_INT8, MI_INT32, MI_UINT32, MI_MATRIX, MI_COMPRESSED, MI_UTF8 = 1, 5, 6, 14, 15, 16

# data types of the elements: numpy code of the numbers they hold
ELEMENTS = {
    1: "i1",
    2: "u1",
    3: "i2",
    4: "u2",
    5: "i4",
    6: "u4",
    7: "f4",
    9: "f8",
    12: "i8",
    13: "u8",
}
# data types of the elements that hold text: bytes of a code unit
TEXT_SIZES = {1: 1, 2: 1, 4: 2, 16: 1, 17: 2, 18: 4}
MOST_SHOWN = 6  # axes in a sentence
MOST_AXES = 32  # of an array, as HDF5 has it; NumPy has 64


class Damaged(Exception):
    """The bytes contradict the format; its argument is the diagnostic that says why."""


class NotATable(Damaged):
    """A text is no table of numbers; its argument is the diagnostic that says why."""


class NotAWorkspace(Exception):
    """The bytes are something else: a form of diagnostics.UNSUPPORTED_FORMAT, and a detail."""


class TooLarge(Exception):
    """The bytes declare more than the limit; see diagnostics.TOO_LARGE for `part`."""

    def __init__(self, part: str, limit: float, size: float | None = None) -> None:
        super().__init__(part, limit, size)
        self.part, self.limit, self.size = part, limit, size


def is_vector(shape: tuple[int, ...]) -> bool:
    """Say whether an array is a scalar or a vector; of integers, such are rates and times."""
    return len(shape) == 2 and 1 in shape and 0 not in shape


def index(shape: tuple[int, ...], number: int) -> str:
    """Return the subscripts of the `number`th element (from 0), such as '3' or '2,1'."""
    if len([n for n in shape if n != 1]) <= 1:
        return str(number + 1)
    subscripts = []
    for length in shape:
        number, rest = divmod(number, length)
        subscripts.append(str(rest + 1))
    return ",".join(subscripts)


def product(shape: tuple[int, ...]) -> int:
    """Return the number of elements of an array of this shape; raise Damaged where it is none."""
    if len(shape) > MOST_AXES:
        raise _misshapen(shape)
    if any(n < 0 for n in shape):
        raise _misshapen(shape)
    return math.prod(shape)


def _misshapen(shape: tuple[int, ...]) -> Damaged:
    shown = [*map(str, shape[:MOST_SHOWN]), *(["..."] if len(shape) > MOST_SHOWN else [])]
    size = "x".join(shown)
    return Damaged(BAD_DIMENSIONS(size=size, least=2, most=MOST_AXES))


def name_of(text: bytes) -> str:
    """Return the name of a variable, field or class; raise Damaged where it is not ASCII text."""
    if not all(32 <= character < 127 for character in text):
        raise Damaged(BAD_NAME_BYTES(found=repr(text[:40])))
    return text.decode("ascii")


class Cursor:
    """Walks over the elements of a stretch of a v5 to v7 file."""

    def __init__(self, data: memoryview, order: str) -> None:
        self.data = data
        self.order = order
        self.at = 0

    def __bool__(self) -> bool:
        return self.at < len(self.data)

    def next(self) -> tuple[int, memoryview]:
        """Return the next element's data type and bytes, and step over it and its padding."""
        if len(self.data) - self.at < 8:
            raise Damaged(ENDS_EARLY())
        kind, size = struct.unpack_from(self.order + "II", self.data, self.at)
        if kind >> 16:
            kind, size = kind & 0xFFFF, kind >> 16
            if size > 4:
                raise Damaged(TOO_FEW_BYTES(element="any", left=4, needed=size))
            begin, self.at = self.at + 4, self.at + 8
        else:
            begin = self.at + 8
            left = len(self.data) - begin
            if size > left:
                raise Damaged(TOO_FEW_BYTES(element="any", left=left, needed=size))
            self.at = begin + size
            if kind != MI_COMPRESSED:
                self.at = min(self.at + -size % 8, len(self.data))
        return kind, self.data[begin : begin + size]

    def text(self) -> str:
        kind, data = self.next()
        if kind not in (MI_INT8, MI_UTF8):
            raise Damaged(WRONG_TYPE(part="name", found=kind))
        return name_of(bytes(data).rstrip(b"\0"))

    def integers(self) -> tuple[int, ...]:
        kind, data = self.next()
        if kind not in (MI_INT32, MI_UINT32):
            raise Damaged(WRONG_TYPE(part="dimensions", found=kind))
        letter = "i" if kind == MI_INT32 else "I"
        return struct.unpack(f"{self.order}{len(data) // 4}{letter}", data[: len(data) // 4 * 4])


def characters(codes: memoryview, order: str, number: str) -> str:
    """Return the text that a v4 file keeps as numbers of the numpy type `number`."""
    letter = {"f8": "d", "f4": "f", "i4": "i", "i2": "h", "u2": "H", "u1": "B"}[number]
    values = struct.unpack(f"{order}{len(codes) // int(number[1])}{letter}", codes)
    return "".join(chr(int(v)) if 0 <= v < 0x110000 else "\ufffd" for v in values)
