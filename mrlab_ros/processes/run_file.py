"""The file in which a supervisor publishes the state of its processes."""

from __future__ import annotations

import fcntl
import json
import os
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import IO, Any

from mrlab_ros.adapters import private_folder
from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import Misuse, Unavailable
from mrlab_ros.core.runtime.process_states import ProcessState
from mrlab_ros.processes.diagnostics import DOMAIN_TAKEN, LABS_ELSEWHERE, NO_PRIVATE_FOLDER
from mrlab_ros.ros.diagnostics import NO_LAB_ANSWERS

# `mrlab status` holds the lock for a moment; a claim retries for this long, s.
CLAIM_TIMEOUT_S = 0.2
# Bytes of a Unix socket's address on Linux.
SOCKET_PATH = 108


def folder() -> tuple[Path, str]:
    """Return the folder of this user's run files, and why it is not the usual one, or empty.

    Others may make folders beside the usual one: where theirs has its name, every command of this
    user takes the next that nobody else could make or write into.
    """
    name = f"mrlab-{os.getuid()}"
    state = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    bases = (os.environ.get("XDG_RUNTIME_DIR"), tempfile.gettempdir(), state)
    reasons: list[Diagnostic | str] = []
    for path in (Path(base) / name for base in bases if base):
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            reasons.append(f"{path.parent}: {error.strerror}")
            continue
        why = private_folder.why_not(path)
        if why is None:
            return path, "; ".join(map(str, reasons))
        reasons.append(why)
    raise Unavailable(NO_PRIVATE_FOLDER(reasons=reasons))


class RunFile:
    """The state of a supervisor's processes: one file for each user and ROS domain.

    A lock beside the file proves that its writer lives; the kernel releases it with the process.
    not_usual: why the file is not in the usual folder; empty where it is.
    """

    def __init__(self, domain: int) -> None:
        self._domain = domain
        self.folder, self.not_usual = folder()
        self._path = self.folder / f"domain-{domain}.json"
        self._lock: IO[bytes] | None = None
        self._facts: dict[str, object] = {}

    @property
    def socket(self) -> str:
        """Return the bridge's address for this user's commands; empty: the path is too long."""
        path = str(self._path.with_suffix(".sock"))
        return path if len(os.fsencode(path)) < SOCKET_PATH else ""

    def claim(self, **facts: object) -> None:
        """Take the domain for this process; raise Misuse where another supervisor has it."""
        private_folder.make(self.folder)
        lock = self._opened(".lock", os.O_RDWR | os.O_CREAT)
        deadline = time.monotonic() + CLAIM_TIMEOUT_S
        while not _locked(lock, fcntl.LOCK_EX):
            if time.monotonic() > deadline:
                lock.close()
                owner = self.read() or {}
                raise Misuse(DOMAIN_TAKEN(domain=self._domain, pid=owner.get("pid")))
            time.sleep(CLAIM_TIMEOUT_S / 10)
        self._lock = lock
        self._facts = {"domain": self._domain, "pid": os.getpid(), **facts}
        self.write([])

    def write(self, states: list[ProcessState]) -> None:
        """Write the state of all processes; a reader sees the whole new file or the old one."""
        if self._lock is None:
            return
        with replaced(self._path, 0o600) as file:
            facts = {**self._facts, "processes": [asdict(s) for s in states]}
            file.write(json.dumps(facts).encode())

    def release(self) -> None:
        """Release the domain."""
        if self._lock is not None:
            for suffix in (".json", ".sock", ".sock.lock"):
                self._path.with_suffix(suffix).unlink(missing_ok=True)
            self._lock.close()
            self._lock = None

    def read(self) -> dict[str, Any] | None:
        """Return the file of the running supervisor of the domain; None where there is none."""
        try:
            with self._opened(".lock", os.O_RDONLY) as lock:
                if _locked(lock, fcntl.LOCK_SH):
                    return None
            with self._opened(".json", os.O_RDONLY) as file:
                found: dict[str, Any] = json.load(file)
        except FileNotFoundError:
            return None
        return found

    def _opened(self, suffix: str, flags: int) -> IO[bytes]:
        """Open a file of the folder that is no link."""
        path = self._path.with_suffix(suffix)
        return os.fdopen(os.open(path, flags | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600), "rb")


def domains() -> list[int]:
    """Return the ROS domains on which a supervisor of this user runs now."""
    found = (path.stem.removeprefix("domain-") for path in folder()[0].glob("domain-*.json"))
    return sorted(
        domain for domain in map(int, filter(str.isdecimal, found)) if RunFile(domain).read()
    )


def nobody(domain: int, labs: Sequence[int]) -> Diagnostic:
    """Return what to say of an empty domain; labs: the domains on which this user runs labs."""
    if labs:
        return LABS_ELSEWHERE(domain=domain, labs=list(labs))
    return NO_LAB_ANSWERS(domain=domain, fixes=(Fix(command="mrlab up"),))


def _locked(file: IO[bytes], kind: int) -> bool:
    try:
        fcntl.flock(file, kind | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
