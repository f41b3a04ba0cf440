"""A robot system's timeline: each member's share of it and its waits.

All positions are s, on the timeline or on a member's own trajectory; nothing here knows the time
of day. `RobotSystem` moves the clock and sends the orders.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from enum import Enum

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.waits import AfterFrame, Held, Wait, waiting_circle

# A member's own end and the timeline's are the same within this, s.
SAME_INSTANT = 1e-6
# The longest dwell, s.
MAX_DWELL = 3600.0


class Mode(Enum):
    """How the members share the timeline; the values are those of mrlab_msgs/RobotSystem."""

    PARALLEL = 0
    SEQUENTIAL = 1


@dataclass
class Member:
    """One robot and its share of the timeline, which begins at `start` (s).

    dwell: s after its end before the next member begins (sequential mode).
    duration (s), frame_rate (Hz): of its trajectory.
    playback_state, position (s on its trajectory): as the robot reported them last.
    replied_ns: the stamp of its last reply; what it reported before that is out of date.
    ordered: PLAY was sent and the member has not stopped since. done: it has played to its end.
    met: the waits whose condition was true. backwards: it plays from its end to its start; it has
    no waits then.
    """

    robot: str
    trajectory_id: str = ""
    dwell: float = 0.0
    waits: tuple[Wait, ...] = ()
    duration: float = 0.0
    frame_rate: float = 0.0
    start: float = 0.0
    playback_state: State = State.IDLE
    position: float = 0.0
    replied_ns: int = 0
    ordered: bool = False
    done: bool = False
    met: set[Wait] = field(default_factory=set)
    backwards: bool = False

    def __post_init__(self) -> None:
        if not 0 <= self.dwell < MAX_DWELL:
            raise BadInput(say.BAD_DWELL(dwell=self.dwell, longest=MAX_DWELL))

    @property
    def end(self) -> float:
        """Return the end of its share of the timeline, s."""
        return self.start + self.duration

    @property
    def first(self) -> float:
        """Return the start of its run, s on its trajectory."""
        return self.duration if self.backwards else 0.0

    @property
    def last(self) -> float:
        """Return the end of its run, s on its trajectory."""
        return 0.0 if self.backwards else self.duration

    @property
    def open_waits(self) -> list[Wait]:
        """The waits whose condition was not true yet, in order of frame; none backwards."""
        if self.backwards:
            return []
        return sorted((w for w in self.waits if w not in self.met), key=lambda w: w.frame)

    @property
    def until(self) -> float | None:
        """Return the place of the member's next open wait, s on its trajectory; None: none."""
        waits = self.open_waits
        return self.wait_position(waits[0]) if waits else None

    @property
    def waiting_for(self) -> Wait | None:
        """The wait that holds the member where it stands."""
        if self.ordered or self.done:
            return None
        reached = self.position + SAME_INSTANT
        return next((w for w in self.open_waits if self.wait_position(w) <= reached), None)

    def wait_position(self, wait: Wait) -> float:
        """Return where on its trajectory `wait` holds the member, s."""
        return min(wait.frame / self.frame_rate, self.duration)


class Timeline:
    """The members in order of their turns, and their shares of one timeline.

    holders: which robot holds which object, by the object's name. backwards: it runs from its end
    to 0, as fast as it would run forwards, and nothing waits.
    """

    def __init__(self, members: Iterable[Member], mode: Mode) -> None:
        self.members = {member.robot: member for member in members}
        self.mode = mode
        self.holders: dict[str, str] = {}
        self.backwards = False

    def __iter__(self) -> Iterator[Member]:
        return iter(self.members.values())

    @property
    def duration(self) -> float:
        """The length of the timeline, s."""
        return max((member.end for member in self), default=0.0)

    @property
    def first(self) -> float:
        """Return the start of a whole run, s."""
        return self.duration if self.backwards else 0.0

    @property
    def last(self) -> float:
        """Return the end of a whole run, s."""
        return 0.0 if self.backwards else self.duration

    @property
    def frame_rate(self) -> float:
        """The frame rate of the fastest member, Hz."""
        return max(member.frame_rate for member in self)

    @property
    def ordered(self) -> list[Member]:
        """The members to which PLAY was sent."""
        return [member for member in self if member.ordered]

    @property
    def complete(self) -> bool:
        """Return whether every member has played to its end."""
        return all(member.done for member in self)

    def check_waits(self) -> None:
        """Raise BadInput where a wait names a frame or a member that does not exist."""
        for member in self:
            frames = round(member.duration * member.frame_rate) + 1
            for wait in member.waits:
                if wait.frame >= frames:
                    raise BadInput(
                        say.WAIT_BEYOND_END(
                            robot=member.robot, frame=wait.frame, last_frame=frames - 1
                        )
                    )
                condition = wait.condition
                if not isinstance(condition, AfterFrame):
                    continue
                if condition.robot not in self.members:
                    raise BadInput(
                        say.WAIT_FOR_STRANGER(
                            wait=wait.text, robot=condition.robot, members=list(self.members)
                        )
                    )
                if condition.robot == member.robot:
                    raise BadInput(say.WAIT_FOR_ITSELF(robot=member.robot, wait=wait.text))
        self.check_circles(self.mode)

    def check_circles(self, mode: Mode) -> None:
        """Raise BadInput where members would wait for each other without end in `mode`."""
        circle = waiting_circle(list(self), sequential=mode is Mode.SEQUENTIAL)
        if circle:
            raise BadInput(say.WAITING_CIRCLE(steps=circle))

    # shares ---------------------------------------------------------------------------------

    def lay_out(self) -> None:
        """Give every member its share, as if no wait took any time."""
        start = 0.0
        for member in self:
            member.start = start
            if self.mode is Mode.SEQUENTIAL:
                start = member.end + member.dwell

    def turn(self, *, backwards: bool) -> None:
        """Run in this direction from where the members are; no effect where it does already."""
        if backwards is self.backwards:
            return
        self.backwards = backwards
        for member in self:
            member.backwards = backwards
            member.done = abs(member.position - member.last) <= SAME_INSTANT
            member.met = _passed(member)

    def rewind(self) -> None:
        """Put every member where its run begins and forget what this run has met."""
        for member in self:
            member.position, member.ordered, member.done = member.first, False, False
            member.met = set()
        self.lay_out()

    def seek(self, position: float) -> None:
        """Put the members where they are at `position` (s) of the timeline.

        Members whose share is over stand at their ends, members whose share follows at their
        starts. Waits before that count as met.
        """
        for member in self:
            member.position = min(max(position - member.start, 0.0), member.duration)
            member.met = _passed(member)
            if self.backwards:
                over = position <= member.start + SAME_INSTANT
                member.done = over and member.position < member.duration
            else:
                member.done = position >= member.end - SAME_INSTANT and member.position > 0

    def place(self, position: float) -> None:
        """Put members that play on later where they are at `position` (s) of the timeline.

        Unlike seek() it keeps which waits were met and who is done; a member that waits stands
        where it waits.
        """
        for member in self:
            if member.done:
                continue
            reached = min(max(position - member.start, 0.0), member.duration)
            until = member.until
            member.position = reached if until is None else min(reached, until)

    def shift(self, member: Member, start: float) -> None:
        """Begin a member's share at `start` (s); in sequential mode those after it follow."""
        member.start = start
        if self.mode is Mode.SEQUENTIAL and self.backwards:
            for before, after in itertools.pairwise(self):
                if not (before.done or before.ordered):
                    latest = after.start - before.dwell - before.duration
                    before.start = min(before.start, latest)
        elif self.mode is Mode.SEQUENTIAL:
            for before, after in itertools.pairwise(self):
                if not (after.done or after.ordered):
                    after.start = max(after.start, before.end + before.dwell)

    def known_starts(self) -> Iterator[Member]:
        """Yield the members whose start is known.

        In sequential mode the members after one that waits or is halted are left out; backwards
        the turns are the other way round.
        """
        for member in reversed(list(self)) if self.backwards else self:
            if member.done:
                continue
            halted = member.playback_state is State.COLLISION_HALT
            if member.waiting_for is None and not halted:
                yield member
            if self.mode is Mode.SEQUENTIAL and (halted or member.open_waits):
                return

    # waits ----------------------------------------------------------------------------------

    def grasped(self, robot: str, held: str | None) -> None:
        """Note what a robot holds now: an object's name, or None."""
        self.holders = {o: r for o, r in self.holders.items() if r != robot}
        if held is not None:
            self.holders[held] = robot

    def meet_waits(self, position: float) -> list[Member]:
        """Mark the waits that are met at `position` (s) of the timeline.

        Returns the playing members whose next hold has changed.
        """
        changed = []
        for member in self:
            if member.done:
                continue
            waiting_for, first = member.waiting_for, member.open_waits[:1]
            for wait in member.open_waits:
                # The holder of an object counts only once the member has arrived at the frame.
                early = isinstance(wait.condition, Held) and (
                    waiting_for is None or wait.frame != waiting_for.frame
                )
                if not early and self._is_met(wait, position):
                    member.met.add(wait)
            if member.ordered and first and member.open_waits[:1] != first:
                changed.append(member)
        return changed

    def _is_met(self, wait: Wait, position: float) -> bool:
        condition = wait.condition
        if isinstance(condition, Held):
            return self.holders.get(condition.object) == condition.robot
        other = self.members[condition.robot]
        reached = position - other.start if other.ordered else other.position
        return other.done or reached >= condition.frame / other.frame_rate - SAME_INSTANT


def _passed(member: Member) -> set[Wait]:
    """Return the waits before the place where a member is."""
    return {wait for wait in member.waits if member.wait_position(wait) < member.position}
