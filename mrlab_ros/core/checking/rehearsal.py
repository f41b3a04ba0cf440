"""Plays trajectories in a world without a graph, as fast as it goes, and records what happens.

The joint states are those that a playback sends (`core.playback.stream`), and the world is the
physics node's. A collision is recorded and the motion goes on: the lab would halt there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.checking.rehearsal_record import (
    Collision,
    Course,
    Distances,
    Drop,
    GraspChange,
    Rehearsed,
)
from mrlab_ros.core.physics.engine import Engine, Kind, Touch
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import (
    CollisionChanged,
    Contact,
    GraspChanged,
    LoadChanged,
    ObjectRemoved,
)
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Stream
from mrlab_ros.core.systems.waits import AfterFrame, Held, Wait
from mrlab_ros.core.trajectory.trajectory import Trajectory

TICK_NS = SECOND // 100
# Before the motion the robots stand at their first frames while objects come to rest; after it
# what was let go falls.
LEAD_NS, TAIL_NS = SECOND, SECOND // 2
# Distances are taken every 20 ms, up to 0.5 m.
DISTANCE_TICKS, FARTHEST = 2, 0.5
DISTANCE_PERIOD = DISTANCE_TICKS * TICK_NS / SECOND
# Pictures are recorded 25 times a second.
DRAWN_TICKS = 4
PROGRESS_TICKS = 10
# How long what was let go is watched as it falls, ns.
FALLS_NS = TAIL_NS
# A member waits for ever where nothing else has moved for so long, ns.
STUCK_NS = 2 * SECOND


@dataclass(frozen=True, eq=False)
class Actor:
    """A robot of the rehearsal. trajectory: None: it stands at `home`, (J,) rad.

    start: s, when its share of the timeline begins; after: it begins when that robot has ended,
    `dwell` s later, instead. first_link: the first that moves; it is as near to what the robot
    stands on as it is built.
    """

    name: str
    home: Array
    trajectory: Trajectory | None = None
    start: float = 0.0
    after: str = ""
    dwell: float = 0.0
    waits: tuple[Wait, ...] = ()
    first_link: str = ""


@dataclass(eq=False)
class _Playing:
    """An actor's way through its trajectory."""

    actor: Actor
    stream: Stream
    waits: list[Wait]
    begun: bool = False
    done: bool = False
    waits_since_ns: int | None = None
    stuck: bool = False
    known: set[tuple[Kind, str]] = field(default_factory=set)


class Rehearsal:
    """One run of all actors in a world that holds them already, with its objects.

    engine: the world's own. drawn: record where everything was, for a page. progress: is called
    ten times a second of the motion with the time that was rehearsed, s.
    """

    def __init__(
        self,
        world: World,
        engine: Engine,
        actors: Sequence[Actor],
        drawn: bool = True,
        progress: Callable[[float], None] | None = None,
    ) -> None:
        self._progress = progress
        self._world = world
        self._engine = engine
        self._drawn = drawn
        self._playing = [self._prepared(actor) for actor in actors]
        self._by_name = {each.actor.name: each for each in self._playing}
        self._now_ns = 0
        self._recorded = Rehearsed()
        # By robot: what it holds. By object: where it was let go, until when it is watched.
        self._held: dict[str, str] = {}
        self._falling: dict[str, tuple[Drop, float, int]] = {}

    def place(self) -> None:
        """Put every robot at its first frame, or where it stands."""
        for each in self._playing:
            self._place(each)
        self._world.advance(0)
        self._now_ns = TICK_NS
        self._world.advance(TICK_NS)
        self._note()

    def run(self) -> Rehearsed:
        """Play everything to its end and return what was recorded; place() comes first."""
        while self._now_ns < LEAD_NS:
            self._advance()
        self._recorded.begins_inside = {
            each.actor.name: tuple(sorted(self._world.robot(each.actor.name).tolerated))
            for each in self._playing
        }
        ticks = 0
        until_ns = None
        while until_ns is None or self._now_ns < until_ns:
            if ticks % DISTANCE_TICKS == 0 and until_ns is None:
                self._measure()
            if self._drawn and ticks % DRAWN_TICKS == 0:
                self._draw()
            if self._progress is not None and ticks % PROGRESS_TICKS == 0:
                self._progress(self._seconds)
            self._advance()
            ticks += 1
            if until_ns is None and all(each.done or each.stuck for each in self._playing):
                self._measure()
                self._recorded.duration = self._seconds
                until_ns = self._now_ns + TAIL_NS
        if self._drawn:
            self._draw()
            self._recorded.surfaces = self._world.surfaces
        return self._recorded

    # the actors -----------------------------------------------------------------------------

    def _prepared(self, actor: Actor) -> _Playing:
        stream = Stream(actor.home, 0.0)
        stream.trajectory = actor.trajectory
        if actor.trajectory is not None:
            stream.arm = actor.trajectory.positions[0]
        waits = sorted(actor.waits, key=lambda wait: wait.frame)
        return _Playing(actor, stream, waits, done=actor.trajectory is None)

    def _place(self, each: _Playing) -> None:
        name, trajectory = each.actor.name, each.actor.trajectory
        still = [0.0] * len(each.stream.arm)
        self._world.joint_state(name, 0, each.stream.arm.tolist(), still)
        if trajectory is not None:
            times = tuple(f / trajectory.frame_rate for f, _ in trajectory.grasp_frames)
            closes = tuple(closed for _, closed in trajectory.grasp_frames)
            self._world.set_program(name, GripperProgram(times, closes))
            self._state(each, State.READY)

    def _feed(self, each: _Playing) -> None:
        """Send what an actor sends up to now, and let it begin, wait and end."""
        actor, stream, trajectory = each.actor, each.stream, each.actor.trajectory
        if each.done or each.stuck or trajectory is None:
            return
        before_ns = self._now_ns - TICK_NS
        if not each.begun:
            begin_ns = self._begin_ns(each)
            waited = each.waits_since_ns is not None
            if begin_ns is None or begin_ns > before_ns or self._holds(each, 0.0):
                return
            if waited:
                begin_ns = before_ns
            each.begun = True
            self._recorded.starts[actor.name] = (begin_ns - LEAD_NS) / SECOND
            self._follow(each, begin_ns, 0.0)
        elif each.waits_since_ns is not None:
            if self._holds(each, stream.position):
                return
            self._follow(each, before_ns, stream.position)
        while not each.done and each.waits_since_ns is None:
            next_ns = stream.next_ns
            if next_ns is None or next_ns > self._now_ns:
                return
            sample = stream.trajectory_sample(next_ns)
            self._world.joint_state(
                actor.name, sample.due_ns, sample.positions.tolist(), sample.velocities.tolist()
            )
            if stream.ended:
                each.done = True
                self._recorded.ends[actor.name] = (sample.due_ns - LEAD_NS) / SECOND
                stream.halt(sample.due_ns)
                self._state(each, State.COMPLETE)
            elif stream.held:
                position = sample.position
                stream.halt(sample.due_ns)
                if self._holds(each, position):
                    self._state(each, State.PAUSED)
                else:
                    self._follow(each, sample.due_ns, position)

    def _begin_ns(self, each: _Playing) -> int | None:
        """Return when an actor's turn begins; None: that is not known yet."""
        actor = each.actor
        if not actor.after:
            return LEAD_NS + round(actor.start * SECOND)
        ended = self._recorded.ends.get(actor.after)
        if ended is None:
            return None
        # A turn begins on the tick after the one before it ended.
        return max(LEAD_NS + round((ended + actor.dwell) * SECOND), self._now_ns - TICK_NS)

    def _follow(self, each: _Playing, since_ns: int, position: float) -> None:
        stream, trajectory = each.stream, each.actor.trajectory
        assert trajectory is not None
        stream.follow(since_ns, position)
        ahead = [w.frame / trajectory.frame_rate for w in each.waits]
        stream.end_at(next((at for at in ahead if at > position), None))
        self._state(each, State.PLAYING)

    def _holds(self, each: _Playing, position: float) -> bool:
        """Return whether a wait holds an actor at `position`, s; waits that are met are over."""
        trajectory = each.actor.trajectory
        assert trajectory is not None
        reached = position * trajectory.frame_rate + 1e-6
        each.waits = [w for w in each.waits if w.frame > reached or not self._is_met(w.condition)]
        if not any(w.frame <= reached for w in each.waits):
            if each.waits_since_ns is not None:
                since = (self._now_ns - each.waits_since_ns) / SECOND
                waited = self._recorded.waited
                waited[each.actor.name] = waited.get(each.actor.name, 0.0) + since
            each.waits_since_ns = None
            return False
        if each.waits_since_ns is None:
            each.waits_since_ns = self._now_ns
        others_move = any(
            not (e.done or e.stuck) and e.waits_since_ns is None
            for e in self._playing
            if e is not each
        )
        if not others_move and self._now_ns - each.waits_since_ns > STUCK_NS:
            each.stuck = True
            self._recorded.stuck[each.actor.name] = each.waits[0].text
        return True

    def _is_met(self, condition: AfterFrame | Held) -> bool:
        if isinstance(condition, Held):
            held = {o.name: o.held_by for o in self._world.objects}
            by = held.get(condition.object, "")
            return not by if condition.robot is None else by == condition.robot
        other = self._by_name.get(condition.robot)
        if other is None or other.actor.trajectory is None:
            return False
        at = condition.frame / other.actor.trajectory.frame_rate
        return other.done or (other.begun and other.stream.position >= at - 1e-6)

    def _state(self, each: _Playing, state: State) -> None:
        """Let the world know what the actor does from now on."""
        trajectory, stream = each.actor.trajectory, each.stream
        assert trajectory is not None
        clock = stream.clock
        if state is not State.PLAYING:
            clock = PlaybackClock(stream.clock.stamp_ns, stream.position, 0.0)
        self._world.playback(
            each.actor.name,
            Playing(
                state, trajectory.id, clock, stream.frame, trajectory.frame_count,
                trajectory.frame_rate, trajectory.duration, clock.stamp_ns,
            ),
        )  # fmt: skip
        if self._drawn:
            time = max((clock.stamp_ns - LEAD_NS) / SECOND, 0.0)
            self._recorded.states.setdefault(each.actor.name, []).append((time, state.name))

    # what happens ---------------------------------------------------------------------------

    @property
    def _seconds(self) -> float:
        return (self._now_ns - LEAD_NS) / SECOND

    def _advance(self) -> None:
        self._now_ns += TICK_NS
        for each in self._playing:
            self._feed(each)
        self._world.advance(self._now_ns)
        self._note()

    def _time(self, robot: str, stamp_ns: int) -> float:
        """Return when something of a robot's motion happened, s: slow streams are shown late."""
        delay_ns = self._world.robot(robot).stream.delay_ns
        return max((stamp_ns - delay_ns - LEAD_NS) / SECOND, 0.0)

    def _said(self, robot: str) -> str:
        """Return the code of what was said last of a robot's gripper."""
        changes = reversed(self._recorded.grasps)
        last = next((change.reason for change in changes if change.robot == robot), None)
        return last.code if last is not None else ""

    def _note(self) -> None:
        """Record what happened in the world since the last call."""
        for event in self._world.take_events():
            if isinstance(event, LoadChanged):
                event = event.grasp
                # Its figures may vary all the time.
                if event.reason is None or event.reason.code == self._said(event.robot):
                    continue
            if isinstance(event, GraspChanged):
                self._recorded.grasps.append(
                    GraspChange(
                        self._time(event.robot, event.stamp_ns), event.robot, event.state,
                        event.object, event.reason, event.load,
                    )
                )  # fmt: skip
                self._let_go(event)
            elif isinstance(event, ObjectRemoved):
                self._recorded.gone.append((max(self._seconds, 0.0), event.name))
            elif isinstance(event, CollisionChanged) and event.contact is not None:
                touch = event.contact.touch
                self._by_name[event.robot].known.add((touch.kind, touch.other))
                self._collide(event.robot, event.stamp_ns, touch)
            elif isinstance(event, CollisionChanged):
                self._by_name[event.robot].known.clear()
                for one in self._recorded.of(event.robot):
                    if one.end is None:
                        one.end = self._time(event.robot, event.stamp_ns)
        self._watch_falling()
        contacts = self._world.take_contacts()
        for each in self._playing:
            self._note_others(each, contacts)

    def _let_go(self, event: GraspChanged) -> None:
        """Begin to watch an object that a gripper opened on."""
        thing = self._held.pop(event.robot, "")
        if event.object:
            self._held[event.robot] = event.object
        elif thing and event.state is Grasp.OPEN and thing in self._names():
            drop = Drop(self._time(event.robot, event.stamp_ns), event.robot, thing)
            self._recorded.drops.append(drop)
            height = self._world.motion(thing).pose.position[2]
            self._falling[thing] = (drop, height, event.stamp_ns + FALLS_NS)

    def _names(self) -> set[str]:
        return {thing.name for thing in self._world.objects}

    def _watch_falling(self) -> None:
        """Record how far what was let go has fallen, until it is held again or time is over."""
        for thing, (drop, height, until_ns) in list(self._falling.items()):
            gone = thing not in self._names() or self._world.object(thing).held_by
            if gone or self._now_ns > until_ns:
                del self._falling[thing]
            else:
                fallen = height - self._world.motion(thing).pose.position[2]
                drop.height = max(drop.height, fallen)

    def _note_others(self, each: _Playing, contacts: Sequence[Contact]) -> None:
        """Record what else a robot touches during a collision, which is announced once."""
        name = each.actor.name
        new = self._world.robot(name).partners - each.known
        for kind, other in sorted(new, key=lambda p: (p[0].value, p[1])):
            of = [c for c in contacts if c.robot == name]
            of = [c for c in of if (c.touch.kind, c.touch.other) == (kind, other)]
            if of:
                each.known.add((kind, other))
                deepest = max(of, key=lambda c: c.touch.depth)
                self._collide(name, deepest.stamp_ns, deepest.touch)

    def _collide(self, robot: str, stamp_ns: int, touch: Touch) -> None:
        self._recorded.collisions.append(
            Collision(
                self._time(robot, stamp_ns), robot, touch.link, touch.kind, touch.other,
                touch.other_link, touch.point, touch.depth, touch.held,
            )
        )  # fmt: skip

    # distances and courses ------------------------------------------------------------------

    def _measure(self) -> None:
        """Record how far each robot that has a motion is from everything else."""
        self._recorded.times.append(self._seconds)
        others = [(Kind.OBJECT, thing.name) for thing in self._world.objects]
        others += [(Kind.SURFACE, surface.name) for surface in self._world.surfaces]
        held = {thing.name for thing in self._world.objects if thing.held_by}
        for i, each in enumerate(self._playing):
            name = each.actor.name
            robots = [(Kind.ROBOT, e.actor.name) for e in self._playing[i + 1 :]]
            if each.actor.trajectory is None:
                # A robot that stands is far from what moves; of two that stand nothing changes.
                robots = [r for r in robots if self._by_name[r[1]].actor.trajectory is not None]
            for other in robots if each.actor.trajectory is None else [*others, *robots]:
                without = (
                    frozenset({each.actor.first_link})
                    if other[0] is Kind.SURFACE
                    else frozenset[str]()
                )
                mine = other[1] in held and self._world.object(other[1]).held_by == name
                near = None if mine else self._engine.nearest(name, *other, FARTHEST, without)
                series = self._recorded.distances.setdefault((name, other), Distances())
                # Later obstacles were far before, and held objects are none.
                missing = len(self._recorded.times) - 1 - len(series.values)
                series.add_far(missing, FARTHEST)
                if near is None:
                    series.add_far(1, FARTHEST)
                else:
                    series.add(near)
                    if near.held:
                        alone = without | {near.held}
                        series.arm[len(series.values) - 1] = self._engine.nearest(
                            name, *other, FARTHEST, alone
                        )

    def _draw(self) -> None:
        time = max(self._seconds, 0.0)
        for each in self._playing:
            name = each.actor.name
            placed = self._world.robot(name).placed
            if placed is not None:
                fingers = self._world.fingers(name).values()
                course = self._recorded.robots.setdefault(name, Course())
                course.add(time, [*placed, *fingers])
        for thing in self._world.objects:
            pose = self._world.motion(thing.name).pose
            course = self._recorded.objects.setdefault(thing.name, Course())
            course.add(time, [*pose.position, *pose.orientation])
            if not course.holders or course.holders[-1][1] != thing.held_by:
                course.holders.append((time, thing.held_by))
