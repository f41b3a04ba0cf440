# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import diagnostic_msgs.msg
import geometry_msgs.msg
import shape_msgs.msg
import std_msgs.msg
from typing import ClassVar
from message_bases import Numbers
from message_bases import NumbersField

class Candidate:
    variable: str
    rows: int
    columns: int
    minimum: float
    maximum: float
    score: float
    reasons: list[Diagnostic]
    preview: Preview
    def __init__(self, *, variable: str = ..., rows: int = ..., columns: int = ..., minimum: float = ..., maximum: float = ..., score: float = ..., reasons: Sequence[Diagnostic] = ..., preview: Preview = ...) -> None: ...

class Collision:
    header: std_msgs.msg.Header
    colliding: bool
    contact: Contact
    clearance: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., colliding: bool = ..., contact: Contact = ..., clearance: float = ...) -> None: ...

class Contact:
    OBJECT: ClassVar[int]
    ROBOT: ClassVar[int]
    SELF: ClassVar[int]
    SURFACE: ClassVar[int]
    stamp: builtin_interfaces.msg.Time
    robot: str
    link: str
    held: str
    kind: int
    other: str
    other_link: str
    point: geometry_msgs.msg.Point
    normal: geometry_msgs.msg.Vector3
    depth: float
    impulse: float
    frame: int
    def __init__(self, *, stamp: builtin_interfaces.msg.Time = ..., robot: str = ..., link: str = ..., held: str = ..., kind: int = ..., other: str = ..., other_link: str = ..., point: geometry_msgs.msg.Point = ..., normal: geometry_msgs.msg.Vector3 = ..., depth: float = ..., impulse: float = ..., frame: int = ...) -> None: ...

class Contacts:
    header: std_msgs.msg.Header
    contacts: list[Contact]
    def __init__(self, *, header: std_msgs.msg.Header = ..., contacts: Sequence[Contact] = ...) -> None: ...

class Diagnostic:
    ERROR: ClassVar[int]
    INFO: ClassVar[int]
    WARNING: ClassVar[int]
    severity: int
    code: str
    message: str
    remedy: str
    variable: str
    where: str
    first_row: int
    last_row: int
    joint: str
    value: float
    limit: float
    unit: str
    values: list[diagnostic_msgs.msg.KeyValue]
    fixes: list[Fix]
    def __init__(self, *, severity: int = ..., code: str = ..., message: str = ..., remedy: str = ..., variable: str = ..., where: str = ..., first_row: int = ..., last_row: int = ..., joint: str = ..., value: float = ..., limit: float = ..., unit: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., fixes: Sequence[Fix] = ...) -> None: ...

class DriveOrder:
    CLAIM: ClassVar[int]
    HOLD: ClassVar[int]
    PAUSE: ClassVar[int]
    PLAY: ClassVar[int]
    RELEASE: ClassVar[int]
    SEEK: ClassVar[int]
    SET_RATE: ClassVar[int]
    STAGE: ClassVar[int]
    STOP: ClassVar[int]
    robot: str
    command: int
    stamp: builtin_interfaces.msg.Time
    position: float
    rate: float
    until: float
    def __init__(self, *, robot: str = ..., command: int = ..., stamp: builtin_interfaces.msg.Time = ..., position: float = ..., rate: float = ..., until: float = ...) -> None: ...

class DriveReply:
    robot: str
    state: int
    position: float
    duration: float
    trajectory_id: str
    trajectory_duration: float
    frame_rate: float
    def __init__(self, *, robot: str = ..., state: int = ..., position: float = ..., duration: float = ..., trajectory_id: str = ..., trajectory_duration: float = ..., frame_rate: float = ...) -> None: ...

class Fix:
    option: str
    value: str
    matlab: str
    command: str
    def __init__(self, *, option: str = ..., value: str = ..., matlab: str = ..., command: str = ...) -> None: ...

class Grasp:
    CLOSING: ClassVar[int]
    EMPTY: ClassVar[int]
    HOLDING: ClassVar[int]
    OPEN: ClassVar[int]
    header: std_msgs.msg.Header
    state: int
    object: str
    fingers: list[str]
    finger_positions: NumbersField[float]
    finger_forces: NumbersField[float]
    reason: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    severity: int
    mass: float
    payload: float
    friction: float
    friction_needed: float
    slip_margin: float
    wrist_moment: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., state: int = ..., object: str = ..., fingers: Sequence[str] = ..., finger_positions: Numbers[float] = ..., finger_forces: Numbers[float] = ..., reason: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., severity: int = ..., mass: float = ..., payload: float = ..., friction: float = ..., friction_needed: float = ..., slip_margin: float = ..., wrist_moment: float = ...) -> None: ...

class GraspTarget:
    frame: int
    time: float
    close: bool
    tool0: geometry_msgs.msg.Pose
    def __init__(self, *, frame: int = ..., time: float = ..., close: bool = ..., tool0: geometry_msgs.msg.Pose = ...) -> None: ...

class GraspTargets:
    header: std_msgs.msg.Header
    trajectory_id: str
    targets: list[GraspTarget]
    def __init__(self, *, header: std_msgs.msg.Header = ..., trajectory_id: str = ..., targets: Sequence[GraspTarget] = ...) -> None: ...

class LabProcess:
    FROZEN: ClassVar[int]
    REFUSED: ClassVar[int]
    RUNNING: ClassVar[int]
    STARTING: ClassVar[int]
    STOPPED: ClassVar[int]
    WAITING: ClassVar[int]
    name: str
    nodes: list[str]
    state: int
    since: builtin_interfaces.msg.Time
    restarts: int
    exit_code: int
    last_exit: str
    down: builtin_interfaces.msg.Time
    down_steady_ns: int
    restart_in: float
    def __init__(self, *, name: str = ..., nodes: Sequence[str] = ..., state: int = ..., since: builtin_interfaces.msg.Time = ..., restarts: int = ..., exit_code: int = ..., last_exit: str = ..., down: builtin_interfaces.msg.Time = ..., down_steady_ns: int = ..., restart_in: float = ...) -> None: ...

class LabProcesses:
    header: std_msgs.msg.Header
    processes: list[LabProcess]
    lab: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., processes: Sequence[LabProcess] = ..., lab: str = ...) -> None: ...

class Latency:
    header: std_msgs.msg.Header
    observer: str
    window: float
    clock_error: float
    hops: list[LatencyHop]
    def __init__(self, *, header: std_msgs.msg.Header = ..., observer: str = ..., window: float = ..., clock_error: float = ..., hops: Sequence[LatencyHop] = ...) -> None: ...

class LatencyHop:
    BRIDGED_TO_RECEIVED: ClassVar[int]
    PUBLISHED_TO_BRIDGED: ClassVar[int]
    PUBLISHED_TO_RECEIVED: ClassVar[int]
    hop: int
    topic: str
    count: int
    p50: float
    p95: float
    max: float
    def __init__(self, *, hop: int = ..., topic: str = ..., count: int = ..., p50: float = ..., p95: float = ..., max: float = ...) -> None: ...

class LookHere:
    header: std_msgs.msg.Header
    name: str
    point: geometry_msgs.msg.Point
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: str = ..., point: geometry_msgs.msg.Point = ...) -> None: ...

class Move:
    hand: str
    sequence: int
    object: str
    robot: str
    pose: geometry_msgs.msg.Pose
    def __init__(self, *, hand: str = ..., sequence: int = ..., object: str = ..., robot: str = ..., pose: geometry_msgs.msg.Pose = ...) -> None: ...

class ObjectPlacement:
    name: str
    type: str
    pose: geometry_msgs.msg.Pose
    automatic: bool
    held_by: str
    in_hand: geometry_msgs.msg.Pose
    def __init__(self, *, name: str = ..., type: str = ..., pose: geometry_msgs.msg.Pose = ..., automatic: bool = ..., held_by: str = ..., in_hand: geometry_msgs.msg.Pose = ...) -> None: ...

class ObjectRemoved:
    header: std_msgs.msg.Header
    name: str
    type: str
    reason: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: str = ..., type: str = ..., reason: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class ObjectType:
    id: str
    about: str
    size: geometry_msgs.msg.Vector3
    mass: float
    color: std_msgs.msg.ColorRGBA
    mesh: str
    primitive: shape_msgs.msg.SolidPrimitive
    def __init__(self, *, id: str = ..., about: str = ..., size: geometry_msgs.msg.Vector3 = ..., mass: float = ..., color: std_msgs.msg.ColorRGBA = ..., mesh: str = ..., primitive: shape_msgs.msg.SolidPrimitive = ...) -> None: ...

class Overlap:
    robot: str
    surface: str
    label: str
    def __init__(self, *, robot: str = ..., surface: str = ..., label: str = ...) -> None: ...

class Overlaps:
    header: std_msgs.msg.Header
    overlaps: list[Overlap]
    def __init__(self, *, header: std_msgs.msg.Header = ..., overlaps: Sequence[Overlap] = ...) -> None: ...

class Place:
    header: std_msgs.msg.Header
    id: str
    name: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: str = ..., name: str = ...) -> None: ...

class PlaybackClock:
    stamp: builtin_interfaces.msg.Time
    position: float
    rate: float
    def __init__(self, *, stamp: builtin_interfaces.msg.Time = ..., position: float = ..., rate: float = ...) -> None: ...

class PlaybackState:
    ADJUSTING: ClassVar[int]
    COLLISION_HALT: ClassVar[int]
    COMPLETE: ClassVar[int]
    IDLE: ClassVar[int]
    PAUSED: ClassVar[int]
    PLAYING: ClassVar[int]
    READY: ClassVar[int]
    header: std_msgs.msg.Header
    state: int
    label: str
    message: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    trajectory_id: str
    trajectory_version: int
    clock: PlaybackClock
    frame: int
    frame_count: int
    frame_rate: float
    duration: float
    rate: float
    loop: bool
    host: str
    system: str
    lab: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., state: int = ..., label: str = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., trajectory_id: str = ..., trajectory_version: int = ..., clock: PlaybackClock = ..., frame: int = ..., frame_count: int = ..., frame_rate: float = ..., duration: float = ..., rate: float = ..., loop: bool = ..., host: str = ..., system: str = ..., lab: str = ...) -> None: ...

class Presence:
    DRIVES: ClassVar[int]
    TEACHES: ClassVar[int]
    WATCHES: ClassVar[int]
    header: std_msgs.msg.Header
    id: str
    name: str
    part: int
    head: geometry_msgs.msg.Pose
    has_left: bool
    left: geometry_msgs.msg.Pose
    has_right: bool
    right: geometry_msgs.msg.Pose
    away: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: str = ..., name: str = ..., part: int = ..., head: geometry_msgs.msg.Pose = ..., has_left: bool = ..., left: geometry_msgs.msg.Pose = ..., has_right: bool = ..., right: geometry_msgs.msg.Pose = ..., away: bool = ...) -> None: ...

class Preview:
    variable: str
    rows: NumbersField[int]
    columns: int
    values: NumbersField[float]
    def __init__(self, *, variable: str = ..., rows: Numbers[int] = ..., columns: int = ..., values: Numbers[float] = ...) -> None: ...

class RecorderState:
    PAUSED: ClassVar[int]
    RECORDING: ClassVar[int]
    REPLAYING: ClassVar[int]
    STOPPED: ClassVar[int]
    header: std_msgs.msg.Header
    state: int
    bag: str
    position: float
    duration: float
    rate: float
    messages: int
    bytes: int
    message: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., state: int = ..., bag: str = ..., position: float = ..., duration: float = ..., rate: float = ..., messages: int = ..., bytes: int = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class Robot:
    name: str
    model: str
    end_effector: str
    pose: geometry_msgs.msg.Pose
    joint_names: list[str]
    def __init__(self, *, name: str = ..., model: str = ..., end_effector: str = ..., pose: geometry_msgs.msg.Pose = ..., joint_names: Sequence[str] = ...) -> None: ...

class RobotSystem:
    COLLISION_HALT: ClassVar[int]
    COMPLETE: ClassVar[int]
    HALT_ALL: ClassVar[int]
    HALT_MEMBER: ClassVar[int]
    PARALLEL: ClassVar[int]
    PAUSED: ClassVar[int]
    PLAYING: ClassVar[int]
    READY: ClassVar[int]
    SEQUENTIAL: ClassVar[int]
    STAGING: ClassVar[int]
    STOPPING: ClassVar[int]
    name: str
    members: list[SystemMember]
    mode: int
    policy: int
    state: int
    label: str
    message: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    clock: PlaybackClock
    duration: float
    rate: float
    loop: bool
    def __init__(self, *, name: str = ..., members: Sequence[SystemMember] = ..., mode: int = ..., policy: int = ..., state: int = ..., label: str = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., clock: PlaybackClock = ..., duration: float = ..., rate: float = ..., loop: bool = ...) -> None: ...

class RobotSystems:
    header: std_msgs.msg.Header
    systems: list[RobotSystem]
    lab: str
    holder: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., systems: Sequence[RobotSystem] = ..., lab: str = ..., holder: str = ...) -> None: ...

class Robots:
    header: std_msgs.msg.Header
    robots: list[Robot]
    lab: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., robots: Sequence[Robot] = ..., lab: str = ...) -> None: ...

class SceneObject:
    name: str
    type: str
    pose: geometry_msgs.msg.Pose
    twist: geometry_msgs.msg.Twist
    size: geometry_msgs.msg.Vector3
    mass: float
    color: std_msgs.msg.ColorRGBA
    mesh: str
    primitive: shape_msgs.msg.SolidPrimitive
    held_by: str
    in_tool: geometry_msgs.msg.Pose
    def __init__(self, *, name: str = ..., type: str = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., size: geometry_msgs.msg.Vector3 = ..., mass: float = ..., color: std_msgs.msg.ColorRGBA = ..., mesh: str = ..., primitive: shape_msgs.msg.SolidPrimitive = ..., held_by: str = ..., in_tool: geometry_msgs.msg.Pose = ...) -> None: ...

class SceneObjects:
    header: std_msgs.msg.Header
    objects: list[SceneObject]
    def __init__(self, *, header: std_msgs.msg.Header = ..., objects: Sequence[SceneObject] = ...) -> None: ...

class Surface:
    name: str
    label: str
    source: str
    pose: geometry_msgs.msg.Pose
    vertices: list[geometry_msgs.msg.Point]
    triangles: NumbersField[int]
    def __init__(self, *, name: str = ..., label: str = ..., source: str = ..., pose: geometry_msgs.msg.Pose = ..., vertices: Sequence[geometry_msgs.msg.Point] = ..., triangles: Numbers[int] = ...) -> None: ...

class Surfaces:
    header: std_msgs.msg.Header
    surfaces: list[Surface]
    def __init__(self, *, header: std_msgs.msg.Header = ..., surfaces: Sequence[Surface] = ...) -> None: ...

class SystemMember:
    robot: str
    trajectory_id: str
    start: float
    duration: float
    dwell: float
    state: int
    position: float
    waits: list[str]
    waiting_for: str
    def __init__(self, *, robot: str = ..., trajectory_id: str = ..., start: float = ..., duration: float = ..., dwell: float = ..., state: int = ..., position: float = ..., waits: Sequence[str] = ..., waiting_for: str = ...) -> None: ...

class Telemetry:
    header: std_msgs.msg.Header
    joint_names: list[str]
    velocities: NumbersField[float]
    effort_proxy: NumbersField[float]
    frame: int
    position: float
    has_gripper: bool
    gripper_closed: bool
    tool0: geometry_msgs.msg.Pose
    held_object: str
    held_mass: float
    payload: float
    slip_margin: float
    wrist_moment: float
    deadline_error: float
    deadline_error_max: float
    frames_sent: int
    frames_lost: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: Sequence[str] = ..., velocities: Numbers[float] = ..., effort_proxy: Numbers[float] = ..., frame: int = ..., position: float = ..., has_gripper: bool = ..., gripper_closed: bool = ..., tool0: geometry_msgs.msg.Pose = ..., held_object: str = ..., held_mass: float = ..., payload: float = ..., slip_margin: float = ..., wrist_moment: float = ..., deadline_error: float = ..., deadline_error_max: float = ..., frames_sent: int = ..., frames_lost: int = ...) -> None: ...

class Trajectory:
    info: TrajectoryInfo
    joint_names: list[str]
    positions: NumbersField[float]
    velocities: NumbersField[float]
    effort_proxy: NumbersField[float]
    gripper: NumbersField[int]
    def __init__(self, *, info: TrajectoryInfo = ..., joint_names: Sequence[str] = ..., positions: Numbers[float] = ..., velocities: Numbers[float] = ..., effort_proxy: Numbers[float] = ..., gripper: Numbers[int] = ...) -> None: ...

class TrajectoryCatalogue:
    trajectories: list[TrajectoryInfo]
    total: int
    def __init__(self, *, trajectories: Sequence[TrajectoryInfo] = ..., total: int = ...) -> None: ...

class TrajectoryInfo:
    id: str
    robot_model: str
    end_effector: str
    source_file: str
    source_variable: str
    source_sha256: str
    created: builtin_interfaces.msg.Time
    frame_rate: float
    frame_count: int
    duration: float
    has_gripper: bool
    owner: str
    version: int
    shared: bool
    warnings: list[Diagnostic]
    def __init__(self, *, id: str = ..., robot_model: str = ..., end_effector: str = ..., source_file: str = ..., source_variable: str = ..., source_sha256: str = ..., created: builtin_interfaces.msg.Time = ..., frame_rate: float = ..., frame_count: int = ..., duration: float = ..., has_gripper: bool = ..., owner: str = ..., version: int = ..., shared: bool = ..., warnings: Sequence[Diagnostic] = ...) -> None: ...

class Undoable:
    header: std_msgs.msg.Header
    id: str
    until: builtin_interfaces.msg.Time
    message: str
    code: str
    values: list[diagnostic_msgs.msg.KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: str = ..., until: builtin_interfaces.msg.Time = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...
