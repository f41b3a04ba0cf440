"""In the sandbox a process reaches what it was given, and nothing else."""

import ctypes
import json
import os
import resource
import socket
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

from mrlab_ros.adapters.sandbox import restrictions

pytestmark = pytest.mark.fast
needs_kernel = pytest.mark.skipif(
    not all(restrictions.layers().values()), reason="this kernel has no Landlock or no seccomp"
)


@pytest.fixture
def given(tmp_path):
    """Folders to read and to write, and a key that is in neither."""
    for name in ("read", "write", "keys"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").write_text(f"in {name}")
    return tmp_path


@pytest.fixture
def listener():
    with socket.create_server(("127.0.0.1", 0)) as made:
        yield made


def outcomes(deeds, **shut):
    """Do each deed in the sandbox, in a process of its own; return 'did' or the kind of error."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        told = {}
        try:
            restrictions.shut(**shut)
            for name, deed in deeds.items():
                try:
                    deed()
                    told[name] = "did"
                except BaseException as error:
                    told[name] = type(error).__name__
            os.write(write, json.dumps(told).encode())
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as file:
        told = file.read()
    os.waitpid(child, 0)
    return json.loads(told)


def refused(told):
    return {name for name, end in told.items() if end in ("PermissionError", "OSError")}


def deeds_of(given, port):
    """What no file may make its reader do."""
    inside = given / "read" / "file"
    here = os.getpid()
    return {
        "read a key": (given / "keys" / "file").read_text,
        "follow a link": lambda: Path(given / "read" / "link").read_text(),
        "write": lambda: inside.write_text("x"),
        "remove": inside.unlink,
        "change a mode": lambda: inside.chmod(0o777),
        "set a time": lambda: os.utime(inside),
        "read the environment": lambda: Path("/proc/self/environ").read_bytes(),
        "connect": lambda: socket.create_connection(("127.0.0.1", port), 1),
        "listen": lambda: socket.create_server(("127.0.0.1", 0)),
        "start a program": lambda: subprocess.run(["/bin/true"], check=True),
        "become a program": lambda: os.execv("/bin/true", ["true"]),
        "signal": lambda: os.kill(here, 0),
        "limit another": lambda: resource.prlimit(here, resource.RLIMIT_AS, (1, 1)),
        "trace": lambda: checked(ctypes.CDLL(None, use_errno=True).ptrace(16, here, 0, 0)),
        "leave the namespaces": lambda: checked(
            ctypes.CDLL(None, use_errno=True).unshare(0x10000000)
        ),
    }


def checked(found):
    if found < 0:
        raise OSError(ctypes.get_errno(), "refused")


@needs_kernel
def test_a_closed_wall_lets_nothing_open_and_lets_arithmetic_go_on(given, listener):
    deeds = deeds_of(given, listener.getsockname()[1])
    deeds["open what it may read elsewhere"] = (given / "read" / "file").read_text
    told = outcomes(deeds)
    assert refused(told) == set(deeds), told
    work = {
        "compute": lambda: np.linalg.svd(np.eye(20)),
        "fork": lambda: os.waitpid(os.fork() or os._exit(0), 0),
        "keep bytes": lambda: os.write(os.memfd_create("made"), b"x"),
    }
    assert set(outcomes(work).values()) == {"did"}


@needs_kernel
def test_a_wall_with_folders_lets_only_these_open(given, listener):
    (given / "read" / "link").symlink_to(given / "keys" / "file")
    deeds = deeds_of(given, listener.getsockname()[1])
    walls = {"read": [*restrictions.libraries(), given / "read"], "write": [given / "write"]}
    told = outcomes(deeds, opens=True, **walls)
    assert refused(told) == set(deeds), told
    work = {
        "read": (given / "read" / "file").read_text,
        "write": lambda: (given / "write" / "made").write_text("x"),
        "replace": lambda: os.replace(given / "write" / "made", given / "write" / "file"),
        "import": lambda: __import__("tabnanny"),
        "run a thread": lambda: threading.Thread(target=int).start(),
    }
    told = outcomes(work, opens=True, **walls)
    assert set(told.values()) == {"did"}, told


@needs_kernel
@pytest.mark.parametrize("version", [1, 2, 3])
def test_on_an_older_kernel_no_file_elsewhere_is_emptied(given, monkeypatch, version):
    monkeypatch.setattr(restrictions, "landlock_version", lambda: version)
    kept = given / "keys" / "file"
    told = outcomes(
        {"truncate": lambda: os.truncate(kept, 0), "open": lambda: kept.open("w")},
        read=restrictions.libraries(),
        write=[given / "write"],
        opens=True,
    )
    assert refused(told) == {"truncate", "open"}, told
    assert kept.read_text() == "in keys"


def test_files_are_named_only_where_something_may_open(given):
    with pytest.raises(ValueError, match="nobody may open"):
        restrictions.shut(read=[given])


def test_nothing_opens_without_a_descriptor_and_afterwards_it_does(given):
    with restrictions.nothing_opens(), pytest.raises(OSError, match="Too many open files"):
        (given / "read" / "file").read_text()
    assert (given / "read" / "file").read_text() == "in read"


def test_of_a_folder_on_the_path_of_imports_its_modules_alone_are_read(tmp_path, monkeypatch):
    for name in ("package", "keys", "a-1.dist-info"):
        (tmp_path / name).mkdir()
    for name in ("package/__init__.py", "module.py", "solution.mat", "keys/ca.key"):
        (tmp_path / name).touch()
    monkeypatch.syspath_prepend(tmp_path)
    here = tmp_path.resolve()
    found = {path for path in restrictions.libraries() if path.is_relative_to(here)}
    assert found == {here / name for name in ("package", "module.py", "a-1.dist-info")}
