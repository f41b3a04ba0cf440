"""A v7.3 workspace gives nothing of any other file, whatever way it names."""

import io
from pathlib import Path

import h5py
import hostile_hdf5 as hostile
import numpy as np
import pytest

from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.adapters.workspaces import file_formats, worker
from mrlab_ros.adapters.workspaces.matlab import mat73
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, TooLarge
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.core.base.errors import BadInput

pytestmark = pytest.mark.fast
AT_ONCE = 150  # of the 2,000 files of the fuzz, in `make test`


@pytest.fixture
def marker(tmp_path) -> Path:
    path = tmp_path / "key.bin"
    path.write_bytes(hostile.MARKER)
    with h5py.File(tmp_path / "key.h5", "w") as file:
        file["q"] = np.frombuffer(hostile.MARKER, "<f8")
    return path


@pytest.fixture(scope="module")
def reader():
    with WorkspaceReader() as made:
        yield made


def said(reader: WorkspaceReader, data: bytes) -> str:
    """Return all that a reading tells of a file, numbers included."""
    try:
        found = reader.read_bytes(data, "traj.mat")
    except BadInput as error:
        return str(error)
    words = [repr(found)]
    for variable in found.variables:
        words.append(repr(variable))
        if variable.values is not None:
            words.append(str(variable.values.tolist()))
            words.append(repr(np.ascontiguousarray(variable.values).tobytes()))
    return "\n".join(words)


def lengths_elsewhere(file, marker):
    for n, kind in enumerate(("double", "struct", "char", "logical", "cell")):
        data = hostile.external(file, f"v{n}", marker, 64 * n)
        data.attrs["MATLAB_class"] = np.bytes_(kind)
        data.attrs["MATLAB_empty"] = np.uint8(1)


def values_elsewhere(file, marker):
    for n, kind in enumerate(("double", "int64", "logical", "single", "")):
        data = hostile.external(file, f"v{n}", marker, rows=8)
        if kind:
            data.attrs["MATLAB_class"] = np.bytes_(kind)
    hostile.external(file, "truth", marker, rows=1).attrs["MATLAB_class"] = np.bytes_("logical")


def text_elsewhere(file, marker):
    data = hostile.external(file, "name", marker, dtype="<u2", rows=64)
    data.attrs["MATLAB_class"] = np.bytes_("char")


def names_elsewhere(file, marker):
    """References to a cell of texts that lie elsewhere, as the column names of a table do."""
    inner = hostile.external(file.create_group("#refs#"), "a", marker, dtype="<u2", rows=32)
    inner.attrs["MATLAB_class"] = np.bytes_("char")
    names = file.create_dataset("names", data=np.array([[inner.ref]], dtype=h5py.ref_dtype))
    names.attrs["MATLAB_class"] = np.bytes_("cell")


def linked(file, marker):
    file["v"] = h5py.ExternalLink(str(marker.with_suffix(".h5")), "/q")
    file["w"] = h5py.SoftLink("/v")
    texts = file.create_dataset("c", data=["/v"], dtype=h5py.string_dtype())
    texts.attrs["MATLAB_class"] = np.bytes_("cell")


WAYS = (lengths_elsewhere, values_elsewhere, text_elsewhere, names_elsewhere, linked)


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
def test_a_file_that_names_another_gives_nothing_of_it(way, marker, reader):
    told = said(reader, hostile.workspace(lambda file: way(file, marker)))
    assert not hostile.leaked(told)


@pytest.mark.parametrize("way", WAYS[:4], ids=lambda way: way.__name__)
def test_its_own_reader_reads_no_bytes_that_lie_elsewhere(way, marker):
    """Outside the sandbox, too: bounds stand before every read."""
    data = hostile.workspace(lambda file: way(file, marker))
    with pytest.raises(Damaged):
        file_formats.read(memoryview(data), "traj.mat", marker_free_sink(), 1 << 20)


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
def test_the_kernel_refuses_what_a_reader_would_open(way, marker, monkeypatch):
    """With the checks of the file taken out: the sandbox alone keeps it in."""
    monkeypatch.setattr(mat73, "values_of", lambda item, path, limit: item[()])
    monkeypatch.setattr(worker, "warm_up", lambda: None)
    data = hostile.workspace(lambda file: way(file, marker))
    with restrictions.nothing_opens(), pytest.raises((Damaged, TooLarge)):
        file_formats.read(memoryview(data), "traj.mat", marker_free_sink(), 1 << 20)


def test_an_object_whose_parts_lie_elsewhere_stays_closed(marker, reader):
    pytest.importorskip("matio", reason="mat-io needs Python 3.11")
    import matlab_objects as matlab

    buffer = io.BytesIO(matlab.saved("v7.3", T=matlab.timeseries(np.eye(6), np.arange(6.0))))
    with h5py.File(buffer, "r+") as file:
        parts = [n for n in file["#refs#"] if isinstance(file["#refs#"][n], h5py.Dataset)]
        for name in parts:
            kept = dict(file["#refs#"][name].attrs)
            del file["#refs#"][name]
            made = hostile.external(file["#refs#"], name, marker, dtype="<u2", rows=64)
            made.attrs.update(kept)
    assert not hostile.leaked(said(reader, buffer.getvalue()))


@pytest.mark.slow
def test_files_made_at_random_give_nothing_of_another(marker, reader):
    for seed in range(AT_ONCE):
        found = hostile.leaked(said(reader, hostile.made_at_random(seed, marker)))
        assert not found, f"the file of seed {seed} gave {found}"


def marker_free_sink():
    class Sink:
        def add(self, found):
            assert not hostile.leaked(repr(found) + repr(bytes(found.data or b"")))

    return Sink()
