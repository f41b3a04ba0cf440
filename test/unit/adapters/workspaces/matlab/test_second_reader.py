"""The second reader agrees on whole files and refuses what differs."""

import io

import h5py
import numpy as np
import pytest
import scipy.io
from found_matrices import matrix
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.matlab import second_reader
from mrlab_ros.adapters.workspaces.matlab.second_reader import difference, disagreement, steps
from mrlab_ros.adapters.workspaces.sinks import View

Q = np.arange(60.0).reshape(10, 6)
LIMIT = 1 << 26


class Collected(dict):
    """A sink: path -> values."""

    def add(self, found):
        if found.data is not None:
            self[found.path] = matrix(found)


def content():
    cells = np.empty((2, 2), object)
    cells[:] = [[Q, Q + 1], ["text", {"q": Q + 3}]]
    row = np.empty((1, 3), object)
    row[:] = [[Q, Q + 1, Q + 2]]
    pair = np.zeros((1, 2), dtype=[("q", object), ("n", object)])
    pair[0, 0] = (Q, 1.0)
    pair[0, 1] = (Q + 5, {"deep": Q + 6})
    grid = np.zeros((2, 2), dtype=[("q", object)])
    for i, place in enumerate(np.ndindex(2, 2)):
        grid[place] = (Q + 10 * i,)
    log = {"time": np.arange(2.0), "signals": {"values": Q}}
    return {"q": Q, "f": np.float32(Q), "out": {"q": log}, "c": cells, "r": row, "s": pair} | {
        "g": grid
    }


def hdf5():
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        hidden = file.create_group("#refs#")

        def numbers(group, name, values):
            item = group.create_dataset(name, data=values.T)
            item.attrs["MATLAB_class"] = np.bytes_("double")
            return item.ref

        numbers(file, "q", Q)
        references = [
            [numbers(hidden, f"r{i}{j}", Q + 10 * i + j) for i in (0, 1)] for j in (0, 1)
        ]
        cell = file.create_dataset("c", data=references, dtype=h5py.ref_dtype)
        cell.attrs["MATLAB_class"] = np.bytes_("cell")
        out = file.create_group("out")
        out.attrs["MATLAB_class"] = np.bytes_("struct")
        numbers(out, "q", Q + 2)
        array = file.create_group("a")
        array.attrs["MATLAB_class"] = np.bytes_("struct")
        array.create_dataset("q", data=references, dtype=h5py.ref_dtype)
        line = file.create_group("l")
        line.attrs["MATLAB_class"] = np.bytes_("struct")
        line.create_dataset("q", data=[[r] for r, _ in references], dtype=h5py.ref_dtype)
    header = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
    return header.ljust(512, b"\0") + buffer.getvalue()[512:]


def saved(content, *, compressed=False, form="5"):
    buffer = io.BytesIO()
    scipy.io.savemat(buffer, content, do_compression=compressed, format=form)
    return buffer.getvalue()


FILES = {
    "v6": saved(content()),
    "v7": saved(content(), compressed=True),
    "v4": saved({"q": Q}, form="4"),
    "v7.3": hdf5(),
}


@pytest.mark.parametrize("version", FILES)
def test_every_matrix_at_every_path_agrees(version):
    data = memoryview(FILES[version])
    found = Collected()
    file_formats.read(data, "traj.mat", found, LIMIT)
    assert len(found) >= {"v4": 1, "v7.3": 8}.get(version, 17)
    for path, values in found.items():
        assert disagreement(data, path, values) is None


@pytest.mark.parametrize("version", FILES)
def test_one_bit_of_difference_is_refused(version):
    values = Q.copy()
    values.view(np.uint64)[4, 2] ^= 1
    found = disagreement(memoryview(FILES[version]), "q", values)
    place = [found.values[name] for name in ("row", "column", "count", "total")]
    assert (found.code, place) == ("second_finds", [5, 3, 1, 60])


@pytest.mark.parametrize("version", FILES)
def test_a_matrix_that_the_second_reader_does_not_find_is_refused(version):
    found = disagreement(memoryview(FILES[version]), "other", Q)
    assert found.code == "second_cannot_read"


def test_a_file_that_the_second_reader_refuses_is_refused():
    found = disagreement(memoryview(FILES["v7"][:200]), "q", Q)
    assert (found.code, found.values["reader"]) == ("second_cannot_read", "scipy")


def test_formats_with_one_reader_pass():
    assert disagreement(memoryview(b"a,b\n1,2\n"), "q", Q) is None


MATRICES = hnp.arrays(
    st.sampled_from(["<f8", ">f8", "<f4", ">i2", "u1"]),
    hnp.array_shapes(min_dims=2, max_dims=2, max_side=6),
)


@given(MATRICES)
@pytest.mark.slow
def test_a_matrix_equals_itself_in_any_type(matrix):
    other = matrix.astype("<f8") if matrix.dtype.kind == "f" else matrix
    assert not difference(matrix, other, "scipy")


def test_difference_compares_bits():
    nan = np.array([[np.nan, 0.0]])
    assert not difference(nan, nan.copy(), "scipy")
    found = difference(nan, np.array([[np.nan, -0.0]]), "scipy")
    assert (found.values["second"], found.values["first"]) == ("-0.0", "0.0")
    found = difference(nan, np.zeros((2, 1)), "scipy")
    assert (found.code, found.values["size"]) == ("second_finds_size", "2x1")
    found = difference(nan, np.zeros((1, 2), bool), "scipy")
    assert (found.code, found.values["found"]) == ("second_finds_type", "bool")


@settings(max_examples=50)
@given(st.lists(st.sampled_from([".a_1", "(3)", "{2}", "(1,2)", "{10,1,4}"]), max_size=5))
def test_a_path_is_split_into_its_steps(parts):
    first, *found = steps("x" + "".join(parts))
    assert first == ("variable", "x")
    kinds = {".": "field", "(": "element", "{": "cell"}
    assert [kind for kind, _ in found] == [kinds[part[0]] for part in parts]


@pytest.mark.parametrize("path", ["", ".q", "a..b", "a(b)", "a{}", "a(1"])
def test_what_is_no_path_is_refused(path):
    with pytest.raises(ValueError, match=r"begins with no name|cannot be followed"):
        list(steps(path))


def test_a_view_is_a_file():
    file = io.BufferedReader(View(memoryview(b"0123456789")))
    assert file.read(4) == b"0123"
    assert file.seek(-2, io.SEEK_END) == 8
    assert file.read() == b"89"
    assert file.seek(100) == 100
    assert file.read() == b""
    assert second_reader.recognise(memoryview(b"")) == "empty"


@pytest.mark.parametrize("form", ["v7", "v7.3"])
def test_arrays_of_three_dimensions_are_compared_too(form):
    values = Q.T[:, None, :]
    buffer = io.BytesIO()
    if form == "v7":
        scipy.io.savemat(buffer, {"q": values})
    else:
        with h5py.File(buffer, "w", userblock_size=512) as file:
            item = file.create_dataset("q", data=values.T)
            item.attrs["MATLAB_class"] = np.bytes_("double")
        buffer.seek(0)
        buffer.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    data = memoryview(buffer.getvalue())
    found = Collected()
    file_formats.read(data, "traj.mat", found, LIMIT)
    np.testing.assert_array_equal(found["q"], values)
    assert disagreement(data, "q", found["q"]) is None
    other = values.copy()
    other[3, 0, 4] += 1
    differs = disagreement(data, "q", other)
    place = [differs.values[name] for name in ("row", "column", "page", "count", "total")]
    assert place == [4, 1, 5, 1, 60]
