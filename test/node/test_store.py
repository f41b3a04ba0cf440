"""Stores: whole objects or none, in a folder and on a real S3 server, with killed writers."""

import errno
import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from memory_store import MemoryStore
from refusals import refused
from s3_server import BUCKET, s3_server

from mrlab_ros.adapters.diagnostics import NO_ROOM_ON_DISK
from mrlab_ros.adapters.store import objects
from mrlab_ros.adapters.store.diagnostics import (
    NO_STORE,
    NOT_IN_STORE,
    STORE_FAILED,
    STORE_FOLDER_UNUSABLE,
)
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.store.port import Missing, StoreFailure
from mrlab_ros.core.base.errors import BadInput

NAMES = ["users/=C3=A4/x.mat", "trajectories/records/=lab/wave.json", "a"]


@pytest.fixture(scope="module")
def server():
    with s3_server() as server:
        yield server


@pytest.fixture(params=["folder", "memory", "s3"])
def store(request, tmp_path):
    if request.param == "memory":
        return MemoryStore()
    if request.param == "folder":
        return open_store(str(tmp_path / "store"))
    request.getfixturevalue("server")
    return open_store(f"s3://{BUCKET}/{tmp_path.name}")


def test_objects_are_written_replaced_listed_copied_and_removed(store):
    for name in NAMES:
        store.put(name, b"one")
        store.put(name, name.encode())
        assert store.get(name) == name.encode()
        assert store.size(name) == len(name)
    assert {e.key for e in store.list("users")} == {NAMES[0]}
    (entry,) = store.list("trajectories/records")
    assert (entry.key, entry.size) == (NAMES[1], len(NAMES[1]))
    assert abs(entry.modified - time.time()) < 3600
    store.copy(NAMES[0], "users/=C3=A4/y")
    assert store.get("users/=C3=A4/y") == NAMES[0].encode()
    store.delete([NAMES[0], "never/there"])
    assert [e.key for e in store.list("users")] == ["users/=C3=A4/y"]
    assert store.list("nothing") == []


def test_another_content_has_another_tag(store):
    store.put("x/a", b"1")
    (before,) = store.list("x")
    store.put("x/a", b"2")
    (after,) = store.list("x")
    assert before.tag != after.tag


@pytest.mark.parametrize("use", ["get", "size", "copy", "get_file"])
def test_what_is_missing_is_named(store, use):
    more = {"copy": ("other",), "get_file": (io.BytesIO(),)}.get(use, ())
    with refused(NOT_IN_STORE, Missing, key="no/thing"):
        getattr(store, use)("no/thing", *more)


@pytest.mark.parametrize("size", [0, 1, 300_000, 40 << 20])
def test_a_file_comes_back_byte_for_byte(store, size, monkeypatch):
    monkeypatch.setattr(objects, "SINGLE_REQUEST", 16 << 20)
    data = os.urandom(min(size, 1 << 20)) * max(size >> 20, 1) if size else b""
    file = io.BytesIO(data)
    file.seek(0, os.SEEK_END)
    store.put_file("big", file)
    read = io.BytesIO()
    assert store.get_file("big", read) == len(data)
    assert read.getvalue() == data


def test_only_a_folder_names_files(store, tmp_path):
    store.put("a/b", b"1")
    path = store.path("a/b")
    assert path is None or path.read_bytes() == b"1"
    assert (path is not None) == store.place.startswith(str(tmp_path))


WRITER = """
import os, sys, time
from mrlab_ros.adapters.store.objects import open_store
class Slow:
    left = 4
    def seek(self, *_): return 0
    def tell(self): return 100 << 20
    def read(self, size=-1):
        self.left -= 1
        if not self.left:
            print("half", flush=True)
            time.sleep(100)
        return bytes(size)
open_store(sys.argv[1]).put_file("users/anna/big", Slow())
"""


@pytest.mark.parametrize("kind", ["folder", "s3"])
def test_a_writer_that_is_killed_leaves_nothing(kind, tmp_path, request):
    place = str(tmp_path / "store")
    if kind == "s3":
        request.getfixturevalue("server")
        place = f"s3://{BUCKET}/{tmp_path.name}"
    store = open_store(place)
    store.put("users/anna/big", b"before")
    with subprocess.Popen([sys.executable, "-c", WRITER, place], stdout=subprocess.PIPE) as child:
        assert child.stdout.readline() == b"half\n"
        child.send_signal(signal.SIGKILL)
    assert [e.key for e in store.list("users")] == ["users/anna/big"]
    assert store.get("users/anna/big") == b"before"
    store.clear_interrupted(0.0)
    files = [p.name for p in Path(place).rglob("*") if p.is_file()] if kind == "folder" else []
    assert files in ([], ["big"])
    store.put("users/anna/big", b"after")
    assert store.get("users/anna/big") == b"after"


FULL = """
import io, resource, signal, sys
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.store.port import StoreFailure
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
store = open_store(sys.argv[1])
store.put("a/old", b"old")
resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20))
for write in (lambda: store.put("a/new", bytes(2 << 20)),
              lambda: store.put("a/old", bytes(2 << 20)),
              lambda: store.put_file("a/file", io.BytesIO(bytes(40 << 20)))):
    try:
        write()
    except StoreFailure as error:
        print(error)
"""


def test_a_disk_that_is_full_leaves_what_was_there(tmp_path):
    place = str(tmp_path / "store")
    done = subprocess.run([sys.executable, "-c", FULL, place], capture_output=True, text=True)
    assert len(done.stdout.splitlines()) == 3, done.stderr
    assert all("nothing was changed" in line for line in done.stdout.splitlines())
    store = open_store(place)
    assert [e.key for e in store.list("a")] == ["a/old"]
    assert store.get("a/old") == b"old"
    assert [p.name for p in (tmp_path / "store" / "a").iterdir()] == ["old"]


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT])
def test_a_disk_without_room_is_named(tmp_path, monkeypatch, number):
    def put(*_, **__):
        why = f"Unable to copy data to file: {os.strerror(number)} (os error {number})"
        raise objects.BaseError(f"Generic LocalFileSystem error: {why}")

    monkeypatch.setattr(objects.obstore, "put", put)
    with refused(NO_ROOM_ON_DISK, StoreFailure):
        open_store(str(tmp_path)).put("a", b"a")


def test_a_server_that_dies_is_a_sentence_and_comes_back(tmp_path):
    with s3_server() as server:
        store = open_store(f"s3://{BUCKET}/{tmp_path.name}")
        store.put("a", b"1")
        server.kill()
        for use in (lambda: store.put("b", b"2"), lambda: store.get("a"), lambda: store.list("x")):
            with refused(STORE_FAILED, StoreFailure):
                use()
        server.start()
        store.put("a", b"3")
        assert store.get("a") == b"3"


def test_a_bucket_that_is_not_there_is_named(server):
    store = open_store("s3://elsewhere/x")
    for use in (lambda: store.put("a", b""), lambda: store.get("a"), lambda: store.list("a")):
        with pytest.raises(StoreFailure, match="NoSuchBucket"):
            use()


@pytest.mark.parametrize("place", ["ftp://x/y", "s3://", "https://example.org/x"])
def test_an_url_of_another_kind_is_refused(place):
    with refused(NO_STORE, BadInput, store=place):
        open_store(place)


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with refused(STORE_FOLDER_UNUSABLE, BadInput):
        open_store(str(tmp_path / "file" / "store"))


def test_a_store_in_memory_fails_when_told():
    store = MemoryStore()
    store.writes_left = 1
    store.put("a", b"1")
    with refused(STORE_FAILED, StoreFailure, why="No space left on device"):
        store.put("b", b"2")
    assert store.get("a") == b"1"
    store.broken = "it is away"
    with refused(STORE_FAILED, StoreFailure, why="it is away"):
        store.get("a")
