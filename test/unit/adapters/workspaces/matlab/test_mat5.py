"""The readers of MATLAB's formats, against scipy's and Octave's writers and against damage."""

import contextlib
import gzip
import io
import struct
import zlib
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
import zstandard
from found_matrices import matrix
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.diagnostics import (
    BAD_DIMENSIONS,
    CELLS_UNREADABLE,
    CUT_BEFORE_CHECKSUM,
    LIBRARY_FAILED,
    NESTED_TOO_DEEP,
    NO_NAME,
    NO_TEXT,
    SAME_NAME,
    TOO_FEW_BYTES,
    TOO_MANY_BYTES,
    WRONG_INFLATED_SIZE,
    WRONG_TYPE,
)
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, NotAWorkspace, TooLarge
from mrlab_ros.adapters.workspaces.matlab.mat5 import Mat5Reader

LIMIT = 1 << 26
EXAMPLES = [
    path
    for path in sorted((Path(__file__).parents[5] / "examples").glob("*.mat"))
    if not h5py.is_hdf5(path)
]


class Collected(dict):
    """A sink: path -> (kind, shape, values or None, is_object, note, text)."""

    def add(self, found):
        facts = found.is_object, found.note, found.text
        self[found.path] = found.kind, tuple(found.shape), matrix(found), *facts

    def kind(self, path):
        return self[path][0]

    def values(self, path):
        return self[path][2]


@contextlib.contextmanager
def damaged(code, **values):
    """Expect that a file is damaged, for this reason."""
    with pytest.raises(Damaged) as caught:
        yield
    (why,) = caught.value.args
    assert why.code == code.code
    assert values.items() <= why.values.items()


def read(data, name="traj.mat", limit=LIMIT):
    sink = Collected()
    form = file_formats.read(memoryview(data), name, sink, limit)
    return form, sink


def saved(*, compressed=False, form="5", **variables):
    buffer = io.BytesIO()
    scipy.io.savemat(buffer, variables, do_compression=compressed, format=form)
    return buffer.getvalue()


MATRICES = hnp.arrays(
    st.sampled_from([np.float64, np.float32]),
    hnp.array_shapes(min_dims=2, max_dims=2, max_side=12),
    elements=st.floats(-100, 100, width=32),
)


@settings(deadline=None)
@given(MATRICES, st.booleans())
def test_v5_to_v7_give_back_the_numbers(matrix, compressed):
    form, sink = read(saved(q=matrix, compressed=compressed))
    assert form == "MATLAB v5 to v7"
    np.testing.assert_array_equal(sink.values("q"), matrix)
    assert sink.kind("q") == ("double" if matrix.dtype == np.float64 else "single")


@settings(deadline=None)
@given(MATRICES.filter(lambda m: m.dtype == np.float64))
def test_v4_gives_back_the_numbers(matrix):
    form, sink = read(saved(q=matrix, form="4"))
    assert form == "MATLAB v4"
    np.testing.assert_array_equal(sink.values("q"), matrix)


def hdf5(matrices):
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        for name, matrix in matrices.items():
            item = file.create_dataset(name, data=matrix.T, chunks=True, compression="gzip")
            item.attrs["MATLAB_class"] = np.bytes_(
                {"f8": "double", "f4": "single"}.get(matrix.dtype.str[1:], matrix.dtype.name)
            )
    header = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8) + b"\x00\x02IM"
    return header.ljust(512, b"\0") + buffer.getvalue()[512:]


@settings(deadline=None, max_examples=25)
@given(MATRICES)
def test_v7_3_gives_back_the_numbers(matrix):
    form, sink = read(hdf5({"q": matrix}))
    assert form == "MATLAB v7.3"
    np.testing.assert_array_equal(sink.values("q"), matrix)


@pytest.mark.parametrize("compress", [gzip.compress, zstandard.compress])
def test_what_is_compressed_is_looked_into(compress):
    q = np.arange(12.0).reshape(2, 6)
    form, sink = read(compress(saved(q=q)), "traj.mat.gz")
    assert form == "MATLAB v5 to v7"
    np.testing.assert_array_equal(sink.values("q"), q)
    with pytest.raises(TooLarge):
        read(compress(bytes(5000)), limit=4000)
    with pytest.raises(Damaged):
        read(compress(saved(q=q))[:-20])


def test_containers_have_the_paths_that_matlab_writes():
    q = np.arange(12.0).reshape(2, 6)
    cells = np.empty((2, 2), object)
    cells[:] = [[q, q + 1], ["text", q + 3]]
    row = np.empty((1, 3), object)
    row[:] = [[q, q + 1, q + 2]]
    pair = np.zeros((1, 2), dtype=[("q", object), ("n", object)])
    pair[0, 0] = (q, 1.0)
    pair[0, 1] = (q + 5, 2.0)
    data = saved(
        out={"q": {"time": np.arange(2.0), "signals": {"values": q}}}, c=cells, r=row, s=pair
    )
    _, sink = read(data)
    np.testing.assert_array_equal(sink.values("out.q.signals.values"), q)
    np.testing.assert_array_equal(sink.values("c{1,2}"), q + 1)
    assert sink.kind("c{2,1}") == "char"
    np.testing.assert_array_equal(sink.values("c{2,2}"), q + 3)
    np.testing.assert_array_equal(sink.values("r{3}"), q + 2)
    np.testing.assert_array_equal(sink.values("s(2).q"), q + 5)
    assert sink["s"][:2] == ("struct", (1, 2))


def test_what_has_no_numbers_is_listed_with_its_class():
    sparse = scipy.sparse.csc_matrix(np.eye(6))
    data = saved(
        z=np.ones((3, 6)) * 1j,
        i=np.ones((3, 6), np.int16),
        b=np.ones((3, 6), bool),
        s=sparse,
        e=np.zeros((0, 6)),
        t="abc",
    )
    _, sink = read(data)
    assert sink["z"][4] == "complex"
    kinds = {k: sink.kind(k) for k in "ibset"}
    assert kinds == {"i": "int16", "b": "logical", "s": "sparse", "e": "double", "t": "char"}
    assert sink["e"][1] == (0, 6)
    assert sink["t"][5] == "abc"


@pytest.mark.parametrize("form", ["4", "5"])
def test_short_texts_are_kept_one_line_a_row_and_longer_ones_are_not(form):
    _, sink = read(saved(a="Gelenk 1", b=["ab", "cd"], c="x" * 3000, form=form))
    assert [sink[name][5] for name in "abc"] == ["Gelenk 1", "ab\ncd" if form == "5" else "", ""]
    if form == "5":
        assert read(saved(a="Größe"))[1]["a"][5] == "Größe"


def element(kind, data, order="<"):
    return struct.pack(order + "II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix5(flags, parts, order="<"):
    head = element(6, struct.pack(order + "II", flags, 0), order)
    return element(14, head + b"".join(parts), order)


def test_what_octave_writes_as_hdf5_is_named():
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        group = file.create_group("q")
        group.attrs["OCTAVE_NEW_FORMAT"] = np.uint8(1)
    with pytest.raises(NotAWorkspace, match="octave"):
        read(buffer.getvalue())


def header5(order="<"):
    text = b"MATLAB 5.0 MAT-file, Platform: TEST".ljust(116) + bytes(8)
    return text + (b"\x00\x01IM" if order == "<" else b"\x01\x00MI")


def test_big_endian_and_doubles_stored_as_small_integers():
    q = np.arange(12, dtype=np.int16).reshape(2, 6)
    parts = [
        element(5, struct.pack(">ii", 2, 6), ">"),
        element(1, b"q", ">"),
        element(3, q.astype(">i2").tobytes(order="F"), ">"),
    ]
    _, sink = read(header5(">") + matrix5(6, parts, ">"))
    assert sink.kind("q") == "double"
    np.testing.assert_array_equal(sink.values("q"), q)


def test_objects_are_listed_by_name_and_class():
    parts = [element(1, b"ts"), element(1, b"MCOS"), element(1, b"timeseries")]
    reference = matrix5(
        13, [element(5, struct.pack("<ii", 1, 1)), element(1, b""), element(6, bytes(4))]
    )
    _, sink = read(header5() + matrix5(17, [*parts, reference]))
    assert sink["ts"][0] == "timeseries"
    assert sink["ts"][3]


def test_v7_3_containers_and_objects():
    q = np.arange(12.0).reshape(2, 6)
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        hidden = file.create_group("#refs#")
        references = []
        for i in range(2):
            item = hidden.create_dataset(f"a{i}", data=(q + i).T)
            item.attrs["MATLAB_class"] = np.bytes_("double")
            references.append([item.ref])
        cell = file.create_dataset("c", data=references, dtype=h5py.ref_dtype)
        cell.attrs["MATLAB_class"] = np.bytes_("cell")
        struct_group = file.create_group("s")
        struct_group.attrs["MATLAB_class"] = np.bytes_("struct")
        inner = struct_group.create_dataset("q", data=q.T)
        inner.attrs["MATLAB_class"] = np.bytes_("double")
        array = file.create_group("a")
        array.attrs["MATLAB_class"] = np.bytes_("struct")
        array.create_dataset("q", data=references, dtype=h5py.ref_dtype)
        thing = file.create_dataset("ts", data=np.zeros((1, 6), np.uint32))
        thing.attrs["MATLAB_class"] = np.bytes_("timeseries")
        thing.attrs["MATLAB_object_decode"] = np.int32(3)
        text = file.create_dataset("t", data=np.array([[111], [107], [0xE4]], np.uint16))
        text.attrs["MATLAB_class"] = np.bytes_("char")
        nothing = file.create_dataset("e", data=np.array([0, 6], np.uint64))
        nothing.attrs["MATLAB_class"] = np.bytes_("double")
        nothing.attrs["MATLAB_empty"] = np.uint8(1)
        pairs = np.zeros((6, 2), dtype=[("real", "f8"), ("imag", "f8")])
        file.create_dataset("z", data=pairs).attrs["MATLAB_class"] = np.bytes_("double")
        file["elsewhere"] = h5py.ExternalLink("/etc/hostname", "/")
    _, sink = read(buffer.getvalue())
    np.testing.assert_array_equal(sink.values("c{2}"), q + 1)
    np.testing.assert_array_equal(sink.values("s.q"), q)
    np.testing.assert_array_equal(sink.values("a(2).q"), q + 1)
    assert (sink.kind("ts"), sink["ts"][3]) == ("timeseries", True)
    assert (sink.kind("t"), sink["t"][5]) == ("char", "okä")
    assert sink["e"][1:3] == ((0, 6), None)
    assert sink["z"][4] == "complex"
    assert "elsewhere" not in sink


@pytest.mark.parametrize(
    ("data", "form"),
    [
        (b"", "empty"),
        (b"PK\x03\x04rest", "zip"),
        (b"\x89PNG\r\n\x1a\n", "png"),
        (b"version https://git-lfs.github.com/spec/v1\n", "lfs"),
        (b"# Created by Octave 8.4.0\n# name: q\n", "octave"),
        (b"Octave-1-L\0\0\0\0\0\1\0\0\0q", "octave"),
        (b"<!DOCTYPE html><html>", "html"),
        (b"q = [1 2 3];\n", "text"),
        (b"\x00\x9f\x92\x96" * 20, "unknown"),
        (b"MATLAB 5.0 MAT-file".ljust(128, b" "), "header"),
        (b"SQLite format 3\0", "sqlite"),
    ],
)
def test_other_files_are_named_for_what_they_are(data, form):
    with pytest.raises(NotAWorkspace, match=form):
        read(data)


GOOD = saved(q=np.arange(60.0).reshape(10, 6), s={"a": np.ones((3, 3))})
SMALL = saved(q=np.arange(60.0).reshape(10, 6), compressed=True)


@pytest.mark.parametrize("data", [GOOD, SMALL])
def test_no_cut_file_is_taken(data):
    whole = set(read(data)[1])
    for length in range(128, len(data)):
        try:
            _, sink = read(data[:length])
        except (Damaged, NotAWorkspace):
            continue
        # cut between two variables nothing can be seen; whole variables are all there is then
        assert set(sink) < whole
        assert length == 128 or "q" in sink


@settings(deadline=None, max_examples=300)
@given(st.data(), st.sampled_from([GOOD, SMALL, saved(q=np.ones((4, 6)), form="4")]))
@pytest.mark.slow
def test_damage_is_refused_or_read_but_never_anything_else(data, good):
    damaged = bytearray(good)
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(good) - 1))
        damaged[at] = data.draw(st.integers(0, 255))
    with contextlib.suppress(Damaged, TooLarge, NotAWorkspace):
        read(bytes(damaged))


@settings(deadline=None, max_examples=100)
@given(st.binary(max_size=400))
def test_any_bytes_after_a_header_are_refused_or_read(body):
    for start in (header5(), header5(">")):
        with contextlib.suppress(Damaged, TooLarge):
            read(start + body)


def test_a_wrong_element_type_is_named():
    parts = [element(5, struct.pack("<ii", 1, 6)), element(1, b"q"), element(77, bytes(48))]
    with damaged(WRONG_TYPE, part="numbers", found=77, variable="q"):
        read(header5() + matrix5(6, parts))


def test_dimensions_that_disagree_with_the_numbers_are_named():
    parts = [element(5, struct.pack("<ii", 9, 6)), element(1, b"q"), element(9, bytes(48))]
    with damaged(TOO_FEW_BYTES, variable="q", needed=432):
        read(header5() + matrix5(6, parts))
    parts[0] = element(5, struct.pack("<ii", -1, -6))
    with damaged(BAD_DIMENSIONS):
        read(header5() + matrix5(6, parts))


def test_a_bomb_is_refused_by_what_it_declares():
    body = zlib.compress(struct.pack("<II", 14, 1 << 30) + bytes(1000))
    with pytest.raises(TooLarge, match=str(1 << 30)):
        read(header5() + struct.pack("<II", 15, len(body)) + body)


def test_a_wrong_checksum_is_refused():
    body = bytearray(SMALL)
    body[-1] ^= 0xFF
    with damaged(LIBRARY_FAILED, part="variable"):
        read(bytes(body))


def compressed(content, *, checksum=None, extra=b"", declared=None):
    """Return a v7 file of one matrix element `content`, with its zlib stream made by hand."""
    size = len(content) - 8 if declared is None else declared
    content = content[:4] + struct.pack("<I", size) + content[8:]
    stream = zlib.compress(content)
    if checksum is not None:
        stream = stream[: len(stream) - 4 + len(checksum)][: len(stream) - 4] + checksum
    stream += extra
    return header5() + struct.pack("<II", 15, len(stream)) + stream


ONE = matrix5(6, [element(5, struct.pack("<ii", 1, 6)), element(1, b"q"), element(9, bytes(48))])


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"checksum": bytes(4)}, LIBRARY_FAILED),
        ({"checksum": b""}, CUT_BEFORE_CHECKSUM),
        ({"checksum": zlib.adler32(ONE).to_bytes(4, "big")[:2]}, CUT_BEFORE_CHECKSUM),
        ({"extra": b"garbage"}, TOO_MANY_BYTES),
        ({"declared": len(ONE) - 16}, WRONG_INFLATED_SIZE),
        ({"declared": len(ONE)}, WRONG_INFLATED_SIZE),
    ],
)
def test_a_compressed_variable_ends_where_it_says_and_matches_its_checksum(change, code):
    assert "q" in read(compressed(ONE))[1]
    with damaged(code):
        read(compressed(ONE, **change))


def test_no_changed_bit_of_a_compressed_file_changes_a_number():
    q = np.cumsum(np.random.default_rng(1).normal(size=(20, 6)), axis=0)
    data = saved(q=q, compressed=True)
    refused = 0
    for at in range(128, len(data)):
        for bit in range(8):
            damaged = bytearray(data)
            damaged[at] ^= 1 << bit
            try:
                _, sink = read(bytes(damaged))
            except (Damaged, TooLarge):
                refused += 1
                continue
            np.testing.assert_array_equal(sink.values("q"), q)
    assert refused > 0.99 * 8 * (len(data) - 128)


def test_a_variable_without_a_name_is_refused():
    parts = [element(5, struct.pack("<ii", 1, 6)), element(1, b""), element(9, bytes(48))]
    with damaged(NO_NAME):
        read(header5() + matrix5(6, parts))


@pytest.mark.parametrize("form", ["4", "5"])
def test_two_variables_of_one_name_are_refused(form):
    once = saved(q=np.ones((2, 6)), form=form)
    with damaged(SAME_NAME, variable="q"):
        read(once + once[128 if form == "5" else 0 :])


def test_nesting_has_an_end():
    inner = b""
    for _ in range(60):
        inner = matrix5(
            1, [element(5, struct.pack("<ii", 1, 1)), element(1, b"c"), inner or element(14, b"")]
        )
    with damaged(NESTED_TOO_DEEP):
        Mat5Reader(Collected(), LIMIT).read(memoryview(header5() + inner))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_the_examples_that_octave_wrote_agree_with_scipy(path):
    _, sink = read(path.read_bytes(), path.name)
    for name, values in scipy.io.loadmat(path).items():
        if not name.startswith("__") and values.dtype.kind == "f":
            np.testing.assert_array_equal(sink.values(name), values)


def test_there_are_examples():
    assert EXAMPLES


def test_a_table_with_headings():
    text = "time;a1;a2\r\n0;0.5;1\r\n0.1;0.25;2\r\n"
    form, sink = read(text.encode(), "run.csv")
    assert form == "CSV"
    np.testing.assert_array_equal(sink.values("t"), [[0.0], [0.1]])
    np.testing.assert_array_equal(sink.values("q"), [[0.5, 1.0], [0.25, 2.0]])
    _, sink = read(b"a,b\r1,2\r3,4\r", "run.csv")
    np.testing.assert_array_equal(sink.values("q"), [[1.0, 2.0], [3.0, 4.0]])
    with damaged(CELLS_UNREADABLE):
        read(b"'a'," + b"x" * 200_000 + b"\n1,2\n", "run.csv")
    with pytest.raises(Damaged):
        read(b"a,b\n1,2\n3\n", "run.csv")
    _, sink = read("ä,b\n1,2\n".encode("latin-1"), "run.csv")
    np.testing.assert_array_equal(sink.values("q"), [[1.0, 2.0]])
    with damaged(NO_TEXT, encoding="UTF-8"):
        read(b"\xe4,b\n1,2\n\x01", "run.csv")


def test_npz_never_unpickles():
    buffer = io.BytesIO()
    np.savez(buffer, q=np.ones((3, 6)), fs=50.0)
    form, sink = read(buffer.getvalue(), "run.npz")
    assert form == "NumPy npz"
    np.testing.assert_array_equal(sink.values("q"), np.ones((3, 6)))
    assert sink.values("fs").item() == 50.0
    encrypted = bytearray(buffer.getvalue())
    encrypted[encrypted.index(b"PK\1\2") + 8] |= 1
    with damaged(LIBRARY_FAILED, part="npz"):
        read(encrypted, "run.npz")
    buffer = io.BytesIO()
    np.savez(buffer, q=np.array([{}, 1], dtype=object))
    with damaged(LIBRARY_FAILED, part="npz"):
        read(buffer.getvalue(), "run.npz")
