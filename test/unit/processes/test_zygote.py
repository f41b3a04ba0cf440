"""Processes that a zygote forks, kept by a supervisor."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import psutil
import pytest
from graph import wait_for

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.processes.child_process import RESTARTS, ProcessSpec, RestartPolicy
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.processes.zygote import Zygote

pytestmark = pytest.mark.slow
DEADLINE_S = 60.0
MODULE = f"""
    import json, os, signal, sys, threading, time
    import beforehand
    facts = {{
        "name": __name__,
        "pid": os.getpid(),
        "parent": os.getppid(),
        "session": os.getsid(0),
        "words": sys.argv[1:],
        "imported": beforehand.BY,
        "who": os.environ["WHO"],
        "restarts": os.environ["{RESTARTS}"],
        "blocked": signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ()),
        "threads": threading.active_count(),
        "descriptors": sorted(int(name) for name in os.listdir("/proc/self/fd")),
    }}
    sys.stdout.reconfigure(errors="replace")
    print(json.dumps(facts))
    time.sleep(600)
"""


def spec(name: str, *words: str) -> ProcessSpec:
    argv = python_process.command("forked_one", *words)
    return ProcessSpec(name, argv, {"WHO": "me"}, True, (), "forked_one", ("beforehand",))


def alive(pid: int) -> bool:
    try:
        return bool(psutil.Process(pid).status() != psutil.STATUS_ZOMBIE)
    except psutil.NoSuchProcess:
        return False


class Kept:
    """A supervisor with a zygote, and what its processes say of themselves."""

    def __init__(self) -> None:
        self.said: list[tuple[str, str]] = []
        self.zygote = Zygote()
        self.supervisor = Supervisor(
            [spec("a", "x y", "z"), spec("b")],
            lambda name, line: self.said.append((name, line)),
            policy=lambda: RestartPolicy(0.05, 0.1),
            zygote=self.zygote,
        )

    def facts(self, name: str, life: int = 0) -> dict[str, Any]:
        def found() -> dict[str, Any] | None:
            lines = [line for who, line in self.said if who == name and line.startswith("{")]
            return json.loads(lines[life]) if len(lines) > life else None

        return wait_for(found, f"life {life} of {name}: {self.said}", DEADLINE_S)


@pytest.fixture
def modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: Any) -> None:
    beforehand = getattr(request, "param", "import os\nBY = os.getpid()\n")
    (tmp_path / "forked_one.py").write_text(textwrap.dedent(MODULE))
    (tmp_path / "beforehand.py").write_text(beforehand)
    paths = [str(tmp_path), os.environ.get("PYTHONPATH", "")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))


@pytest.fixture
def kept(modules: None) -> Iterator[Kept]:
    lab = Kept()
    with lab.zygote, lab.supervisor:
        yield lab


def test_a_forked_process_is_as_if_the_supervisor_had_started_it(kept: Kept) -> None:
    a, b = kept.facts("a"), kept.facts("b")
    assert [state.pid for state in kept.supervisor.states] == [a["pid"], b["pid"]]
    assert a["imported"] == b["imported"] == kept.zygote._process.pid
    for facts in (a, b):
        assert facts["name"] == "__main__"
        assert facts["parent"] == os.getpid()
        assert facts["session"] == facts["pid"]
        assert (facts["who"], facts["restarts"]) == ("me", "0")
        assert facts["blocked"]
        assert facts["threads"] == 1
        # and that of the folder that it lists
        assert facts["descriptors"][:3] == [0, 1, 2]
        assert len(facts["descriptors"]) == 4
    assert a["words"] == ["x y", "z"]
    assert "forked_one" in psutil.Process(a["pid"]).cmdline()


def test_it_is_forked_again_when_it_ends(kept: Kept) -> None:
    first, other = kept.facts("a"), kept.facts("b")
    os.kill(first["pid"], signal.SIGKILL)
    again = kept.facts("a", 1)
    assert again["restarts"] == "1"
    assert again["imported"] == first["imported"]
    state, beside = kept.supervisor.states
    assert (state.last_exit, state.restarts) == ("SIGKILL", 1)
    assert (beside.pid, beside.restarts) == (other["pid"], 0)


def test_without_its_zygote_a_process_lives_on_and_another_forks_it_again(kept: Kept) -> None:
    first = kept.facts("a")
    kept.facts("b")
    os.kill(first["imported"], signal.SIGKILL)
    wait_for(lambda: not alive(first["imported"]), "the end of the zygote", DEADLINE_S)
    assert alive(first["pid"])
    os.kill(first["pid"], signal.SIGKILL)
    again = kept.facts("a", 1)
    assert again["imported"] not in (first["imported"], again["pid"])
    assert again["parent"] == os.getpid()


@pytest.mark.parametrize("modules", ["raise SystemExit"], indirect=True)
def test_where_imports_fail_it_is_started_and_says_so_itself(kept: Kept) -> None:
    wait_for(lambda: any(state.restarts for state in kept.supervisor.states), "an end", DEADLINE_S)
    assert kept.zygote.fork("forked_one", (), (), {}) is None


def test_all_end_with_a_killed_supervisor(modules: None) -> None:
    code = f"""
        import time
        from test_zygote import Kept
        kept = Kept()
        with kept.zygote, kept.supervisor:
            pids = [kept.facts(name)["pid"] for name in "ab"]
            print(*pids, kept.zygote._process.pid, flush=True)
            time.sleep({DEADLINE_S})
    """
    path = os.pathsep.join([str(Path(__file__).parent), *filter(None, sys.path)])
    environment = os.environ | {"PYTHONPATH": f"{os.environ['PYTHONPATH']}{os.pathsep}{path}"}
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, env=environment
    ) as supervisor:
        try:
            assert supervisor.stdout is not None
            pids = [int(pid) for pid in supervisor.stdout.readline().split()]
            assert len(pids) == 3
            assert all(map(alive, pids))
        finally:
            supervisor.kill()
    wait_for(lambda: not any(map(alive, pids)), "the end of all", DEADLINE_S)
