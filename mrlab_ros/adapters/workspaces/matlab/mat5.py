"""Reads MATLAB's own formats v4 to v7 from bytes; `mat73` reads v7.3.

Runs in the sandboxed process of `worker`, on bytes that somebody sent. Every length is
checked against what there is. The format is that of MathWorks' "MAT-File Format" document.
"""

from __future__ import annotations

import struct
import zlib

from mrlab_ros.adapters.workspaces.diagnostics import (
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
from mrlab_ros.adapters.workspaces.matlab.elements import (
    ELEMENTS,
    MI_COMPRESSED,
    MI_INT8,
    MI_MATRIX,
    MI_UINT32,
    MI_UTF8,
    TEXT_SIZES,
    Cursor,
    Damaged,
    TooLarge,
    _misshapen,
    characters,
    index,
    is_vector,
    name_of,
    product,
)
from mrlab_ros.adapters.workspaces.matlab.recognition import MAT4_NUMBERS, mat4_order
from mrlab_ros.adapters.workspaces.sinks import Found, Sink

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
LONGEST_TEXT = 2000  # characters of a text that is kept


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
        """Return a short text, one line a row, else an empty one; step over its characters.

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
        if len(shape) != 2 or count > LONGEST_TEXT:
            return ""
        suffix = "" if size == 1 else "-le" if self.order == "<" else "-be"
        return in_lines(bytes(data).decode(f"utf-{8 * size}{suffix}", "replace"), shape[0])


def in_lines(text: str, rows: int) -> str:
    """Return a matrix of characters, column by column, as one line a row."""
    if rows == 1:
        return text
    return "\n".join(text[row::rows].rstrip() for row in range(rows)) if rows else ""


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
