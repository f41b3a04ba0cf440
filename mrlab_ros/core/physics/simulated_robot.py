"""State of one simulated robot: motion, gripper, collision and playback."""

from __future__ import annotations

import bisect
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from operator import mul, sub

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Pose, Vector
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.physics.clearance import Clearance
from mrlab_ros.core.physics.engine import Arm, Kind, Touch
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.load import Grip, Load, Tool
from mrlab_ros.core.physics.grasp.states import TABLE, Grasp, GraspEvent, StallWatch
from mrlab_ros.core.physics.joint_stream import Joints, JointStream
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.snapshots import Snapshot, Snapshots
from mrlab_ros.core.playback.states import MOVING, State

# In these states the trajectory commands the gripper; in the others the gripper keeps its state.
COMMANDING = (State.PLAYING, State.PAUSED, State.COLLISION_HALT)
# Loads and reasons announced in a second while the gripper's state stays, at most.
REMARKS = 2
# Deviation of the clock of a playback that was not sought, s.
SEEK_TOLERANCE = 0.03


@dataclass(frozen=True)
class Playing:
    """A playback state of a robot; see mrlab_msgs/PlaybackState.

    stamp_ns: it applies from then on. left: the position, s, at which its trajectory stopped to
    command the gripper; None: it commands it, or has not yet. after() sets it.
    """

    state: State = State.IDLE
    trajectory_id: str = ""
    clock: PlaybackClock = field(default_factory=PlaybackClock)
    frame: int = 0
    frame_count: int = 0
    frame_rate: float = 0.0
    duration: float = 0.0
    stamp_ns: int = 0
    left: float | None = None

    def after(self, before: Playing) -> Playing:
        """Return this state with what it has from the one `before` it."""
        same = self.trajectory_id == before.trajectory_id
        if not same or self.state in COMMANDING or self.left is not None:
            return self
        left = before.position(self.stamp_ns) if before.state in COMMANDING else before.left
        return replace(self, left=left)

    def position(self, now_ns: int) -> float:
        """Return the position on the trajectory, s."""
        return min(max(self.clock.at(now_ns), 0.0), self.duration)

    def frame_at(self, now_ns: int) -> int:
        """Return the source frame reached."""
        if self.state is not State.PLAYING:
            return self.frame
        frame = int(self.position(now_ns) * self.frame_rate + 1e-6)
        return min(frame, max(self.frame_count - 1, 0))

    def sought(self, new: Playing) -> bool:
        """Return whether `new` has another position than undisturbed playback would have."""
        if new.trajectory_id != self.trajectory_id or new.state not in COMMANDING:
            return False
        way = new.clock.position - self.position(new.clock.stamp_ns)
        if self.state is State.PLAYING and new.state is not State.PLAYING and self.frame_rate:
            # An arm stops at its last joint state, up to one step behind its clock.
            step = self.clock.rate / self.frame_rate
            way -= min(max(way, min(-step, 0.0)), max(-step, 0.0))
        return abs(way) > SEEK_TOLERANCE


@dataclass(frozen=True)
class GripperProgram:
    """When a trajectory opens and closes the gripper: times in s, ascending.

    places: T_base_tool0 at these times; empty: not known.
    """

    times: tuple[float, ...] = ()
    closes: tuple[bool, ...] = ()
    places: tuple[Pose, ...] = ()

    def closed_at(self, position: float) -> bool | None:
        """Return whether the gripper is closed at `position`, s; None without a gripper."""
        if not self.times:
            return None
        i = bisect.bisect_right(self.times, position + 1e-6)
        return self.closes[i - 1] if i else not self.closes[0]

    def opening(self, position: float) -> int | None:
        """Return the number of the opening that counts at `position`, s; None: none was yet."""
        i = bisect.bisect_right(self.times, position + 1e-6)
        return i - 1 if i and not self.closes[i - 1] else None


@dataclass(frozen=True)
class Pressed:
    """How far, m, what is held has moved into something, and when it last touched it.

    depth: m, by which they overlapped when it was grasped: a cup presses on what it takes.
    """

    seen_ns: int
    way: float
    depth: float = 0.0


@dataclass(eq=False)
class Held:
    """How a robot holds its object.

    in_hand: T_hand_object. grip: None where it was attached by service, and never slips. reach:
    m, from the hand to its furthest point. poses: of the object, at the last looks at its load
    since a jump. slip_speed: m/s; slid: m in the hand. lifted: it has left what it
    stood on.
    """

    in_hand: Pose
    grip: Grip | None
    reach: float
    poses: deque[Pose] = field(default_factory=lambda: deque(maxlen=3))
    load: Load | None = None
    slip_speed: float = 0.0
    slid: float = 0.0
    lifted: bool = False


@dataclass(eq=False)
class Gripped:
    """A closed hand about an object that another robot holds too.

    in_hand: T_hand_object when that robot took it. grip: as it held it then. slid: m, how far the
    object has been pulled through it since, at the grip and in the frame of the hand; strain: m,
    how far against its fingers.
    """

    object: str
    in_hand: Pose
    grip: Grip
    slid: Vector = (0.0, 0.0, 0.0)
    strain: float = 0.0


@dataclass(eq=False)
class Robot:
    """The state of one robot. joints: names in order of its joint states."""

    name: str
    joints: tuple[str, ...]
    pose: Pose
    arm: Arm
    gripper: Gripper
    settings: Settings
    tool: Tool = field(default_factory=Tool)
    stream: JointStream = field(init=False)
    clearance: Clearance = field(init=False)
    watch: StallWatch = field(init=False)
    snapshots: Snapshots = field(init=False)
    playing: Playing = field(default_factory=Playing)
    # Playback states received but not yet due.
    queued: deque[Playing] = field(default_factory=deque)
    program: GripperProgram = field(default_factory=GripperProgram)
    # Joint positions of the arm; None before its first joint state.
    placed: Joints | None = None
    partners: set[tuple[Kind, str]] = field(default_factory=set)
    tolerated: set[str] = field(default_factory=set)
    touches: list[Touch] = field(default_factory=list)
    raise_again: bool = False
    # The halt began in another world, before a restart: what the arm hit there is not known.
    inherited: bool = False
    # Speed of the arm's fastest point as a share of its speed at full stretch, and the joint
    # velocities for which it was computed.
    share: float = 1.0
    share_of: Joints | None = None
    closed: bool = False
    closing_since_ns: int = 0
    # A gripper that closes as its motion goes on may take over what another robot holds.
    takes_over: bool = True
    held: str = ""
    held_since_ns: int = 0
    # The object that was taken from the closed gripper; empty after the next gripper command.
    lost: str = ""
    holding: Held | None = None
    # How it gripped what another robot took over, until it opens or that is torn from it.
    still_grips: Gripped | None = None
    # Objects just released, between the fingers until these have left them.
    leaving: set[str] = field(default_factory=set)
    # Objects that it pressed into something else: it passes into them until it has left them.
    passing: set[str] = field(default_factory=set)
    # By kind, name and link: what the held object presses on.
    pressed: dict[tuple[Kind, str, str], Pressed] = field(default_factory=dict)
    # A remark on the gripper; None: nothing.
    reason: Diagnostic | None = None
    # The load that was announced last.
    told: Load | None = None
    # When a load or a reason was announced while the state stayed: the last REMARKS times.
    remarked_ns: deque[int] = field(default_factory=lambda: deque(maxlen=REMARKS))
    pending: tuple[int, Snapshot] | None = None

    def __post_init__(self) -> None:
        self._grasp = Machine(TABLE)
        s = self.settings
        self.stream = JointStream(
            len(self.joints), round(s.max_silence * SECOND), round(s.max_catch_up * SECOND)
        )
        self.clearance = Clearance(s.clear_margin, round(s.clear_time * SECOND))
        self.watch = StallWatch(
            self.arm.fingers, self.arm.grip_links, s.stall_share, round(s.stall_time * SECOND)
        )
        self.snapshots = Snapshots(s.snapshot_rate, s.snapshot_count)
        self.finger_links = frozenset(f.link for f in self.arm.fingers)

    @property
    def in_hand(self) -> Pose | None:
        """The pose of what it holds in the frame of its hand; None: it holds nothing."""
        return self.holding.in_hand if self.holding is not None else None

    @property
    def tool_link(self) -> str:
        """The link that is its tool's frame."""
        return self.tool.tip or self.arm.tool

    @property
    def payload(self) -> float:
        """Return the payload beside its end effector, kg; 0: not stated."""
        return max(self.tool.payload - self.arm.tool_mass, 0.0)

    def queue(self, playing: Playing) -> None:
        """Queue a playback state; apply_due() applies it from its stamp on."""
        before = self.queued[-1] if self.queued else self.playing
        self.queued.append(playing.after(before))
        self._update_stream()

    def apply_due(self, shown_ns: int | None) -> Iterator[Playing]:
        """Apply queued states up to `shown_ns` (None: all); yield each state that was replaced."""
        while self.queued and (shown_ns is None or self.queued[0].stamp_ns <= shown_ns):
            before, self.playing = self.playing, self.queued.popleft()
            self._update_stream()
            if self.playing.state in MOVING and before.state not in MOVING:
                self.raise_again = True
            if self.playing.state is State.COLLISION_HALT and self.clearance.touched():
                # Physics restarted during a halt: announce the collision again so that its end
                # is announced too.
                self.raise_again = self.inherited = True
                # The arm stands in the obstacle that halted it.
                self.tolerated.clear()
            yield before

    def _update_stream(self) -> None:
        newest = self.queued[-1] if self.queued else self.playing
        self.stream.plays(
            self.playing.clock.stamp_ns if self.playing.state in MOVING else None,
            None if newest.state in MOVING else newest.stamp_ns,
        )

    def reach(self, end: Joints, start: Joints | None = None) -> float:
        """Return an upper bound of the travel, m, of the arm and of what it holds, from `start`
        (None: zeros) to `end`."""
        ways = list(map(abs, end if start is None else map(sub, end, start)))
        reach: float = sum(map(mul, ways, self.arm.levers))
        if self.holding is not None:
            reach += sum(ways) * self.holding.reach
        return reach

    def commanded_at(self, now_ns: int) -> float | None:
        """Return the position, s, whose command its gripper has at the world's time `now_ns`.

        None: no trajectory has commanded it.
        """
        if self.playing.state in COMMANDING:
            return self.playing.position(self.stream.shown_ns(now_ns))
        return self.playing.left

    def opening(self, now_ns: int) -> int | None:
        """Return which opening of its program counts at `now_ns`; None: none does."""
        position = self.commanded_at(now_ns)
        return None if position is None else self.program.opening(position)

    @property
    def grasp(self) -> Grasp:
        """The state of the gripper."""
        return self._grasp.state

    def fire(self, event: GraspEvent) -> bool:
        """Fire an event of the gripper; return whether its state changed."""
        before = self._grasp.state
        return self._grasp.fire(event) is not before

    def quiet(self, now_ns: int) -> bool:
        """Return whether no load or reason was announced for a while, the state apart."""
        return not self.remarked_ns or now_ns - self.remarked_ns[-1] >= SECOND // REMARKS

    def may_remark(self, now_ns: int) -> bool:
        """Return whether a load or a reason may be announced while the state stays, and count it:
        REMARKS a second at most."""
        full = len(self.remarked_ns) == REMARKS
        if full and now_ns - self.remarked_ns[0] < SECOND:
            return False
        self.remarked_ns.append(now_ns)
        return True

    def finger_velocities(self) -> list[float]:
        """Return the commanded finger velocities: closing, opening, or 0 around a held object."""
        if self.grasp is Grasp.HOLDING:
            return [0.0] * len(self.arm.fingers)
        way = 1.0 if self.closed else -1.0
        return [way * finger.closes * finger.max_velocity for finger in self.arm.fingers]
