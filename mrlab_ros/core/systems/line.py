"""The line of a system that stands: its timeline stands where its members do.

When a system stands, its members that play stop at a joint state each. The timeline goes on from
the one that is furthest behind; the others are at most a few joint states ahead and begin when it
reaches them. A member whose process died is where its last joint state was; until it is back, that
is computed from the instant of the death.
"""

from __future__ import annotations

import math

from mrlab_ros.core.systems.timeline import Member, Timeline

# A member that is no further than this ahead of the line waits for its turn where it stands; one
# that is further away moves to the line first, s.
TOGETHER_S = 0.1
# Slack when a position is turned into a number of joint states.
ON_FRAME = 1e-6


class Line:
    """The members that were playing when the system stood, and where their timeline is."""

    def __init__(self, timeline: Timeline) -> None:
        self._timeline = timeline
        self._members: list[Member] = []
        # Where they were put, s, if they were: who of them was playing is found by where they are.
        self._put_at: float | None = None

    def leave(self) -> None:
        """Forget the members: the timeline goes on, or begins at its start."""
        self._members, self._put_at = [], None

    def stand(self, position: float, rate: float) -> None:
        """Note that the members stand that were playing when the timeline was at `position` (s).

        Each is at its last joint state before that, until it says where it is. rate: at which it
        went.
        """
        ordered, self._put_at = self._timeline.ordered, None
        self._members = [
            m for m in ordered if (m.end >= position if m.backwards else m.start <= position)
        ]
        for member in self._members:
            reached = _last_joint_state(member, position, rate)
            furthest = min if member.backwards else max
            member.position = furthest(member.position, reached)

    def put(self, position: float) -> None:
        """Note that the members were put somewhere, or stand where their coordinator had ended.

        Those that are found inside their shares play on from there, unless they wait. position:
        where the timeline is, s, while there are none.
        """
        self._members, self._put_at = [m for m in self._timeline if not m.done], position

    def position(self, otherwise: float) -> float:
        """Return where the timeline is, s: at the member furthest behind; `otherwise`: at none.

        Members that have ended further ahead play on from there, too.
        """
        put_at = self._put_at
        played = [m for m in self._members if put_at is None or _is_inside(m)]
        if not played:
            return otherwise if put_at is None else put_at
        furthest_behind = max if self._timeline.backwards else min
        position = furthest_behind(m.start + m.position for m in played)
        for member in self._timeline:
            if member.done and abs(member.position - self._own(member, position)) > TOGETHER_S:
                member.done = False
                self._members.append(member)
        return position

    def place(self, member: Member, position: float) -> float:
        """Return where `member` goes before the timeline starts at `position`, s of its own."""
        if not any(member is one for one in self._members):
            return member.position
        own = self._own(member, position)
        return own if abs(member.position - own) > TOGETHER_S else member.position

    def _own(self, member: Member, position: float) -> float:
        own = min(max(position - member.start, 0.0), member.duration)
        return own if member.until is None else min(own, member.until)


def _is_inside(member: Member) -> bool:
    return 0.0 < member.position < member.duration and member.waiting_for is None


def _last_joint_state(member: Member, position: float, rate: float) -> float:
    """Return where the last joint state of a member was at `position` of the timeline, s."""
    end = member.last if member.until is None else member.until
    own = position - member.start
    if (own - end) * rate >= 0:
        return end
    step = rate / member.frame_rate
    ticks = math.floor((own - member.first) / step + ON_FRAME)
    return min(max(member.first + ticks * step, 0.0), member.duration)
