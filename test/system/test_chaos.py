"""A lab that is killed, frozen and commanded at random goes on as a user may expect.

The model knows only what a user was told: which robots there are, what they have loaded, which
systems there are. Its processes are killed and frozen, its disk fills up, its wall clock is set.
After every blow the next command works within a few seconds, robots and systems stand or play but
are never lost, and a process that died is named. The seed is printed; MRLAB_CHAOS_SEED repeats a
run, MRLAB_CHAOS_SECONDS makes it longer.
"""

from __future__ import annotations

import json
import os
import random
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from blows import Clock, Disk, small_disk
from chaos_model import Client, Model
from launched_lab import done, launched_lab, mrlab
from own_port import free_endpoint

from mrlab_ros.processes.run_file import RunFile

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
SECONDS = float(os.environ.get("MRLAB_CHAOS_SECONDS", "15"))
SEED = int(os.environ.get("MRLAB_CHAOS_SEED", str(random.SystemRandom().randrange(2**32))))
# What a freeze lasts, s.
FREEZE_S = 3.0
VICTIMS = ("lab", "playback", "recorder", "physics", "bridge")
# The wall clock is set by one of these, s.
STEPS = (-3600.0, -5.0, -0.3, 0.3, 5.0, 3600.0)


@dataclass
class World:
    """A launched lab, and what can be done to it."""

    client: Client
    clock: Clock
    disk: Disk


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[World]:
    clock = Clock(tmp_path)
    for name, value in clock.environment.items():
        monkeypatch.setenv(name, value)
    with small_disk(tmp_path / "state") as disk:
        options = ("--robots", "ur5e,ur5e", "--zenoh-listen", free_endpoint())
        with (
            launched_lab(tmp_path, monkeypatch, *options, "--state-dir", disk.folder),
            Client() as client,
        ):
            done("play", "ur5e_1", MOTION)
            yield World(client, clock, disk)


def pids() -> dict[str, int]:
    found = RunFile(int(os.environ["ROS_DOMAIN_ID"])).read()
    assert found is not None
    return {p["name"]: p["pid"] for p in found["processes"] if p["pid"]}


def kill(world: World, dice: random.Random, said: list[str], model: Model) -> None:
    victim = dice.choice(VICTIMS)
    pid = pids().get(victim)
    if pid is not None:
        said.append(f"kill {victim}")
        os.kill(pid, signal.SIGKILL)


def freeze(world: World, dice: random.Random, said: list[str], model: Model) -> None:
    victim = dice.choice(VICTIMS)
    pid = pids().get(victim)
    if pid is not None:
        said.append(f"freeze {victim}")
        os.kill(pid, signal.SIGSTOP)
        try:
            time.sleep(FREEZE_S)
        finally:
            os.kill(pid, signal.SIGCONT)


def set_clock(world: World, dice: random.Random, said: list[str], model: Model) -> None:
    step = dice.choice(STEPS)
    said.append(f"set the wall clock by {step:g} s")
    world.clock.set_by(step)


def fill_disk(world: World, dice: random.Random, said: list[str], model: Model) -> None:
    """Fill the disk, and command the lab while it is full."""
    if not world.disk.small:
        said.append("no full disk: no small one can be mounted here")
        return
    said.append("fill the disk")
    world.disk.fill()
    try:
        for _ in range(3):
            model.step()
        model.recover()
    finally:
        world.disk.free()
    said.append("the disk is free again")


Blow = Callable[[World, random.Random, list[str], Model], None]
BLOWS: dict[Blow, int] = {kill: 5, freeze: 3, set_clock: 3, fill_disk: 2}


@pytest.mark.timeout(240 + 4 * SECONDS)
def test_a_lab_under_kills_freezes_and_set_clocks_stays_what_its_user_was_told(world):
    dice = random.Random(SEED)
    said: list[str] = [f"MRLAB_CHAOS_SEED={SEED}"]
    model = Model(world.client, dice, said)
    end = time.monotonic() + SECONDS
    blows = 0
    try:
        model.prepare()
        while time.monotonic() < end or not blows:
            for _ in range(dice.randrange(1, 5)):
                model.step()
            [blow] = dice.choices(list(BLOWS), list(BLOWS.values()))
            blow(world, dice, said, model)
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
