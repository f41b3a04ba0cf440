"""`mrlab up` as a user runs it: real processes, a real graph, signals."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import in_process
import psutil
import pytest
from child_process import start_child
from own_domain import own_domain
from own_port import free_endpoint

DEADLINE = 60.0
MRLAB = (sys.executable, "-m", "mrlab_ros.cli")


def wait_for(condition: Callable[[], object], what: str) -> None:
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
        time.sleep(0.05)


def mrlab(*arguments: str, timeout: float = DEADLINE) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        (*MRLAB, *arguments), capture_output=True, text=True, timeout=timeout, check=False
    )


class Lab:
    """A `mrlab up` with what it prints, on a domain and port of its own."""

    def __init__(self, folder: Path, *options: str) -> None:
        self._output = folder / "up.log"
        with open(self._output, "wb") as output:
            self.process = start_child(
                *(*MRLAB, "up", "--robots", "ur5e", *options),
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        self.children: list[psutil.Process] = []

    @property
    def said(self) -> str:
        return self._output.read_text()

    @property
    def ended(self) -> bool:
        return self.process.poll() is not None

    def wait_until_ready(self) -> None:
        # On a busy machine after it has said that it is not complete yet.
        wait_for(lambda: "is ready" in self.said or self.ended, "ready")
        assert "is ready" in self.said, self.said
        self.children = psutil.Process(self.process.pid).children(recursive=True)
        assert len(self.children) >= 3

    def all_gone(self) -> bool:
        def alive(child: psutil.Process) -> bool:
            try:
                return bool(child.status() != psutil.STATUS_ZOMBIE)
            except psutil.NoSuchProcess:
                return False

        return not any(map(alive, self.children))

    def status(self) -> dict[str, Any]:
        done = in_process.mrlab("status", "--json")
        assert done.returncode == 0, done.stderr
        found: dict[str, Any] = json.loads(done.stdout)
        return found


@contextmanager
def running(folder: Path, *options: str) -> Iterator[Lab]:
    """Run a lab that is ready."""
    with pytest.MonkeyPatch.context() as patch, own_domain() as domain:
        patch.setenv("XDG_RUNTIME_DIR", str(folder))
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        patch.setenv("ROS_DOMAIN_ID", str(domain))
        started = Lab(folder, *options)
        try:
            started.wait_until_ready()
            yield started
        finally:
            started.process.kill()
            started.process.wait()


@pytest.fixture(scope="module")
def used(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """A lab that several tests use in their order, the last of which ends it."""
    # A short name: the path of a Unix socket has 107 bytes at most.
    options = ("--zenoh-listen", free_endpoint(), "--http", "127.0.0.1:0")
    with running(tmp_path_factory.mktemp("u"), *options) as started:
        yield started


def test_the_graph_heals_when_a_process_dies(used: Lab) -> None:
    before = used.status()
    assert [robot["state"] for robot in before["robots"]] == ["IDLE"]
    victim = next(p for p in before["supervisor"]["processes"] if p["name"] == "lab")
    os.kill(victim["pid"], signal.SIGKILL)
    wait_for(lambda: "the scene is back" in used.said, "the scene back")
    after = used.status()
    assert [robot["name"] for robot in after["robots"]] == ["ur5e_1"]
    restarts = {p["name"]: p["restarts"] for p in after["supervisor"]["processes"]}
    others = ("playback", "physics", "frames", "bridge", "recorder", "web")
    assert restarts == {"lab": 1, **dict.fromkeys(others, 0)}
    assert "lab ended (SIGKILL); restarts in 0.1 s" in used.said


def test_the_pages_are_opened_by_the_printed_url(used: Lab) -> None:
    wait_for(lambda: "?token=" in used.said, "the URL")
    (url,) = re.findall(r"http://\S+", used.said.split("open the pages")[1].splitlines()[0])
    with httpx.Client(follow_redirects=True) as browser:
        browser.get(url)
        origin = url.partition("/?")[0]
        assert browser.get(f"{origin}/api/session").json()["user"]["name"] == "local"
    with httpx.Client(follow_redirects=True) as stranger:
        stranger.get(url)
        assert stranger.get(f"{origin}/api/session").json()["user"] is None
    assert used.status()["web"] == {"address": origin, "answers": True}
    victim = next(p for p in used.status()["supervisor"]["processes"] if p["name"] == "web")
    os.kill(victim["pid"], signal.SIGKILL)
    wait_for(lambda: "web ended (SIGKILL); restarts in 0.1 s" in used.said, "the restart")


def test_play_follows_a_workspace_file_to_its_end(used: Lab) -> None:
    file = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
    done = mrlab("play", "ur5e_1", str(file), "--speed", "4")
    assert done.returncode == 0, done.stderr
    assert "ur5e_1 played 601 frames" in done.stdout
    for arguments, words in (
        (("play", "nobody", "quintic_ur5e"), "nobody"),
        (("play", "ur5e_1", "nothing"), "no trajectory 'nothing'"),
        (("play", "ur5e_1", "quintic_ur5e", "--speed", "9"), "0.1 to 4"),
        (("up",), "domain"),
    ):
        refused = in_process.mrlab(*arguments)
        assert refused.returncode == 1
        assert words in refused.stderr
        said = [line for line in refused.stderr.splitlines() if not line.startswith("  try: ")]
        assert len(said) == 1


def test_a_lab_that_was_used_stops_cleanly_and_leaves_nothing(used: Lab) -> None:
    used.children = psutil.Process(used.process.pid).children(recursive=True)
    assert len(used.children) >= 3
    used.process.send_signal(signal.SIGTERM)
    assert used.process.wait(DEADLINE) == 0
    # The kernel kills what its processes had started, which is reaped a moment later.
    wait_for(used.all_gone, "all processes of the lab gone")
    done = mrlab("status", "--once")
    assert done.returncode == 1
    assert "try: mrlab up" in done.stderr
    assert "Traceback" not in used.said + done.stderr


def test_no_process_outlives_a_killed_supervisor(tmp_path: Path) -> None:
    with running(tmp_path, "--no-bridge", "--no-web") as lab:
        lab.process.kill()
        lab.process.wait()
        wait_for(lab.all_gone, "all processes of the lab gone")


def test_help_teaches() -> None:
    done = mrlab("--help")
    assert done.returncode == 0
    for word in ("up", "demo", "convert", "play", "robots", "status", "Exit codes"):
        assert word in done.stdout


@pytest.mark.parametrize(
    ("start", "arguments", "words"),
    [
        (mrlab, ("up", "--robots", "ur6"), "no robot 'ur6'; there are:"),
        (
            in_process.mrlab,
            ("up", "--config", "/nowhere.yaml"),
            "no parameter file /nowhere.yaml",
        ),
        (in_process.mrlab, ("up", "--http", "0.0.0.0:8080"), "try: mrlab keys init"),
        (in_process.mrlab, ("up", "--http", "here"), "HOST:PORT"),
        (mrlab, ("demo", "--once", "--file", "/nowhere.mat"), "no file /nowhere.mat"),
    ],
)
def test_a_wrong_argument_is_one_sentence(
    start: Callable[..., subprocess.CompletedProcess[str]], arguments: tuple[str, ...], words: str
) -> None:
    done = start(*arguments)
    assert done.returncode == 1
    assert words in done.stderr
    said = [line for line in done.stderr.splitlines() if not line.startswith("  try: ")]
    assert len(said) == 1


def test_a_wrong_parameter_file_is_named_whole_and_nothing_starts(tmp_path: Path) -> None:
    config = tmp_path / "bad.yaml"
    config.write_text(
        "playback_host: {ros__parameters: {telemetry_rate: 0, standing_rate: .nan}}\n"
        "recorder: {ros__parameters: {split_size: -5}}\n"
        "laab: {ros__parameters: {robots: [ur5e]}}\n"
    )
    done = in_process.mrlab("up", "--no-web", "--config", str(config))
    assert done.returncode == 1
    for words in (
        "bad.yaml has 4 mistakes",
        "telemetry_rate is 0; expected a number above 0",
        "standing_rate is nan",
        "split_size is -5",
        "mean 'lab'",
    ):
        assert words in done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    assert "starts the lab" not in done.stdout


def test_a_process_that_refuses_its_configuration_ends_the_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tmp_path / "lab.yaml"
    config.write_text("bridge: {ros__parameters: {allow_list: /nowhere.yaml}}\n")
    # A domain of its own: the bridge of another lab there would be taken for this one's.
    with own_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
        done = mrlab("up", "--no-physics", "--no-web", "--config", str(config))
    assert done.returncode == 1
    assert "allow-list /nowhere.yaml" in done.stdout
    assert "bridge refused the configuration" in done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_debug_shows_where() -> None:
    done = in_process.mrlab("--debug", "up", "--robots", "ur6")
    assert done.returncode == 1
    assert "Traceback" in done.stderr
