"""Reads MATLAB's own formats v4 to v7 from bytes; `mat73` reads v7.3.

Runs in the walled-off process of `worker`, on bytes that somebody sent. Every length is
checked against what there is. The format is that of MathWorks' "MAT-File Format" document.
"""

from __future__ import annotations

import math
import struct
import zlib

from mrlab_ros.adapters.workspaces.diagnostics import (
    BAD_DIMENSIONS,
    BAD_NAME_BYTES,
    CUT_BEFORE_CHECKSUM,
    EMPTY_SUBSYSTEM,
    ENDS_EARLY,
    LIBRARY_FAILED,
    NESTED_TOO_DEEP,
    NO_NAME,
    NO_VARIABLE_HERE,
    ODD_BYTES,
    SAME_NAME,
    TOO_FEW_BYTES,
    TOO_MANY_BYTES,
    UNKNOWN_CLASS_NUMBER,
    WRONG_INFLATED_SIZE,
    WRONG_TYPE,
)
from mrlab_ros.adapters.workspaces.sinks import Found, Sink


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
MI_INT8, MI_INT32, MI_UINT32, MI_MATRIX, MI_COMPRESSED, MI_UTF8 = 1, 5, 6, 14, 15, 16
CELL, STRUCT, OBJECT, CHAR, SPARSE, DOUBLE, SINGLE = 1, 2, 3, 4, 5, 6, 7
FUNCTION, OPAQUE = 16, 17
CLASSES = {
    CHAR: "char",
    SPARSE: "sparse",
    DOUBLE: "double",
    SINGLE: "single",
    8: "int8",
    9: "uint8",
    10: "int16",
    11: "uint16",
    12: "int32",
    13: "uint32",
    14: "int64",
    15: "uint64",
    FUNCTION: "function_handle",
}
INTEGERS = tuple(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u"))
UNREAD = (OBJECT, SPARSE, FUNCTION)  # classes whose contents are not read to the end
COMPLEX_FLAG, LOGICAL_FLAG = 0x08, 0x02
DEEPEST = 32
LONGEST_TEXT = 200  # characters of a line of text that is kept


def is_vector(shape: tuple[int, ...]) -> bool:
    """Say whether an array is a scalar or a vector; of integers, such are rates and times."""
    return len(shape) == 2 and 1 in shape and 0 not in shape


MOST_AXES = 32  # of an array, as HDF5 has it; NumPy has 64


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
    size = "x".join(map(str, shape))
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


class Mat5Reader:
    """Reads a v5, v6 or v7 workspace.

    limit: bytes that one variable may inflate to. inside_objects: hand on the numbers inside
    objects as well, at their place in the file and under made-up paths; a complex matrix as its
    two parts.
    """

    def __init__(self, sink: Sink, limit: int, *, inside_objects: bool = False) -> None:
        self.sink = sink
        self.limit = limit
        self.inside_objects = inside_objects
        self.order = "<"

    def read(self, data: memoryview) -> None:
        """Hand every variable of the file to the sink; raise Damaged or TooLarge."""
        if len(data) < 128:
            raise Damaged(TOO_FEW_BYTES(element="any", left=len(data), needed=128))
        self.order = ">" if bytes(data[126:128]) == b"MI" else "<"
        (subsystem,) = struct.unpack_from(self.order + "Q", data, 116)
        cursor = Cursor(data, self.order)
        cursor.at = 128
        names: set[str] = set()
        while cursor:
            if not any(data[cursor.at : cursor.at + 8]):
                if any(data[cursor.at :]):
                    raise Damaged(NO_VARIABLE_HERE())
                return
            begin = cursor.at
            kind, body = cursor.next()
            if kind == MI_COMPRESSED:
                kind, body = self._inflate(body)
            if kind != MI_MATRIX:
                raise Damaged(WRONG_TYPE(part="variable", found=kind))
            if len(body) % 8:
                raise Damaged(ODD_BYTES(part="variable", count=len(body), unit_size=8))
            # objects keep their contents in one nameless variable, which `objects` reads
            if begin == subsystem:
                if self.inside_objects:
                    self._subsystem(body)
            else:
                name = self._matrix(body, "", 0)
                if name in names:
                    raise Damaged(SAME_NAME(variable=name))
                names.add(name)

    def _subsystem(self, body: memoryview) -> None:
        """Read the nameless variable that holds the contents of all objects.

        It is a uint8 matrix whose bytes are a workspace without the text of its header.
        """
        cursor = Cursor(body, self.order)
        for _ in ("flags", "dimensions", "name"):
            cursor.next()
        _, inner = cursor.next()
        if len(inner) < 8:
            raise Damaged(EMPTY_SUBSYSTEM())
        reader = Mat5Reader(self.sink, self.limit, inside_objects=True)
        reader.order = ">" if bytes(inner[2:4]) == b"MI" else "<"
        cursor = Cursor(inner[8:], reader.order)
        while cursor:
            kind, element = cursor.next()
            if kind == MI_COMPRESSED:
                kind, element = reader._inflate(element)
            if kind == MI_MATRIX:
                reader._matrix(element, "#", 0)

    def _inflate(self, body: memoryview) -> tuple[int, memoryview]:
        """Return the element inside a miCOMPRESSED element: its data type and its bytes.

        The zlib stream must end where the element ends, hold exactly the bytes that its tag
        declares, and match its Adler-32 checksum (RFC 1950). zlib verifies the checksum only when
        it reaches the end of the stream, hence the last call.
        """
        inflater = zlib.decompressobj()
        try:
            head = inflater.decompress(body, 8)
            if len(head) < 8:
                raise Damaged(ENDS_EARLY())
            kind, size = struct.unpack(self.order + "II", head)
            if size > self.limit:
                raise TooLarge("variable", self.limit, size)
            inflated = inflater.decompress(inflater.unconsumed_tail, size) if size else b""
            if len(inflated) < size:
                raise Damaged(WRONG_INFLATED_SIZE(found="less", declared=size))
            more = b"" if inflater.eof else inflater.decompress(inflater.unconsumed_tail, 1)
        except zlib.error as error:
            raise Damaged(LIBRARY_FAILED(part="variable", error=str(error))) from error
        if more:
            raise Damaged(WRONG_INFLATED_SIZE(found="more", declared=size))
        if not inflater.eof:
            raise Damaged(CUT_BEFORE_CHECKSUM())
        if inflater.unused_data:
            count = len(inflater.unused_data)
            raise Damaged(TOO_MANY_BYTES(count=count, behind="checksum"))
        return kind, memoryview(inflated)

    def _matrix(self, body: memoryview, path: str, depth: int) -> str:
        """Hand one matrix element to the sink and return its path."""
        if depth > DEEPEST:
            raise Damaged(NESTED_TOO_DEEP(variable=path, most=DEEPEST))
        if not len(body):
            if not path:
                raise Damaged(NO_NAME())
            self.sink.add(Found(path, "double", (0, 0)))
            return path
        cursor = Cursor(body, self.order)
        kind, data = cursor.next()
        if kind != MI_UINT32 or len(data) < 8:
            raise Damaged(WRONG_TYPE(part="flags", found=kind))
        (flags,) = struct.unpack_from(self.order + "I", data)
        array_class, flags = flags & 0xFF, flags >> 8 & 0xFF
        if array_class == OPAQUE:
            name, _, class_name = cursor.text(), cursor.text(), cursor.text()
            path = path or name
            if not path:
                raise Damaged(NO_NAME())
            self.sink.add(Found(path, class_name or "object", is_object=True, shape=()))
            if self.inside_objects:
                self._child(cursor, path, depth)
            return path
        shape = cursor.integers()
        if len(shape) < 2:
            raise _misshapen(shape)
        name = cursor.text()
        path = path or name
        if not path:
            raise Damaged(NO_NAME())
        count = product(shape)
        if array_class == CELL:
            self.sink.add(Found(path, "cell", shape))
            for number in range(count):
                self._child(cursor, f"{path}{{{index(shape, number)}}}", depth)
        elif array_class in (STRUCT, OBJECT):
            self._struct(cursor, array_class, path, shape, depth)
        elif array_class in CLASSES:
            self._numbers(cursor, array_class, flags, path, shape)
        else:
            raise Damaged(UNKNOWN_CLASS_NUMBER(variable=path, found=array_class))
        if array_class not in UNREAD and any(body[cursor.at :]):
            raise Damaged(TOO_MANY_BYTES(count=len(body) - cursor.at, variable=path))
        return path

    def _child(self, cursor: Cursor, path: str, depth: int) -> None:
        kind, body = cursor.next()
        if kind != MI_MATRIX:
            raise Damaged(WRONG_TYPE(part="variable", found=kind, variable=path))
        self._matrix(body, path, depth + 1)

    def _struct(
        self, cursor: Cursor, array_class: int, path: str, shape: tuple[int, ...], depth: int
    ) -> None:
        if array_class == OBJECT:
            self.sink.add(Found(path, cursor.text() or "object", shape, is_object=True))
            if not self.inside_objects:
                return
        self.sink.add(Found(path, "struct", shape))
        lengths = cursor.integers()
        length = lengths[0] if lengths else 0
        kind, names = cursor.next()
        if kind != MI_INT8:
            raise Damaged(WRONG_TYPE(part="fields", found=kind, variable=path))
        if len(names) and (length < 1 or len(names) % length):
            raise Damaged(ODD_BYTES(part="fields", count=len(names), unit_size=length))
        fields = [
            name_of(bytes(names[i : i + length]).split(b"\0")[0])
            for i in range(0, len(names), length or 1)
        ]
        count = product(shape)
        for number in range(count if fields else 0):
            element = path if count == 1 else f"{path}({index(shape, number)})"
            for name in fields:
                self._child(cursor, f"{element}.{name}", depth)

    def _numbers(
        self, cursor: Cursor, array_class: int, flags: int, path: str, shape: tuple[int, ...]
    ) -> None:
        kind = "logical" if flags & LOGICAL_FLAG else CLASSES[array_class]
        if array_class == FUNCTION:
            self.sink.add(Found(path, kind, shape, is_object=True))
            return
        if array_class == SPARSE:
            rows, columns = self._element(cursor, path), self._element(cursor, path)
            if {rows[0], columns[0]} - {"i4", "u4"}:
                raise Damaged(
                    WRONG_TYPE(part="indices", found=f"{rows[0]}, {columns[0]}", variable=path)
                )
            self.sink.add(Found(path, "sparse", shape))
            return
        if array_class == CHAR:
            self.sink.add(Found(path, kind, shape, text=self._text(cursor, path, shape)))
            return
        dtype, data = self._element(cursor, path, shape)
        if flags & COMPLEX_FLAG:
            imaginary, more = self._element(cursor, path, shape)
            self.sink.add(Found(path, kind, shape, note="complex"))
            if self.inside_objects:
                self.sink.add(Found(path, kind, shape, data, self.order + dtype))
                self.sink.add(Found(path, kind, shape, more, self.order + imaginary))
        elif (
            kind in ("double", "single")
            or self.inside_objects
            or (kind in INTEGERS and is_vector(shape))
            or (kind == "logical" and is_vector(shape) and max(shape) > 1)
        ):
            self.sink.add(Found(path, kind, shape, data, self.order + dtype))
        else:
            truth = data[0] if kind == "logical" and len(data) == 1 else None
            said = "" if truth is None else "true" if truth else "false"
            self.sink.add(Found(path, kind, shape, text=said))

    def _element(
        self, cursor: Cursor, path: str, shape: tuple[int, ...] | None = None
    ) -> tuple[str, memoryview]:
        """Return the numpy type and the bytes of the next numbers of `path`.

        Raises Damaged where there are not as many as `shape` needs, None: any number.
        """
        element, data = cursor.next()
        if element not in ELEMENTS:
            raise Damaged(WRONG_TYPE(part="numbers", found=element, variable=path))
        dtype = ELEMENTS[element]
        if shape is not None and len(data) != product(shape) * int(dtype[-1]):
            needed = product(shape) * int(dtype[-1])
            raise Damaged(TOO_FEW_BYTES(variable=path, left=len(data), needed=needed))
        return dtype, data

    def _text(self, cursor: Cursor, path: str, shape: tuple[int, ...]) -> str:
        """Return a short line of text, else an empty one; step over the characters of `path`.

        Raises Damaged where there are not as many characters as `shape` needs.
        """
        count = product(shape)
        if not cursor and not count:
            return ""
        element, data = cursor.next()
        if element not in TEXT_SIZES:
            raise Damaged(WRONG_TYPE(part="text", found=element, variable=path))
        size = TEXT_SIZES[element]
        enough = len(data) >= count if element == MI_UTF8 else len(data) == count * size
        if not enough:
            raise Damaged(TOO_FEW_BYTES(text=path, left=len(data), needed=count * size))
        if shape[0] != 1 or count > LONGEST_TEXT:
            return ""
        suffix = "" if size == 1 else "-le" if self.order == "<" else "-be"
        return bytes(data).decode(f"utf-{8 * size}{suffix}", "replace")


MAT4_NUMBERS = {0: ("f8", 8), 1: ("f4", 4), 2: ("i4", 4), 3: ("i2", 2), 4: ("u2", 2), 5: ("u1", 1)}


def mat4_order(data: memoryview | bytes) -> str | None:
    """Return '<' or '>' where `data` begins like a v4 workspace, else None."""
    if len(data) < 20:
        return None
    for order, machine in (("<", 0), (">", 1)):
        kind, rows, columns, imaginary, length = struct.unpack_from(order + "5i", data)
        digits = kind // 1000, kind // 100 % 10, kind // 10 % 10, kind % 10
        name = bytes(data[20 : 20 + max(length, 0)])
        if (
            0 <= kind < 5000
            and digits[0] == machine
            and digits[1] == 0
            and digits[2] in MAT4_NUMBERS
            and digits[3] <= 2
            and min(rows, columns) >= 0
            and imaginary in (0, 1)
            and 1 <= length <= 1024
            and (name[:1].isalpha())
            and name.rstrip(b"\0").replace(b"_", b"a").isalnum()
        ):
            return order
    return None


def characters(codes: memoryview, order: str, number: str) -> str:
    """Return the text that a v4 file keeps as numbers of the numpy type `number`."""
    letter = {"f8": "d", "f4": "f", "i4": "i", "i2": "h", "u2": "H", "u1": "B"}[number]
    values = struct.unpack(f"{order}{len(codes) // int(number[1])}{letter}", codes)
    return "".join(chr(int(v)) if 0 <= v < 0x110000 else "\ufffd" for v in values)


def read_mat4(data: memoryview, sink: Sink) -> None:
    """Hand every variable of a v4 workspace to the sink; raise Damaged."""
    at = 0
    names: set[str] = set()
    while at < len(data):
        order = mat4_order(data[at:])
        if order is None:
            raise Damaged(NO_VARIABLE_HERE(byte=at))
        kind, rows, columns, imaginary, length = struct.unpack_from(order + "5i", data, at)
        name = bytes(data[at + 20 : at + 20 + length]).rstrip(b"\0").decode("latin-1")
        if name in names:
            raise Damaged(SAME_NAME(variable=name))
        names.add(name)
        number, size = MAT4_NUMBERS[kind // 10 % 10]
        begin = at + 20 + length
        one = rows * columns * size
        at = begin + one * (1 + imaginary)
        if at > len(data):
            left = len(data) - begin
            raise Damaged(TOO_FEW_BYTES(variable=name, left=left, needed=at - begin))
        if kind % 10 == 1:
            text = ""
            if rows == 1 and columns <= LONGEST_TEXT:
                codes = memoryview(data[begin : begin + one])
                text = characters(codes, order, number)
            sink.add(Found(name, "char", (rows, columns), text=text))
        elif kind % 10 == 2:
            sink.add(Found(name, "sparse", (rows, columns)))
        elif imaginary:
            sink.add(Found(name, "double", (rows, columns), note="complex"))
        else:
            sink.add(
                Found(name, "double", (rows, columns), data[begin : begin + one], order + number)
            )


ARCHIVE = b"PK\x03\x04"
SIGNATURES: tuple[tuple[bytes, str], ...] = (
    (ARCHIVE, "zip"),
    (b"\x93NUMPY", "numpy"),
    (b"\x89PNG", "png"),
    (b"\xff\xd8\xff", "jpeg"),
    (b"GIF8", "gif"),
    (b"%PDF", "pdf"),
    (b"version https://git-lfs", "lfs"),
    (b"Octave-1-", "octave"),
    (b"7z\xbc\xaf", "seven_zip"),
    (b"Rar!", "rar"),
    (b"\x7fELF", "elf"),
    (b"MZ", "exe"),
    (b"SQLite format 3", "sqlite3"),
    (b"BZh", "bzip"),
    (b"\xfd7zXZ", "xz"),
    (b"\x89MCAP", "mcap"),
    (b"\x28\xb5\x2f\xfd", "zstd"),
)
SPREADSHEET = "spreadsheet"
# A workbook's archive has one of these at its beginning or in the directory at its end.
SPREADSHEET_ENTRIES = (b"xl/workbook.", b"application/vnd.oasis.opendocument.spreadsheet")
ARCHIVE_END = 1 << 16
HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"


def recognise(data: memoryview) -> str:
    """Return mat4, mat5, hdf5, gzip, zstd, mcap, sqlite3, or what else the bytes are,
    a form of diagnostics.UNSUPPORTED_FORMAT."""
    head = bytes(data[:4096])
    if not head:
        return "empty"
    if head[:2] == b"\x1f\x8b":
        return "gzip"
    for offset in (0, 512, 1024, 2048):
        if head[offset : offset + 8] == HDF5_SIGNATURE:
            return "hdf5"
    if head[:6] == b"MATLAB" and len(head) >= 128:
        version = head[124:126] if head[126:128] == b"IM" else head[125:123:-1]
        if head[126:128] in (b"IM", b"MI"):
            return "mat5" if version == b"\x00\x01" else "version"
        return "header"
    readable = b"\0" not in head[:4]  # else v4, by the format's definition
    if (
        readable
        and head[126:128] in (b"IM", b"MI")
        and head[124:126] in (b"\x00\x01", b"\x01\x00")
    ):
        return "mat5"
    if mat4_order(head):
        return "mat4"
    if head.startswith(ARCHIVE) and _is_spreadsheet(data):
        return SPREADSHEET
    for signature, form in SIGNATURES:
        if head.startswith(signature):
            return form
    return _text(head)


def _is_spreadsheet(archive: memoryview) -> bool:
    """Return whether an archive is a workbook of Excel or LibreOffice."""
    ends = bytes(archive[:4096]), bytes(archive[-ARCHIVE_END:])
    return any(entry in end for entry in SPREADSHEET_ENTRIES for end in ends)


def _text(head: bytes) -> str:
    try:
        text = head.decode("utf-8", "strict" if len(head) < 4096 else "ignore").lstrip()
    except UnicodeDecodeError:
        return "unknown"
    if any(ord(c) < 32 and c not in "\t\r\n\f" for c in text):
        return "unknown"
    if "Created by Octave" in text[:200]:
        return "octave"
    if text[:200].lower().startswith(("<!doctype html", "<html")):
        return "html"
    return "text"
