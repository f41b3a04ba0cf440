# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import diagnostic_msgs.msg
import geometry_msgs.msg
import mrlab_msgs.msg
from typing import ClassVar
from message_bases import Numbers
from message_bases import NumbersField
from message_bases import Service

class Attach(Service[Attach.Request, Attach.Response]):
    class Request:
        robot: str
        object: str
        def __init__(self, *, robot: str = ..., object: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class CommandMembers(Service[CommandMembers.Request, CommandMembers.Response]):
    class Request:
        system: str
        orders: list[mrlab_msgs.msg.DriveOrder]
        def __init__(self, *, system: str = ..., orders: Sequence[mrlab_msgs.msg.DriveOrder] = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        stamp: builtin_interfaces.msg.Time
        replies: list[mrlab_msgs.msg.DriveReply]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., stamp: builtin_interfaces.msg.Time = ..., replies: Sequence[mrlab_msgs.msg.DriveReply] = ...) -> None: ...

class ConvertTrajectory(Service[ConvertTrajectory.Request, ConvertTrajectory.Response]):
    class Request:
        path: str
        upload: str
        data: NumbersField[int]
        file_name: str
        robot_model: str
        end_effector: str
        frame_rate: float
        variable: str
        columns: str
        transpose: bool
        degrees: bool
        unwrap: bool
        resample: bool
        join: str
        gripper: str
        invert: bool
        units: str
        id: str
        owner: str
        draft: str
        shared: bool
        def __init__(self, *, path: str = ..., upload: str = ..., data: Numbers[int] = ..., file_name: str = ..., robot_model: str = ..., end_effector: str = ..., frame_rate: float = ..., variable: str = ..., columns: str = ..., transpose: bool = ..., degrees: bool = ..., unwrap: bool = ..., resample: bool = ..., join: str = ..., gripper: str = ..., invert: bool = ..., units: str = ..., id: str = ..., owner: str = ..., draft: str = ..., shared: bool = ...) -> None: ...
    class Response:
        ACCEPTED: ClassVar[int]
        AMBIGUOUS: ClassVar[int]
        REJECTED: ClassVar[int]
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        outcome: int
        trajectory: mrlab_msgs.msg.TrajectoryInfo
        candidates: list[mrlab_msgs.msg.Candidate]
        diagnostics: list[mrlab_msgs.msg.Diagnostic]
        preview: mrlab_msgs.msg.Preview
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., outcome: int = ..., trajectory: mrlab_msgs.msg.TrajectoryInfo = ..., candidates: Sequence[mrlab_msgs.msg.Candidate] = ..., diagnostics: Sequence[mrlab_msgs.msg.Diagnostic] = ..., preview: mrlab_msgs.msg.Preview = ...) -> None: ...

class CreateSystem(Service[CreateSystem.Request, CreateSystem.Response]):
    class Request:
        name: str
        members: list[mrlab_msgs.msg.SystemMember]
        mode: int
        policy: int
        loop: bool
        def __init__(self, *, name: str = ..., members: Sequence[mrlab_msgs.msg.SystemMember] = ..., mode: int = ..., policy: int = ..., loop: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        system: mrlab_msgs.msg.RobotSystem
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., system: mrlab_msgs.msg.RobotSystem = ...) -> None: ...

class Detach(Service[Detach.Request, Detach.Response]):
    class Request:
        robot: str
        def __init__(self, *, robot: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class GetObjects(Service[GetObjects.Request, GetObjects.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        objects: list[mrlab_msgs.msg.ObjectPlacement]
        surfaces: list[mrlab_msgs.msg.Surface]
        def __init__(self, *, objects: Sequence[mrlab_msgs.msg.ObjectPlacement] = ..., surfaces: Sequence[mrlab_msgs.msg.Surface] = ...) -> None: ...

class GetTrajectory(Service[GetTrajectory.Request, GetTrajectory.Response]):
    class Request:
        id: str
        file_only: bool
        begin: int
        count: int
        def __init__(self, *, id: str = ..., file_only: bool = ..., begin: int = ..., count: int = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        trajectory: mrlab_msgs.msg.Trajectory
        file: str
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., trajectory: mrlab_msgs.msg.Trajectory = ..., file: str = ...) -> None: ...

class HandOver(Service[HandOver.Request, HandOver.Response]):
    class Request:
        owner: str
        to: str
        def __init__(self, *, owner: str = ..., to: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class ListBags(Service[ListBags.Request, ListBags.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        bags: list[str]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., bags: Sequence[str] = ...) -> None: ...

class ListCatalogue(Service[ListCatalogue.Request, ListCatalogue.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        types: list[mrlab_msgs.msg.ObjectType]
        limit: int
        def __init__(self, *, types: Sequence[mrlab_msgs.msg.ObjectType] = ..., limit: int = ...) -> None: ...

class ListScenes(Service[ListScenes.Request, ListScenes.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        scenes: list[str]
        def __init__(self, *, scenes: Sequence[str] = ...) -> None: ...

class ListTrajectories(Service[ListTrajectories.Request, ListTrajectories.Response]):
    class Request:
        robot_model: str
        end_effector: str
        begin: int
        count: int
        def __init__(self, *, robot_model: str = ..., end_effector: str = ..., begin: int = ..., count: int = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        trajectories: list[mrlab_msgs.msg.TrajectoryInfo]
        total: int
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., trajectories: Sequence[mrlab_msgs.msg.TrajectoryInfo] = ..., total: int = ...) -> None: ...

class LoadTrajectory(Service[LoadTrajectory.Request, LoadTrajectory.Response]):
    class Request:
        id: str
        def __init__(self, *, id: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class MoveObject(Service[MoveObject.Request, MoveObject.Response]):
    class Request:
        name: str
        pose: geometry_msgs.msg.Pose
        twist: geometry_msgs.msg.Twist
        held: bool
        hand: str
        def __init__(self, *, name: str = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., held: bool = ..., hand: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class PlaceRobot(Service[PlaceRobot.Request, PlaceRobot.Response]):
    class Request:
        robot: str
        pose: geometry_msgs.msg.Pose
        hand: str
        def __init__(self, *, robot: str = ..., pose: geometry_msgs.msg.Pose = ..., hand: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class PublishTrajectory(Service[PublishTrajectory.Request, PublishTrajectory.Response]):
    class Request:
        draft: str
        id: str
        owner: str
        shared: bool
        def __init__(self, *, draft: str = ..., id: str = ..., owner: str = ..., shared: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        trajectory: mrlab_msgs.msg.TrajectoryInfo
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., trajectory: mrlab_msgs.msg.TrajectoryInfo = ...) -> None: ...

class Remove(Service[Remove.Request, Remove.Response]):
    class Request:
        name: str
        def __init__(self, *, name: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class Replay(Service[Replay.Request, Replay.Response]):
    class Request:
        bag: str
        rate: float
        start: float
        loop: bool
        def __init__(self, *, bag: str = ..., rate: float = ..., start: float = ..., loop: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class RestoreTrajectory(Service[RestoreTrajectory.Request, RestoreTrajectory.Response]):
    class Request:
        id: str
        version: int
        def __init__(self, *, id: str = ..., version: int = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        trajectory: mrlab_msgs.msg.TrajectoryInfo
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., trajectory: mrlab_msgs.msg.TrajectoryInfo = ...) -> None: ...

class SceneFile(Service[SceneFile.Request, SceneFile.Response]):
    class Request:
        name: str
        def __init__(self, *, name: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class Seek(Service[Seek.Request, Seek.Response]):
    class Request:
        position: float
        def __init__(self, *, position: float = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetEndEffector(Service[SetEndEffector.Request, SetEndEffector.Response]):
    class Request:
        robot: str
        end_effector: str
        def __init__(self, *, robot: str = ..., end_effector: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetLoop(Service[SetLoop.Request, SetLoop.Response]):
    class Request:
        loop: bool
        def __init__(self, *, loop: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetMode(Service[SetMode.Request, SetMode.Response]):
    class Request:
        mode: int
        def __init__(self, *, mode: int = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetObjects(Service[SetObjects.Request, SetObjects.Response]):
    class Request:
        objects: list[mrlab_msgs.msg.ObjectPlacement]
        surfaces: list[mrlab_msgs.msg.Surface]
        dry_run: bool
        def __init__(self, *, objects: Sequence[mrlab_msgs.msg.ObjectPlacement] = ..., surfaces: Sequence[mrlab_msgs.msg.Surface] = ..., dry_run: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        objects: list[mrlab_msgs.msg.ObjectPlacement]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., objects: Sequence[mrlab_msgs.msg.ObjectPlacement] = ...) -> None: ...

class SetPlace(Service[SetPlace.Request, SetPlace.Response]):
    class Request:
        id: str
        name: str
        def __init__(self, *, id: str = ..., name: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetRate(Service[SetRate.Request, SetRate.Response]):
    class Request:
        rate: float
        def __init__(self, *, rate: float = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SetSurfaces(Service[SetSurfaces.Request, SetSurfaces.Response]):
    class Request:
        source: str
        surfaces: list[mrlab_msgs.msg.Surface]
        def __init__(self, *, source: str = ..., surfaces: Sequence[mrlab_msgs.msg.Surface] = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class ShareTrajectory(Service[ShareTrajectory.Request, ShareTrajectory.Response]):
    class Request:
        id: str
        shared: bool
        def __init__(self, *, id: str = ..., shared: bool = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class SpawnObject(Service[SpawnObject.Request, SpawnObject.Response]):
    class Request:
        type: str
        name: str
        automatic: bool
        pose: geometry_msgs.msg.Pose
        def __init__(self, *, type: str = ..., name: str = ..., automatic: bool = ..., pose: geometry_msgs.msg.Pose = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        object: mrlab_msgs.msg.SceneObject
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., object: mrlab_msgs.msg.SceneObject = ...) -> None: ...

class SpawnRobot(Service[SpawnRobot.Request, SpawnRobot.Response]):
    class Request:
        model: str
        end_effector: str
        name: str
        automatic: bool
        pose: geometry_msgs.msg.Pose
        surface: str
        has_viewer: bool
        viewer: geometry_msgs.msg.Pose
        def __init__(self, *, model: str = ..., end_effector: str = ..., name: str = ..., automatic: bool = ..., pose: geometry_msgs.msg.Pose = ..., surface: str = ..., has_viewer: bool = ..., viewer: geometry_msgs.msg.Pose = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        robot: mrlab_msgs.msg.Robot
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., robot: mrlab_msgs.msg.Robot = ...) -> None: ...

class StartRecording(Service[StartRecording.Request, StartRecording.Response]):
    class Request:
        bag: str
        topics: list[str]
        split_duration: float
        def __init__(self, *, bag: str = ..., topics: Sequence[str] = ..., split_duration: float = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        bag: str
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ..., bag: str = ...) -> None: ...

class Step(Service[Step.Request, Step.Response]):
    class Request:
        frames: int
        def __init__(self, *, frames: int = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class Trigger(Service[Trigger.Request, Trigger.Response]):
    class Request:
        def __init__(self) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...

class Undo(Service[Undo.Request, Undo.Response]):
    class Request:
        id: str
        def __init__(self, *, id: str = ...) -> None: ...
    class Response:
        success: bool
        message: str
        code: str
        values: list[diagnostic_msgs.msg.KeyValue]
        def __init__(self, *, success: bool = ..., message: str = ..., code: str = ..., values: Sequence[diagnostic_msgs.msg.KeyValue] = ...) -> None: ...
