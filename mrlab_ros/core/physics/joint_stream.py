"""Joint states of an arm, interpolated to a motion that passes through every one of them."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from operator import sub
from typing import NamedTuple

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.physics.diagnostics import JOINT_STATE_BEYOND, JOINT_STATE_SIZE

# rad, or rad/s, in order of the joints. Tuples: numpy takes longer for so few numbers.
Joints = tuple[float, ...]

# A faster motion, rad/s, is a jump (a seek): no arm is as fast, not even at rate 4.
JUMP_SPEED = 50.0
# A difference of positions that exceeds the reported velocities by more, rad/s, is a jump too.
JUMP_EXCESS = 5.0
# A stamp this much older than the last one, ns, is of another clock, not of a late message.
RESTART_NS = SECOND
# Streams slower than this, ns, are delayed by one period, so stepping never waits for the next
# state.
SLOW_NS = SECOND // 20
# Periods shorter than this, ns, give no speed.
LEAST_NS = SECOND // 1000
# Two seconds of backlog at 500 Hz.
KEPT = 1024
# Largest position, rad, and velocity, rad/s, that is accepted.
LIMIT = 1e5


def between(start: Joints, end: Joints, share: float) -> Joints:
    """Interpolate linearly: `share` 0 is `start`, 1 is `end`."""
    return tuple([a + share * (b - a) for a, b in zip(start, end, strict=True)])


class Placed(NamedTuple):
    """The arm at one instant. jumped: it was placed there, not moved."""

    positions: Joints
    velocities: Joints
    jumped: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """A straight motion in joint space; a jump has an end alone."""

    start_ns: int
    end_ns: int
    start: Joints
    end: Joints
    velocities: Joints
    jump: bool


class JointStream:
    """Interpolates joint states linearly to poses at any instant.

    The pose of an arm that moves or plays is known up to its last state (`known_until`); the
    world does not step past it. A slow stream is delayed by one of its own periods.

    max_silence_ns: an arm that sends nothing for longer counts as standing. max_late_ns: the
    world does not wait for a stream whose newest state is older.
    """

    def __init__(self, joints: int, max_silence_ns: int, max_late_ns: int) -> None:
        self._joints = joints
        self._rest: Joints = (0.0,) * joints
        self._max_silence_ns = max_silence_ns
        self._max_late_ns = max_late_ns
        self._silent_ns = 0
        self._plays_since_ns: int | None = None
        self._plays_until_ns: int | None = None
        self._pieces: deque[_Piece] = deque(maxlen=KEPT)
        self._last: tuple[int, Joints] | None = None
        self._moves = False
        # Set while the next state is expected without a pause.
        self._streams = False
        self._fresh = True
        # What lies before is left out.
        self._left_out_ns = 0
        self.delay_ns = 0

    def plays(self, since_ns: int | None, until_ns: int | None) -> None:
        """Set that the arm plays, and so sends states even while it does not move.

        since_ns: may lie in the future; None: it does not play. until_ns: None: no known end.
        """
        self._plays_since_ns, self._plays_until_ns = since_ns, until_ns

    def add(
        self, stamp_ns: int, positions: Sequence[float], velocities: Sequence[float], now_ns: int
    ) -> bool:
        """Add a joint state; return False for one that is not newer than the last.

        now_ns: the world's time. Raises BadInput where the numbers are no joint state.
        """
        q, v = self._checked(positions, velocities)
        if self._last is None:
            self._put(stamp_ns, q)
            return True
        before_ns, before = self._last
        restarted = before_ns - stamp_ns >= RESTART_NS
        if stamp_ns <= before_ns and not restarted:
            return False
        period_ns = stamp_ns - before_ns
        waits = period_ns <= self._max_silence_ns
        # The world does not wait for a slower stream.
        self._silent_ns = 0 if waits else self._max_silence_ns + 1
        moved = q != before
        plays = self._plays_after(stamp_ns)
        moving = moved or any(v) or plays
        if not moving and not self._streams and not restarted:
            self._last = (stamp_ns, q)
            return True
        if moving and self._streams and not restarted:
            self.delay_ns = period_ns if waits and period_ns > SLOW_NS else 0
        start_ns = max(before_ns, min(now_ns - self.delay_ns, stamp_ns))
        if not self._streams:
            # The last state of a standing arm is old; the motion began in this period.
            start_ns = max(start_ns, stamp_ns - SECOND // 50)
            period_ns = stamp_ns - start_ns
        slope = v
        if moved and period_ns > 0:
            seconds = period_ns / SECOND
            slope = tuple([way / seconds for way in map(sub, q, before)])
        placed = stamp_ns <= self._left_out_ns or before_ns < self._left_out_ns - SLOW_NS
        jump = restarted or (moved and (placed or _too_far(before, q, period_ns)))
        if len(velocities) and moved and not jump:
            jump = _too_fast(slope, v)
        if jump:
            if restarted:
                self._pieces.clear()
                self._fresh = True
                self._left_out_ns = 0
            self._put(stamp_ns, q)
        else:
            self._pieces.append(_Piece(start_ns, stamp_ns, before, q, slope, False))
            self._last = (stamp_ns, q)
        # A reported velocity of zero ends the motion.
        self._moves = any(v) or (moved and not jump and not len(velocities))
        self._streams = self._moves or plays
        if not self._streams:
            self.delay_ns = 0
        return True

    def skip(self, to_ns: int) -> None:
        """Leave out the motion until the world's time `to_ns`: the arm is put where it is then."""
        self._left_out_ns = to_ns - self.delay_ns
        self._fresh = True

    def _checked(
        self, positions: Sequence[float], velocities: Sequence[float]
    ) -> tuple[Joints, Joints]:
        q = tuple(map(float, positions))
        v = tuple(map(float, velocities)) or self._rest
        if len(q) != self._joints or len(v) != self._joints:
            raise BadInput(
                JOINT_STATE_SIZE(positions=len(q), velocities=len(v), joints=self._joints)
            )
        if sum(map(abs, q + v)) <= LIMIT:
            return q, v
        # A NaN among others is neither the least nor the greatest of them, but it stays in a sum.
        if not (min(q + v) >= -LIMIT and max(q + v) <= LIMIT and isfinite(sum(q + v))):
            raise BadInput(JOINT_STATE_BEYOND(most=LIMIT))
        return q, v

    def _put(self, stamp_ns: int, q: Joints) -> None:
        """Place the arm without a motion."""
        self._pieces.append(_Piece(stamp_ns, stamp_ns, q, q, self._rest, True))
        self._last = (stamp_ns, q)

    def known_until(self, now_ns: int, waited_ns: int) -> int | None:
        """Return the time, ns, up to which the motion is known; None: the arm stands.

        waited_ns: how long the caller was ready for a state since the last call.
        """
        known_ns = self._known_ns
        if known_ns is None:
            return None
        self._silent_ns += waited_ns
        if self._silent_ns > self._max_silence_ns or now_ns - known_ns > self._max_late_ns:
            return None
        return known_ns

    def _plays_after(self, stamp_ns: int) -> bool:
        """Return whether another state is expected after one with this stamp."""
        until_ns = self._plays_until_ns
        # The end is announced shortly after the last state.
        ends = until_ns is not None and stamp_ns >= until_ns - SLOW_NS
        return self._plays_since_ns is not None and not ends

    @property
    def _known_ns(self) -> int | None:
        if self._last is None:
            return None
        last_ns = self._last[0]
        if self._plays_after(last_ns):
            return max(last_ns + self.delay_ns, self._plays_since_ns or 0)
        return last_ns + self.delay_ns if self._moves else None

    def stands(self, now_ns: int) -> bool:
        """Return whether the arm stands at the world's time `now_ns`, and no motion is known."""
        pieces = self._pieces
        if self._moves or self._streams or len(pieces) > 1:
            return False
        return not pieces or (not self._fresh and now_ns - self.delay_ns > pieces[0].end_ns)

    def shown_ns(self, now_ns: int) -> int:
        """Return the stamp of the motion at the world's time `now_ns`.

        It lags where the next joint state of a moving arm is late.
        """
        known_ns = self._known_ns
        return (now_ns if known_ns is None else min(now_ns, known_ns)) - self.delay_ns

    def at(self, now_ns: int) -> Placed | None:
        """Return the arm at the world's time `now_ns`; None before the first state."""
        pieces = self._pieces
        if not pieces:
            return None
        now_ns -= self.delay_ns
        jumped, self._fresh = self._fresh, False
        # At a common end the earlier piece applies, so the result does not depend on whether the
        # next one is known yet.
        while len(pieces) > 1 and pieces[1].start_ns + (not pieces[1].jump) <= now_ns:
            pieces.popleft()
            jumped |= pieces[0].jump
        piece = pieces[0]
        if now_ns > piece.end_ns or piece.jump:
            return Placed(piece.end, self._rest, jumped)
        if now_ns == piece.end_ns:
            return Placed(piece.end, piece.velocities, jumped)
        length_ns = piece.end_ns - piece.start_ns
        share = max((now_ns - piece.start_ns) / length_ns, 0.0) if length_ns else 0.0
        return Placed(between(piece.start, piece.end, share), piece.velocities, jumped)


def _too_far(start: Joints, end: Joints, period_ns: int) -> bool:
    reach = JUMP_SPEED * max(period_ns, LEAST_NS) / SECOND
    furthest: float = max(map(abs, map(sub, end, start)))
    return furthest > reach


def _too_fast(slope: Joints, reported: Joints) -> bool:
    """Return whether the positions changed much faster than the reported velocities."""
    excess: float = max(map(abs, map(sub, slope, reported)))
    return excess - max(map(abs, reported)) > JUMP_EXCESS
