"""Random walks of a playback: commands, collisions, restarts, set clocks and late ticks.

MRLAB_WALKS: how many walks from as many seeds; without it hypothesis makes a few.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable

import numpy as np
from fakes import SECOND, StraightPlanner, make_model, make_trajectory
from hypothesis import given, settings
from hypothesis import strategies as st

from mrlab_ros.core.base.clock import LabTime, PlaybackClock
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.playback.diagnostics import HALTED_BY_CONTACT
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.saved_state import come_back, keep
from mrlab_ros.core.playback.states import MOVING, TABLE, Event, State
from mrlab_ros.core.playback.stream import LOST_AFTER_NS, Sample

WALKS = int(os.environ.get("MRLAB_WALKS", "0"))
TOUCHES = HALTED_BY_CONTACT(link="link_5", other="cube_1")
EVENTS = {
    "load": Event.LOAD,
    "play": Event.PLAY,
    "pause": Event.PAUSE,
    "stop": Event.STOP,
    "seek": Event.SEEK,
    "clear_halt": Event.CLEAR_HALT,
    "collide": Event.COLLIDED,
    "clear": Event.CLEARED,
}
COMMANDS = (*EVENTS, "set_rate", "set_rate", "set_loop", "stage", "hold_at", "die", "set_clock")
FRAME_RATES = (1.0, 2.0, 25.0, 100.0, 500.0, 1000.0, 10_000.0)


class Walk:
    """One playback, and what a client knows of it by its statuses and joint states."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.fps = chance.choice(FRAME_RATES)
        count = chance.randint(2, 40)
        rows = np.column_stack([np.arange(count), -np.arange(count)]) * 0.01
        self.trajectory = make_trajectory(rows, frame_rate=self.fps)
        self.playback = Playback(make_model(), StraightPlanner(0.02), chance.choice([0.0, 2.0]))
        self.steady_ns, self.ahead_ns = SECOND, 0
        self.time = LabTime(self.steady_ns, self.steady_ns)
        # The clocks that were announced while the arm followed the trajectory.
        self.clocks: list[PlaybackClock] = []
        self.last: Sample | None = None
        self.said: list[str] = []

    def now(self) -> int:
        stamp_ns = self.time.follow_wall(self.steady_ns, self.steady_ns + self.ahead_ns)
        instant_ns = stamp_ns - self.time.shifted_ns
        assert instant_ns == self.steady_ns, "an instant moved with the wall clock"
        return instant_ns

    def step(self) -> None:
        period_ns = SECOND / self.fps
        self.steady_ns += round(self.chance.choice([0.0, 0.3, 1.0, 4.0, 20.0]) * period_ns)
        if self.chance.random() < 0.05:
            self.steady_ns += self.chance.choice([SECOND, 3 * SECOND, LOST_AFTER_NS + SECOND])
        if self.chance.random() < 0.7:
            self.serve(self.chance.randint(1, 12))
        name = self.chance.choice(COMMANDS)
        self.said.append(f"{self.steady_ns / SECOND:.4f} {name} {self.playback.state.name}")
        self.command(name)
        self.note()

    def command(self, name: str) -> None:
        playback, now_ns = self.playback, self.now()
        if name == "set_clock":
            self.ahead_ns += self.chance.choice([-600, 600]) * SECOND
            playback.announce_again()
            return
        if name == "die":
            self.die(now_ns)
            return
        before, due_ns, arm = playback.status(), playback.due_ns(), playback.arm
        try:
            self.call(name)(now_ns)
        except LabError:
            assert (playback.status(), playback.due_ns()) == (before, due_ns), "not unchanged"
            return
        event = EVENTS.get(name)
        if event is None:
            return
        expected = TABLE.rows[before.state, event]
        if event is Event.PLAY and playback.state is State.ADJUSTING:
            expected = TABLE.rows[before.state, Event.STAGE]
        assert playback.state is expected
        if event is Event.PAUSE:
            assert np.array_equal(playback.arm, arm)

    def call(self, name: str) -> Callable[[int], object]:
        playback, chance = self.playback, self.chance
        place = chance.random() * self.trajectory.duration * 1.05
        rate = chance.choice([-1, 1, 1]) * chance.uniform(0.09, 4.1)
        loop = chance.random() < 0.3
        calls: dict[str, Callable[[int], object]] = {
            "load": lambda now: playback.load(now, self.trajectory),
            "play": playback.play,
            "pause": playback.pause,
            "stop": playback.stop,
            "seek": lambda now: playback.seek(now, place),
            "clear_halt": playback.clear_halt,
            "collide": lambda now: playback.collide(now, TOUCHES),
            "clear": playback.clear,
            "set_rate": lambda now: playback.set_rate(now, rate),
            "set_loop": lambda _: playback.set_loop(loop),
            "stage": lambda now: playback.stage(now, place),
            "hold_at": lambda _: playback.hold_at(place),
        }
        return calls[name]

    def die(self, now_ns: int) -> None:
        """Be killed, and come back from the journal."""
        kept, state = keep(self.playback), self.playback.state
        self.playback = Playback(make_model(), StraightPlanner(0.02), 2.0)
        self.clocks, self.last = [], None
        if kept is None:
            assert state is State.IDLE
            return
        come_back(self.playback, now_ns, self.trajectory, kept)
        halted = state is State.COLLISION_HALT
        ready = state in (State.READY, State.COMPLETE)
        expected = State.COLLISION_HALT if halted else State.READY if ready else State.PAUSED
        assert self.playback.state is expected
        assert np.array_equal(self.playback.arm, kept.arm)
        if expected is State.PAUSED:
            assert self.playback.clock.position == kept.position

    def serve(self, most: int) -> None:
        """Send what is due."""
        for _ in range(most):
            now_ns, due_ns = self.now(), self.playback.due_ns()
            if due_ns is None or due_ns > now_ns:
                return
            state, arm = self.playback.state, self.playback.arm
            sample = self.playback.tick(now_ns)
            assert sample is not None
            self.check(sample, now_ns)
            if state not in MOVING:
                assert np.array_equal(sample.positions, arm), "a standing arm moved"
            self.last = sample
            self.note()

    def check(self, sample: Sample, now_ns: int) -> None:
        assert sample.due_ns <= now_ns, "a joint state of the future"
        last = self.last
        if not sample.streamed:
            return
        if last is not None and last.streamed:
            assert sample.due_ns >= last.due_ns, "a stamp went back"
        assert 0 <= sample.position <= self.trajectory.duration
        there = [clock for clock in self.clocks if clock.stamp_ns <= sample.due_ns]
        assert there, "no clock was announced for it"
        place = min(max(there[-1].at(sample.due_ns), 0.0), self.trajectory.duration)
        assert abs(place - sample.position) < 1e-6, "off its clock"
        assert np.abs(self.trajectory.sample(sample.position) - sample.positions).max() < 1e-9

    def note(self) -> None:
        for status in self.playback.take_statuses():
            assert 0 <= status.frame < self.trajectory.frame_count or status.trajectory is None
            if status.state is State.PLAYING:
                self.clocks.append(status.clock)
            else:
                assert status.clock.rate == 0
                self.clocks.clear()


def walk(chance: random.Random, steps: int) -> None:
    walker = Walk(chance)
    walker.command("load")
    walker.note()
    try:
        for _ in range(steps):
            walker.step()
    except AssertionError as error:
        raise AssertionError(f"{error} ({walker.fps} Hz)\n" + "\n".join(walker.said)) from error


@settings(max_examples=300, deadline=None)
@given(st.randoms(use_true_random=False), st.integers(1, 40))
def test_a_walk_deviates_from_no_table(chance: random.Random, steps: int) -> None:
    walk(chance, steps)


def test_many_walks() -> None:
    for seed in range(WALKS):
        walk(random.Random(seed), 40)
