"""The deadline thread: order, isolation, an end."""

from __future__ import annotations

import itertools
import os
import threading
import time

import numpy as np
import pytest
from fakes import StraightPlanner, make_model, make_trajectory
from graph import wait_for

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.ros import deadlines
from mrlab_ros.ros.clock import LabClock
from mrlab_ros.ros.deadlines import Player, Scheduler


@pytest.fixture
def scheduler():
    scheduler = Scheduler()
    scheduler.start()
    yield scheduler
    scheduler.stop()


def add(scheduler: Scheduler, frames: int = 50, send=None) -> tuple[Player, list, list]:
    """Add a player whose arm stands on its first frame."""
    sent, announced = [], []
    playback = Playback(make_model(), StraightPlanner(), 0.0)
    positions = np.arange(2.0 * frames).reshape(frames, 2)
    playback.load(0, make_trajectory(positions, frame_rate=500.0))
    playback.seek(0, 0.0)
    player = Player(
        playback,
        send or (lambda sample: sent.append(sample) if sample.streamed else None),
        lambda now_ns, snapshot: announced.append(snapshot.state),
    )
    scheduler.add(player)
    return player, sent, announced


def test_players_started_at_one_stamp_send_the_same_frames_in_order(scheduler):
    players = [add(scheduler) for _ in range(5)]
    with scheduler.command() as now_ns:
        for player, _, _ in players:
            player.playback.play(now_ns, now_ns + 20_000_000)
    wait_for(lambda: all(len(sent) == 50 for _, sent, _ in players), "all frames")
    for _, sent, announced in players:
        assert [s.frame for s in sent] == list(range(50))
        assert [s.due_ns for s in sent] == [s.due_ns for s in players[0][1]]
        wait_for(lambda seen=announced: seen[-1] is State.READY, "the end")
        assert announced[-3:] == [State.PLAYING, State.COMPLETE, State.READY]


def test_nothing_leaves_before_its_deadline(scheduler):
    early = []

    def send(sample):
        if sample.streamed and scheduler.clock.instant_ns() < sample.due_ns:
            early.append(sample)

    player, _, announced = add(scheduler, send=send)
    with scheduler.command() as now_ns:
        player.playback.play(now_ns)
    wait_for(lambda: State.COMPLETE in announced, "the end")
    assert early == []


def test_a_player_that_fails_does_not_stop_the_others(scheduler, capfd):
    def fail(sample):
        raise RuntimeError("no network")

    broken, _, _ = add(scheduler, send=fail)
    player, sent, _ = add(scheduler)
    with scheduler.command() as now_ns:
        broken.playback.play(now_ns)
        player.playback.play(now_ns)
    wait_for(lambda: len(sent) == 50, "all frames of the other")
    assert "no network" in capfd.readouterr().err


@pytest.mark.parametrize("connected", [True, False])
def test_a_player_that_cannot_tell_is_trouble_only_while_the_graph_is_there(capfd, connected):
    failed = []

    def announce(now_ns, snapshot):
        if threading.current_thread().name == "deadlines":
            failed.append(snapshot)
            raise RuntimeError("no network")

    scheduler = Scheduler(lambda: connected)
    scheduler.start()
    try:
        playback = Playback(make_model(), StraightPlanner(), 0.0)
        scheduler.add(Player(playback, lambda sample: None, announce))
        player, sent, _ = add(scheduler)
        with scheduler.command() as now_ns:
            playback.load(now_ns, make_trajectory(np.zeros((50, 2)), frame_rate=500.0))
            playback.play(now_ns)
        wait_for(lambda: failed, "a state of the deadline thread")
        with scheduler.command() as now_ns:
            player.playback.play(now_ns)
        wait_for(lambda: len(sent) == 50, "all frames of the other")
    finally:
        scheduler.stop()
    assert ("no network" in capfd.readouterr().err) is connected


def test_a_command_that_cannot_tell_lets_others_go_on(scheduler):
    def announce(now_ns, snapshot):
        raise RuntimeError("no network")

    playback = Playback(make_model(), StraightPlanner(), 0.0)
    scheduler.add(Player(playback, lambda sample: None, announce))
    with pytest.raises(RuntimeError), scheduler.command() as now_ns:
        playback.load(now_ns, make_trajectory(np.zeros((50, 2)), frame_rate=500.0))
    with scheduler.command() as now_ns:
        assert now_ns


def test_a_removed_player_is_served_no_more(scheduler):
    player, sent, _ = add(scheduler, frames=5000)
    with scheduler.command() as now_ns:
        player.playback.play(now_ns)
    wait_for(lambda: len(sent) > 5, "frames")
    scheduler.remove(player)
    count = len(sent)
    other, others, _ = add(scheduler)
    with scheduler.command() as now_ns:
        other.playback.play(now_ns)
    wait_for(lambda: len(others) == 50, "frames of another")
    assert len(sent) == count


def test_a_wall_clock_that_is_set_moves_no_frame():
    """Set back 5 s and forward an hour in the middle of a run: the spacing of frames stays."""
    wall = [time.time_ns() - time.monotonic_ns()]
    clock = LabClock(wall_ns=lambda: time.monotonic_ns() + wall[0])
    scheduler = Scheduler(clock=clock)
    scheduler.start()
    try:
        sent, states = [], []
        player, _, _ = add(
            scheduler,
            150,
            lambda sample: sent.append((time.monotonic_ns(), sample, clock.stamp(sample.due_ns))),
        )
        announced = player._announce
        player._announce = lambda now_ns, status: (
            states.append((clock.stamp(status.clock.stamp_ns), status)),
            announced(now_ns, status),
        )
        with scheduler.command() as now_ns:
            player.playback.play(now_ns)
        for step in (-5 * SECOND, 3600 * SECOND):
            before = len(sent)
            wait_for(lambda count=before: len(sent) > count + 30, "frames")
            wall[0] += step
        wait_for(lambda: player.playback.state is State.READY, "the end")
    finally:
        scheduler.stop()
    sent = [each for each in sent if each[1].streamed]
    assert [sample.frame for _, sample, _ in sent] == list(range(150))
    began, ended = sent[0][0], sent[-1][0]
    # 149 periods of 2 ms; a machine that is busy may add to them, 5 s it does not.
    assert 0.29 <= (ended - began) / SECOND < 2.0
    # Stamps follow the wall clock, and the clock pair that clients compute with is said anew.
    gaps = [b - a for (*_, a), (*_, b) in itertools.pairwise(sent)]
    odd = [gap for gap in gaps if abs(gap - 2_000_000) > 10]
    assert [round(gap / SECOND) for gap in odd] == [-5, 3600]
    pairs = [stamp for stamp, status in states if status.state is State.PLAYING]
    assert [round((b - a) / SECOND) for a, b in itertools.pairwise(pairs)] == [-5, 3600]


class Simulated:
    """A node whose clock a test moves, as /clock would."""

    def __init__(self) -> None:
        self.nanoseconds = 0
        self.ros_time_is_active = True

    def get_clock(self):
        return self

    def now(self):
        return self


def test_clock_drives_playback_and_pauses_it():
    node = Simulated()
    scheduler = Scheduler(clock=LabClock(node))
    scheduler.start()
    try:
        player, sent, announced = add(scheduler)
        node.nanoseconds = 1000 * SECOND
        with scheduler.command() as now_ns:
            assert scheduler.clock.stamp(now_ns) == 1000 * SECOND
            player.playback.play(now_ns)
        wait_for(lambda: len(sent) == 1, "the first frame")
        # 20 ms in one tick: ten frames of 500 Hz, each with its own stamp.
        node.nanoseconds += 20_000_000
        wait_for(lambda: len(sent) == 11, "the frames of a tick")
        assert [s.due_ns - now_ns for s in sent] == [i * 2_000_000 for i in range(11)]
        # Back, as a bag that is played from its begin again: nothing moves, and it goes on.
        node.nanoseconds = 10 * SECOND
        with scheduler.command() as now_ns:
            assert (scheduler.clock.stamp(now_ns), len(sent)) == (10 * SECOND, 11)
        node.nanoseconds += 78_000_000
        wait_for(lambda: len(sent) == 50, "the other frames")
        wait_for(lambda: State.COMPLETE in announced, "the end")
        assert [s.frame for s in sent] == list(range(50))
        assert scheduler.clock.stamp(sent[-1].due_ns) == 10 * SECOND + 78_000_000
    finally:
        scheduler.stop()


def refuse(*arguments):
    raise PermissionError


@pytest.fixture
def asked(monkeypatch):
    """Record what is asked for in place of the kernel."""
    calls = []
    monkeypatch.setattr(os, "sched_setscheduler", lambda *a: calls.append(a))
    monkeypatch.setattr(os, "setpriority", lambda *a: calls.append(a))
    return calls


def test_round_robin_is_asked_for_first_and_not_inherited(asked):
    assert deadlines.take_precedence() == "SCHED_RR 10"
    ((_, policy, parameter),) = asked
    assert policy == os.SCHED_RR | os.SCHED_RESET_ON_FORK
    assert parameter.sched_priority == 10


def test_a_nice_level_is_asked_for_where_round_robin_is_not_permitted(asked, monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    assert deadlines.take_precedence() == "nice -10"
    assert len(asked) == 1


def test_a_thread_that_gets_neither_says_so(monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    monkeypatch.setattr(os, "setpriority", refuse)
    assert deadlines.take_precedence().startswith("ordinary priority")
