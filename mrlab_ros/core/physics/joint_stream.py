"""An arm's published joint states, turned into a motion that goes through every one of them."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput

# rad, or rad/s, in order of the joints. Tuples: numpy takes longer for so few numbers.
Joints = tuple[float, ...]

# No arm turns faster, rad/s, not even at rate 4: what does was put elsewhere (a seek).
JUMP_SPEED = 50.0
# An arm whose positions ran so much faster than the velocities it reported was put elsewhere
# too, rad/s.
JUMP_EXCESS = 5.0
# A stamp that lies so far before the last one is another clock's, not a late message's, ns.
RESTART_NS = SECOND
# An arm that has sent nothing for this long stands, ns.
STALE_NS = SECOND // 4
# Shorter than this, ns, no period says how fast something moved.
LEAST_NS = SECOND // 1000
# A second of backlog at 500 Hz.
KEPT = 512
# No joint is turned this far, rad, or turns so fast, rad/s.
LIMIT = 1e5


def between(start: Joints, end: Joints, share: float) -> Joints:
    """Return what lies `share` of the straight way from `start` to `end`."""
    return tuple([a + share * (b - a) for a, b in zip(start, end, strict=True)])


class Placed(NamedTuple):
    """Where the arm is at one instant. jumped: it did not move there, it was put there."""

    positions: Joints
    velocities: Joints
    jumped: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """A straight motion in joint space; of a jump only its end counts."""

    start_ns: int
    end_ns: int
    start: Joints
    end: Joints
    velocities: Joints
    jump: bool


class JointStream:
    """Joint states in, poses at any instant out; linear between two states.

    A moving arm's pose is known up to its last state: `known_until` says so, and whoever steps
    time waits for it, but not longer than max_lag_ns. A stream slower than that is shown one of
    its own periods late instead.
    """

    def __init__(self, joints: int, max_lag_ns: int) -> None:
        self._joints = joints
        self._rest: Joints = (0.0,) * joints
        self._max_lag_ns = max_lag_ns
        self._pieces: deque[_Piece] = deque(maxlen=KEPT)
        self._last: tuple[int, Joints] | None = None
        self._moves = False
        self._fresh = True
        self.delay_ns = 0

    def add(
        self, stamp_ns: int, positions: Sequence[float], velocities: Sequence[float], now_ns: int
    ) -> bool:
        """Take a joint state; return False for one that is not newer than the last.

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
        moved = q != before
        moving = moved or any(v)
        if not moving and not self._moves and not restarted:
            self._last = (stamp_ns, q)
            return True
        period_ns = stamp_ns - before_ns
        if moving and self._moves and not restarted:
            self.delay_ns = period_ns if self._max_lag_ns < period_ns < STALE_NS else 0
        start_ns = max(before_ns, min(now_ns - self.delay_ns, stamp_ns))
        if not self._moves:
            # A standing arm's last state is old; the motion began in this period, not back then.
            start_ns = max(start_ns, stamp_ns - SECOND // 50)
            period_ns = stamp_ns - start_ns
        slope = v
        if moved and period_ns > 0:
            seconds = period_ns / SECOND
            slope = tuple([(b - a) / seconds for a, b in zip(before, q, strict=True)])
        jump = restarted or (moved and _too_far(before, q, period_ns))
        if len(velocities) and moved and not jump:
            jump = _too_fast(slope, v)
        if jump:
            if restarted:
                self._pieces.clear()
                self._fresh = True
            self._put(stamp_ns, q)
        else:
            self._pieces.append(_Piece(start_ns, stamp_ns, before, q, slope, False))
            self._last = (stamp_ns, q)
        self._moves = any(v) or (moving and not jump)
        if not self._moves:
            self.delay_ns = 0
        return True

    def _checked(
        self, positions: Sequence[float], velocities: Sequence[float]
    ) -> tuple[Joints, Joints]:
        q = tuple(map(float, positions))
        v = tuple(map(float, velocities)) or self._rest
        if len(q) != self._joints or len(v) != self._joints:
            raise BadInput(
                f"a joint state has {len(q)} positions and {len(v)} velocities; expected "
                f"{self._joints} of each"
            )
        # Written so that NaN is refused too.
        if not all(-LIMIT <= x <= LIMIT for x in q + v):
            raise BadInput(
                f"a joint state holds NaN, Inf or more than {LIMIT:g} rad; the arm stays where "
                "it is"
            )
        return q, v

    def _put(self, stamp_ns: int, q: Joints) -> None:
        """Note that the arm was put somewhere, without a way there."""
        self._pieces.append(_Piece(stamp_ns, stamp_ns, q, q, self._rest, True))
        self._last = (stamp_ns, q)

    def known_until(self, now_ns: int) -> int | None:
        """Return the time, ns, up to which the motion is known; None: for ever, the arm stands."""
        if not self._moves or self._last is None:
            return None
        until = self._last[0] + self.delay_ns
        return None if now_ns - until > STALE_NS else until

    def shown_ns(self, now_ns: int) -> int:
        """Return the stamp of the motion that is shown at the world's time `now_ns`.

        It stays behind where a moving arm's next joint state is late.
        """
        shown = now_ns - self.delay_ns
        return min(shown, self._last[0]) if self._moves and self._last else shown

    def at(self, now_ns: int) -> Placed | None:
        """Return where the arm is at the world's time `now_ns`; None before the first state."""
        pieces = self._pieces
        if not pieces:
            return None
        now_ns -= self.delay_ns
        jumped, self._fresh = self._fresh, False
        while len(pieces) > 1 and pieces[1].start_ns <= now_ns:
            pieces.popleft()
            jumped |= pieces[0].jump
        piece = pieces[0]
        if now_ns > piece.end_ns or piece.jump:
            return Placed(piece.end, self._rest, jumped)
        if now_ns == piece.end_ns:
            return Placed(piece.end, piece.velocities, jumped)
        share = max((now_ns - piece.start_ns) / (piece.end_ns - piece.start_ns), 0.0)
        return Placed(between(piece.start, piece.end, share), piece.velocities, jumped)


def _too_far(start: Joints, end: Joints, period_ns: int) -> bool:
    reach = JUMP_SPEED * max(period_ns, LEAST_NS) / SECOND
    return max([abs(b - a) for a, b in zip(start, end, strict=True)]) > reach


def _too_fast(slope: Joints, reported: Joints) -> bool:
    """Return whether positions ran away from the velocities that came with them."""
    excess = max([abs(s - r) for s, r in zip(slope, reported, strict=True)])
    return excess - max(map(abs, reported)) > JUMP_EXCESS
