"""The file in which a supervisor says what it keeps."""

from __future__ import annotations

import fcntl
import json
import os
import tempfile
import time
from dataclasses import asdict
from pathlib import Path
from typing import IO, Any

from mrlab_ros.core.errors import Misuse
from mrlab_ros.processes.supervisor import ProcessState

# Who only looks whether a lab runs holds its lock for an instant, s.
CLAIM_PATIENCE = 0.2


def _folder() -> Path:
    base = os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir()
    return Path(base) / f"mrlab-{os.getuid()}"


class RunFile:
    """Where a supervisor says what it keeps: one file a user and ROS domain.

    A lock beside the file proves that its writer lives; the kernel lets it go with the process.
    """

    def __init__(self, domain: int) -> None:
        self._domain = domain
        self._path = _folder() / f"domain-{domain}.json"
        self._lock: IO[bytes] | None = None
        self._facts: dict[str, object] = {}

    def claim(self, **facts: object) -> None:
        """Take the domain for this process; raise Misuse where another supervisor has it."""
        self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        lock = open(self._path.with_suffix(".lock"), "ab")  # noqa: SIM115
        deadline = time.monotonic() + CLAIM_PATIENCE
        while not _locked(lock, fcntl.LOCK_EX):
            if time.monotonic() > deadline:
                lock.close()
                owner = self.read() or {}
                raise Misuse(
                    f"a lab runs on ROS domain {self._domain} already (process "
                    f"{owner.get('pid', 'unknown')}); use that one, stop it, or set "
                    "ROS_DOMAIN_ID to another number"
                )
            time.sleep(CLAIM_PATIENCE / 10)
        self._lock = lock
        self._facts = {"domain": self._domain, "pid": os.getpid(), **facts}
        self.write([])

    def write(self, states: list[ProcessState]) -> None:
        """Say the present state of all processes; a reader sees all of it or the last one."""
        if self._lock is None:
            return
        new = self._path.with_suffix(".new")
        new.write_text(json.dumps({**self._facts, "processes": [asdict(s) for s in states]}))
        new.replace(self._path)

    def release(self) -> None:
        """Give the domain back."""
        if self._lock is not None:
            self._path.unlink(missing_ok=True)
            self._lock.close()
            self._lock = None

    def read(self) -> dict[str, Any] | None:
        """Return what the living supervisor of the domain says; None where there is none."""
        try:
            with open(self._path.with_suffix(".lock"), "rb") as lock:
                if _locked(lock, fcntl.LOCK_SH):
                    return None
            found: dict[str, Any] = json.loads(self._path.read_text())
        except FileNotFoundError:
            return None
        return found


def _locked(file: IO[bytes], kind: int) -> bool:
    try:
        fcntl.flock(file, kind | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
