"""Recognises the kind of a file by its first bytes."""

from __future__ import annotations

import struct

MAT4_NUMBERS = {0: ("f8", 8), 1: ("f4", 4), 2: ("i4", 4), 3: ("i2", 2), 4: ("u2", 2), 5: ("u1", 1)}
HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"

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
    if head.startswith(ARCHIVE) and _holds_arrays(head):
        return "npz"
    for signature, form in SIGNATURES:
        if head.startswith(signature):
            return form
    return _text(head)


def _holds_arrays(head: bytes) -> bool:
    """Return whether the first entry of an archive is an array of NumPy."""
    length = int.from_bytes(head[26:28], "little")
    return head[30 : 30 + length].endswith(b".npy")


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
