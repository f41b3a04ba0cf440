"""The sandbox: whatever a file does, the reader says so and reads the next one."""

import gc
import gzip
import io
import os
import signal
import struct
import zipfile
import zlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import psutil
import pytest
import scipy.io
from graph import wait_for
from refusals import said_in

from mrlab_ros.adapters.workspaces import content
from mrlab_ros.adapters.workspaces.reader import Limits, MiB, WorkspaceReader
from mrlab_ros.core.base.errors import BadInput

pytestmark = pytest.mark.slow

Q = np.arange(60.0).reshape(10, 6)


@pytest.fixture(scope="module")
def reader():
    with WorkspaceReader(Limits(memory=64 * MiB, time=20.0, output=8 * MiB)) as reader:
        yield reader


def saved(**variables):
    buffer = io.BytesIO()
    scipy.io.savemat(buffer, variables, do_compression=True)
    return buffer.getvalue()


def refusal(call, *arguments):
    with pytest.raises(BadInput) as caught:
        call(*arguments)
    assert str(caught.value)
    return caught.value.diagnostic


def test_a_file_is_read_with_its_digest(reader, tmp_path):
    path = tmp_path / "traj.mat"
    path.write_bytes(saved(q=Q, fs=50.0))
    workspace = reader.read_file(path)
    np.testing.assert_array_equal(workspace.find("q").values, Q)
    assert workspace.scalar(workspace.find("fs")) == 50.0
    assert workspace.find("no") is None
    (digest, _) = os.popen(f"sha256sum '{path}'").read().split()
    assert workspace.sha256 == digest


def test_what_was_read_stays_when_the_reader_goes():
    with WorkspaceReader() as reader:
        workspace = reader.read_bytes(saved(q=Q), "traj.mat")
    np.testing.assert_array_equal(workspace.find("q").values, Q)


def test_several_threads_may_read(reader):
    def one(i):
        return reader.read_bytes(saved(q=Q + i), "traj.mat").find("q").values[0, 0]

    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(one, range(12))) == list(range(12))


def test_what_is_no_file_is_refused(reader, tmp_path):
    assert refusal(reader.read_file, tmp_path / "no.mat").code == "missing"
    assert refusal(reader.read_file, tmp_path).code == "unsupported_format"
    os.mkfifo(tmp_path / "pipe.mat")
    assert refusal(reader.read_file, tmp_path / "pipe.mat").code == "unsupported_format"
    assert refusal(reader.read_bytes, b"", "traj.mat").values["form"] == "empty"
    assert refusal(reader.read_bytes, saved(q=Q)[:-9], "traj.mat").code == "unreadable"


def test_the_size_of_a_file_is_bounded():
    with WorkspaceReader(Limits(file_size=100)) as reader:
        assert refusal(reader.read_bytes, bytes(101), "traj.mat").code == "too_large"


def bomb(mebibytes):
    """Return a v7 file whose one variable declares and inflates to so many MiB of zeros."""
    tag, zeros = struct.pack("<II", 14, mebibytes * MiB), bytes(MiB)
    deflate = zlib.compressobj(1)
    begin = deflate.compress(tag) + deflate.flush(zlib.Z_FULL_FLUSH)
    # after a full flush equal contents have equal bytes, so one MiB is compressed for all
    block = deflate.compress(zeros) + deflate.flush(zlib.Z_FULL_FLUSH)
    checksum = zlib.adler32(tag)
    for _ in range(mebibytes):
        checksum = zlib.adler32(zeros, checksum)
    end = b"\x03\x00" + struct.pack(">I", checksum)
    body = begin + block * mebibytes + end
    head = b"MATLAB 5.0".ljust(116) + bytes(8) + b"\x00\x01IM"
    return head + struct.pack("<II", 15, len(body)) + body


def test_a_bomb_is_stopped(reader):
    assert refusal(reader.read_bytes, bomb(600), "b.mat").code == "too_large"
    # matrices that are within the memory but more than the output
    many = saved(**{f"q{i}": np.zeros((60_000, 6)) for i in range(5)})
    assert refusal(reader.read_bytes, many, "b.mat").code == "too_large"
    assert reader.read_bytes(saved(q=Q), "traj.mat").find("q") is not None


def test_memory_is_kept_by_the_kernel():
    with WorkspaceReader(Limits(memory=24 * MiB)) as reader:
        data = bomb(9)  # allowed by what it declares, twice that while inflating
        rows = np.zeros((1 * MiB, 6))
        assert refusal(reader.read_bytes, saved(q=rows), "b.mat").code == "too_large"
        assert refusal(reader.read_bytes, data, "b.mat").code == "unreadable"
        assert reader.read_bytes(saved(q=Q), "traj.mat").find("q") is not None


def test_time_is_kept_by_the_kernel():
    # The inflating alone takes longer than the limit.
    with WorkspaceReader(Limits(time=0.1)) as reader:
        many = bomb(300)
        slow = refusal(reader.read_bytes, many, "slow.mat")
        assert (slow.code, slow.values["clock"]) == ("too_slow", "processor")
        assert reader.read_bytes(saved(q=Q), "traj.mat").find("q") is not None


@pytest.mark.parametrize(
    ("status", "limit"), [(-signal.SIGPROF, 20.0), (-signal.SIGALRM, 100.0), (None, 100.0)]
)
def test_a_file_that_passes_a_limit_is_told_which(status, limit):
    found = content.too_slow(status, "a.mat", 20.0, 100.0)
    assert (found.code, found.values["limit"]) == ("too_slow", limit)


@pytest.mark.parametrize("number", [signal.SIGSEGV, signal.SIGABRT])
def test_a_file_that_kills_the_reading_process_is_reported(number):
    with WorkspaceReader() as reader, ThreadPoolExecutor(1) as pool:
        reader._worker.warm()
        worker = psutil.Process(reader._worker.pid)
        slow = bomb(400)
        pending = pool.submit(refusal, reader.read_bytes, slow, "evil.mat")
        (reading,) = wait_for(worker.children, "the reading process")
        reading.send_signal(number)
        found = pending.result(60)
        assert found.code == "reader_died"
        assert found.values["signal"] == number
        assert worker.is_running(), "the waiting process is not touched"
        assert reader.read_bytes(saved(q=Q), "traj.mat").find("q") is not None


@pytest.mark.parametrize("kills", [1, 2])
def test_a_file_whose_process_is_killed_is_read_once_more(kills):
    with WorkspaceReader() as reader, ThreadPoolExecutor(1) as pool:
        reader._worker.warm()
        worker = psutil.Process(reader._worker.pid)
        pending = pool.submit(refusal, reader.read_bytes, bomb(400), "evil.mat")
        seen = set()
        for _ in range(kills):
            (reading,) = wait_for(lambda: set(worker.children()) - seen, "the reading process")
            seen.add(reading)
            reading.kill()
        found = pending.result(60)
        # read at last, the bomb is too large
        assert found.code == ("reader_died" if kills == 2 else "unreadable")


def test_a_lost_worker_is_replaced():
    with WorkspaceReader() as reader:
        reader._worker.warm()
        worker = psutil.Process(reader._worker.pid)
        worker.kill()
        wait_for(lambda: worker.status() == psutil.STATUS_ZOMBIE, "its end")
        assert reader.read_bytes(saved(q=Q), "traj.mat").find("q") is not None


def test_closing_gives_up_a_file_that_is_being_read():
    reader = WorkspaceReader()
    reader._worker.warm()
    with ThreadPoolExecutor(1) as pool:
        worker = psutil.Process(reader._worker.pid)
        slow = bomb(400)
        pending = pool.submit(refusal, reader.read_bytes, slow, "slow.mat")
        (reading,) = wait_for(worker.children, "the reading process")
        reader.close()
        assert pending.result(60).code == "reader_died"
        wait_for(lambda: not reading.is_running(), "its end")


def test_closing_ends_the_worker():
    reader = WorkspaceReader()
    reader._worker.warm()
    worker = psutil.Process(reader._worker.pid)
    reader.close()
    assert not worker.is_running()
    reader.close()


@pytest.mark.parametrize("name", ["traj.mat", "traj.mat.gz"])
def test_a_matrix_is_read_again_by_a_second_reader(reader, name, monkeypatch):
    data = saved(s={"q": Q}, q=Q + 1)
    workspace = reader.read_bytes(gzip.compress(data) if name.endswith("gz") else data, name)
    workspace.confirm(["s.q", "q"])
    workspace.confirm(["no such variable"])
    place = workspace.confirm._places["q"]
    monkeypatch.setitem(workspace.confirm._places, "q", ["s.q", *place[1:]])
    found = refusal(workspace.confirm, ["q"])
    assert found.code == "readers_disagree"
    assert said_in(found)["second_finds"]["second"] == "0.0"


def test_thousands_of_pieces_are_read_again_in_a_few_requests(reader, monkeypatch):
    pieces = np.empty((1, 1500), object)
    for i in range(1500):
        pieces[0, i] = np.full((1, 6), i, dtype=float)
    workspace = reader.read_bytes(saved(c=pieces), "traj.mat")
    asked = []
    ask = reader._ask
    monkeypatch.setattr(reader, "_ask", lambda *a, **m: asked.append(a) or ask(*a, **m))
    paths = [f"c{{{i}}}" for i in range(1, 1501)]
    workspace.confirm(paths)
    assert 1 < len(asked) < 10
    place = workspace.confirm._places["c{1400}"]
    monkeypatch.setitem(workspace.confirm._places, "c{1400}", ["c{1399}", *place[1:]])
    found = refusal(workspace.confirm, paths)
    assert found.code == "readers_disagree"
    assert found.variable == "c{1399}"


def test_a_crash_of_the_second_reader_refuses_the_file(reader, monkeypatch):
    workspace = reader.read_bytes(saved(q=Q), "traj.mat")
    monkeypatch.setattr(reader, "_ask", lambda *_, **__: -signal.SIGSEGV)
    found = refusal(workspace.confirm, ["q"])
    assert found.code == "readers_disagree"
    assert said_in(found)["second_reader_crashed"]["signal"] == signal.SIGSEGV
    monkeypatch.setattr(reader, "_ask", lambda *_, **__: None)
    assert refusal(workspace.confirm, ["q"]).code == "too_slow"


def test_what_a_workspace_needs_to_be_read_again_goes_with_it(reader):
    gc.collect()
    before = psutil.Process().num_fds()
    workspaces = [reader.read_bytes(saved(q=Q), "traj.mat") for _ in range(10)]
    assert psutil.Process().num_fds() > before
    del workspaces
    gc.collect()
    assert psutil.Process().num_fds() == before


def test_a_file_that_is_cut_after_it_was_read_is_refused(reader, tmp_path):
    path = tmp_path / "traj.mat"
    path.write_bytes(saved(q=np.random.default_rng(0).normal(size=(20_000, 6))))
    workspace = reader.read_file(path)
    os.truncate(path, 200)
    assert refusal(workspace.confirm, ["q"]).code == "readers_disagree"
    assert refusal(reader.read_file, path).code == "unreadable"


ROWS = "0,0.1,0.2\n0.01,0.3,0.4\n"


@pytest.mark.parametrize(
    "data",
    [
        ("t;q1;q2\n" + ROWS.replace(",", ";").replace(".", ",")).encode("utf-16"),
        ("sep=;\nt;q1;q2\n" + ROWS.replace(",", ";")).encode(),
        b"# made by a logger\n% twice\nt,q1,q2\n" + ROWS.encode(),
        b"t,q1,q2,\n" + ROWS.replace("\n", ",\n").encode(),
    ],
)
def test_tables_as_other_programs_write_them_are_read(reader, data):
    workspace = reader.read_bytes(data, "traj.csv")
    q = workspace.find("q")
    assert q.columns == ("q1", "q2")
    np.testing.assert_array_equal(q.values, [[0.1, 0.2], [0.3, 0.4]])
    np.testing.assert_array_equal(workspace.find("t").values, [[0.0], [0.01]])


def test_numbers_that_save_ascii_wrote_are_a_table_whatever_its_name(reader):
    rows = "  1.0000000e-01   2.0000000e-01\n  3.0000000e-01   4.0000000e-01\n"
    values = reader.read_bytes(rows.encode(), "q.mat").find("q").values
    np.testing.assert_array_equal(values, [[0.1, 0.2], [0.3, 0.4]])
    assert refusal(reader.read_bytes, b"q = [1 2 3];\n", "q.mat").code == "unsupported_format"


def archive(entries):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in entries.items():
            file.writestr(name, content, None if name != "mimetype" else zipfile.ZIP_STORED)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("entries", "form"),
    [
        ({"[Content_Types].xml": "", "xl/workbook.xml": ""}, "spreadsheet"),
        (
            {"xl/worksheets/sheet1.xml": os.urandom(100_000).hex(), "xl/workbook.bin": ""},
            "spreadsheet",
        ),
        (
            {"mimetype": "application/vnd.oasis.opendocument.spreadsheet", "content.xml": ""},
            "spreadsheet",
        ),
        ({"word/document.xml": ""}, "zip"),
    ],
)
def test_a_spreadsheet_is_refused_with_what_to_do(reader, entries, form):
    finding = refusal(reader.read_bytes, archive(entries), "q.xlsx")
    assert finding.code == "unsupported_format"
    assert finding.values["form"] == form


def test_a_table_of_windows_1252_and_one_with_a_row_of_units_are_read(reader):
    workspace = reader.read_bytes("A1 [°],für A2\n1,2\n3,4\n".encode("cp1252"), "traj.csv")
    assert workspace.find("q").columns == ("A1 [°]", "für A2")
    workspace = reader.read_bytes(b"t,q1\ns,deg\n0,1\n1,2\n", "traj.csv")
    assert workspace.find("q").columns == ("q1 [deg]",)
    assert workspace.find("t") is not None
    found = refusal(reader.read_bytes, b"t,q1\ns,bar\n0,1\n1,2\n", "traj.csv")
    assert found.code == "bad_table"
    assert said_in(found)["units_unknown"] == {"found": "bar"}
