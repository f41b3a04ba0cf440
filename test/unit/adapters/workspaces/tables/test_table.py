"""Arrays, objects and texts that a person writes without MATLAB become variables."""

import io
import json

import numpy as np
import pytest

from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable, NotAWorkspace

Q = np.arange(12.0).reshape(2, 6) / 7


class Sink(dict):
    def add(self, found):
        values = found.data and np.frombuffer(found.data, found.dtype)
        self[found.path] = values if values is None else values.reshape(found.shape, order="F")


def read(data, name):
    sink = Sink()
    file_formats.read(memoryview(data), name, sink, 1 << 24)
    return sink


@pytest.mark.parametrize("dtype", ["<f8", ">f8", "<f4"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_an_npy_file_is_the_matrix_q(dtype, order):
    file = io.BytesIO()
    np.save(file, np.array(Q, dtype, order=order))
    np.testing.assert_array_equal(read(file.getvalue(), "a.npy")["q"], Q.astype(dtype))


def test_records_of_lists_and_of_numbers_are_rows():
    records = [{"t": i / 10, "q": list(row)} for i, row in enumerate(Q)]
    for document in (records, {"frames": records}):
        found = read(json.dumps(document).encode(), "a.json")
        np.testing.assert_array_equal(found["q"], Q)
        np.testing.assert_array_equal(found["t"].ravel(), [0, 0.1])
    flat = [{"time": i, **{f"q{j}": v for j, v in enumerate(row)}} for i, row in enumerate(Q)]
    np.testing.assert_array_equal(read(json.dumps(flat).encode(), "a.json")["records"], Q)


def test_exponents_of_fortran_are_numbers():
    text = "\n".join(" ".join(f"{v:.17e}".replace("e", "D") for v in row) for row in Q)
    np.testing.assert_array_equal(read(text.encode(), "a.txt")["q"], Q)


def test_headings_that_stand_again_are_named():
    with pytest.raises(NotATable) as caught:
        read(b"q1,q2\n1,2\n3,4\nq1,q2\n5,6\n", "a.csv")
    found = caught.value.args[0]
    assert (found.code, found.values["line"]) == ("headings_again", 4)


def saved(writer, *arrays, **named):
    file = io.BytesIO()
    writer(file, *arrays, **named)
    return file.getvalue()


TABLE = b"q1,q2,q3,q4,q5,q6\n" + b"\n".join(",".join(map(str, r)).encode() for r in Q.tolist())


@pytest.mark.parametrize(
    ("data", "endings"),
    [
        (saved(np.savez, q=Q), ".npz .npy .mat .csv .json"),
        (saved(np.save, Q), ".npz .npy .mat .csv .json"),
        (json.dumps({"q": Q.tolist()}).encode(), ".json .mat .csv .txt .npz"),
        (json.dumps(Q.tolist()).encode(), ".json .mat"),
        (TABLE, ".csv .mat .json .npz .dat"),
    ],
)
def test_a_file_is_what_it_holds_whatever_it_is_called(data, endings):
    for ending in endings.split():
        np.testing.assert_array_equal(read(data, "a" + ending)["q"], Q, ending)


def test_a_text_that_is_no_table_is_refused_as_a_text_where_it_is_not_called_one():
    for name in ("a.mat", "a.json", "a.npz"):
        with pytest.raises(NotAWorkspace) as caught:
            read(b"hello world", name)
        assert caught.value.args == ("text",)


def test_nan_is_read_from_json_as_python_writes_it():
    rows = Q.tolist()
    rows[1][2], rows[1][3] = float("nan"), float("-inf")
    found = read(json.dumps({"q": rows}).encode(), "a.json")["q"]
    assert np.isnan(found[1, 2])
    assert found[1, 3] == -np.inf


def test_other_floats_and_structured_arrays_are_read():
    for kind, kept in ((np.float16, np.float32), (np.longdouble, np.float64)):
        found = read(saved(np.save, Q.astype(kind)), "a.npy")["q"]
        assert found.dtype == kept
        np.testing.assert_array_equal(found, Q.astype(kind).astype(kept))
    fields = [("t", "f8"), ("pose", "f8", 6), *((f"q{i}", "f4") for i in range(6))]
    records = np.zeros(2, dtype=fields)
    records["t"], records["pose"], records["q5"] = (0, 0.1), Q, (3, 4)
    found = read(saved(np.save, records), "a.npy")
    assert found["t"].ravel().tolist() == [0, 0.1]
    np.testing.assert_array_equal(found["pose"], Q)
    np.testing.assert_array_equal(found["q"][:, 5], [3, 4])


def test_dates_in_json_are_seconds_since_the_first():
    dates = ["2026-01-01T23:59:59.900Z", "2026-01-02T00:00:00.100Z"]
    records = [{"date": date, "q": list(row)} for date, row in zip(dates, Q, strict=True)]
    for document in (records, {"date": dates, "q": Q.tolist()}):
        found = read(json.dumps(document).encode(), "a.json")
        np.testing.assert_allclose(found["date"].ravel(), [0, 0.2], atol=1e-9)
