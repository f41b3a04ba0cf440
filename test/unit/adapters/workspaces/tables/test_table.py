"""Arrays, objects and texts that a person writes without MATLAB become variables."""

import io
import json

import numpy as np
import pytest

from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable

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
