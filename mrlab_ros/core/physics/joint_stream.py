"""An arm's published joint states, turned into a motion that goes through every one of them."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.kinematics import Array

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
KEPT = 64


@dataclass(frozen=True, eq=False)
class Placed:
    """Where the arm is at one instant. jumped: it did not move there, it was put there."""

    positions: Array
    velocities: Array
    jumped: bool = False


@dataclass(frozen=True, eq=False)
class _Piece:
    """A straight motion in joint space; of a jump only its end counts."""

    start_ns: int
    end_ns: int
    start: Array
    end: Array
    velocities: Array
    jump: bool


class JointStream:
    """Joint states in, poses at any instant out; linear between two states.

    A moving arm's pose is known up to its last state: `known_until` says so, and whoever steps
    time waits for it, but not longer than max_lag_ns. A stream slower than that is shown one of
    its own periods late instead.
    """

    def __init__(self, joints: int, max_lag_ns: int) -> None:
        self._joints = joints
        self._max_lag_ns = max_lag_ns
        self._pieces: deque[_Piece] = deque(maxlen=KEPT)
        self._last: tuple[int, Array] | None = None
        self._moves = False
        self._fresh = True
        self.delay_ns = 0

    def add(self, stamp_ns: int, positions: Array, velocities: Array, now_ns: int) -> bool:
        """Take a joint state; return False for one that is not newer than the last.

        now_ns: the world's time. Raises BadInput where the arrays are no joint state.
        """
        q = np.array(positions, dtype=np.float64)
        reported = np.array(velocities, dtype=np.float64)
        v = reported if reported.size else np.zeros_like(q)
        if q.shape != (self._joints,) or v.shape != q.shape:
            raise BadInput(
                f"a joint state has {q.size} positions and {v.size} velocities; expected "
                f"{self._joints} of each"
            )
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise BadInput("a joint state holds NaN or Inf; the arm stays where it is")
        if self._last is None:
            self._last = (stamp_ns, q)
            self._pieces.append(_Piece(stamp_ns, stamp_ns, q, q, np.zeros_like(q), True))
            return True
        before_ns, before = self._last
        restarted = before_ns - stamp_ns >= RESTART_NS
        if stamp_ns <= before_ns and not restarted:
            return False
        moved = q - before
        moving = bool(moved.any() or v.any())
        period_ns = stamp_ns - before_ns
        if moving and self._moves and not restarted:
            self.delay_ns = period_ns if self._max_lag_ns < period_ns < STALE_NS else 0
        start_ns = max(before_ns, min(now_ns - self.delay_ns, stamp_ns))
        if not self._moves:
            # A standing arm's last state is old; the motion began in this period, not back then.
            start_ns = max(start_ns, stamp_ns - SECOND // 50)
            period_ns = stamp_ns - start_ns
        slope = v
        if moved.any() and period_ns > 0:
            slope = moved / (period_ns / SECOND)
        reach = JUMP_SPEED * max(period_ns, LEAST_NS) / SECOND
        jump = restarted or float(np.abs(moved).max()) > reach
        if reported.size and moved.any() and not jump:
            excess = float(np.abs(slope - v).max()) - float(np.abs(v).max())
            jump = excess > JUMP_EXCESS
        if jump:
            self._pieces.append(_Piece(stamp_ns, stamp_ns, q, q, np.zeros_like(q), True))
        else:
            self._pieces.append(_Piece(start_ns, stamp_ns, before, q, slope, False))
        if restarted:
            while len(self._pieces) > 1:
                self._pieces.popleft()
            self._fresh = True
        self._last = (stamp_ns, q)
        self._moves = bool(v.any()) or (moving and not jump)
        if not self._moves:
            self.delay_ns = 0
        return True

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
        if not self._pieces:
            return None
        now_ns -= self.delay_ns
        jumped, self._fresh = self._fresh, False
        while len(self._pieces) > 1 and self._pieces[1].start_ns <= now_ns:
            self._pieces.popleft()
            jumped |= self._pieces[0].jump
        piece = self._pieces[0]
        if now_ns > piece.end_ns or piece.jump:
            return Placed(piece.end, np.zeros_like(piece.end), jumped)
        if now_ns == piece.end_ns:
            return Placed(piece.end, piece.velocities, jumped)
        share = max((now_ns - piece.start_ns) / (piece.end_ns - piece.start_ns), 0.0)
        positions = piece.start + share * (piece.end - piece.start)
        return Placed(positions, piece.velocities, jumped)
