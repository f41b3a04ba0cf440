"""A lab that is killed, frozen and commanded at random goes on as a user may expect.

The model knows only what a user was told: which robots there are, what they have loaded, which
systems there are. After every blow the next command works within a few seconds, robots and systems
stand or play but are never lost, and a process that died is named. The seed is printed;
MRLAB_CHAOS_SEED repeats a run, MRLAB_CHAOS_SECONDS makes it longer.
"""

from __future__ import annotations

import json
import os
import random
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from chaos_model import Client, Model
from launched_lab import done, launched_lab, mrlab

from mrlab_ros.processes.run_file import RunFile

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
SECONDS = float(os.environ.get("MRLAB_CHAOS_SECONDS", "15"))
SEED = int(os.environ.get("MRLAB_CHAOS_SEED", str(random.SystemRandom().randrange(2**32))))
# What a freeze lasts, s.
FREEZE_S = 3.0
VICTIMS = ("lab", "playback", "recorder")


@pytest.fixture
def client(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Client]:
    robots = ("--robots", "ur5e,ur5e")
    without = ("--no-bridge", "--no-web", "--no-physics")
    with launched_lab(tmp_path, monkeypatch, *robots, *without), Client() as made:
        done("play", "ur5e_1", MOTION)
        yield made


def pids() -> dict[str, int]:
    found = RunFile(int(os.environ["ROS_DOMAIN_ID"])).read()
    assert found is not None
    return {p["name"]: p["pid"] for p in found["processes"] if p["pid"]}


def blow(dice: random.Random, said: list[str]) -> None:
    """Kill or freeze a process."""
    victim = dice.choice(VICTIMS)
    pid = pids().get(victim)
    if pid is None:
        return
    if dice.random() < 0.6:
        said.append(f"kill {victim}")
        os.kill(pid, signal.SIGKILL)
        return
    said.append(f"freeze {victim}")
    os.kill(pid, signal.SIGSTOP)
    try:
        time.sleep(FREEZE_S)
    finally:
        os.kill(pid, signal.SIGCONT)


def test_a_lab_under_kills_and_freezes_stays_what_its_user_was_told(client):
    dice = random.Random(SEED)
    said: list[str] = [f"MRLAB_CHAOS_SEED={SEED}"]
    model = Model(client, dice, said)
    model.prepare()
    end = time.monotonic() + SECONDS
    blows = 0
    try:
        while time.monotonic() < end or not blows:
            for _ in range(dice.randrange(1, 5)):
                model.step()
            blow(dice, said)
            blows += 1
            model.recover()
        model.check()
        facts = json.loads(mrlab("status", "--json").stdout)
    finally:
        # pytest shows it where the run failed.
        print("\n".join(said))
    died = {name for name in VICTIMS if f"kill {name}" in said}
    restarted = {p["name"] for p in facts["supervisor"]["processes"] if p["restarts"]}
    assert died <= restarted
    assert died <= facts["trouble"].keys() | restarted
