# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import geometry_msgs.msg
import sensor_msgs.msg
import std_msgs.msg
from typing import ClassVar
from message_bases import Numbers
from message_bases import NumbersField

class Marker:
    ADD: ClassVar[int]
    ARROW: ClassVar[int]
    ARROW_STRIP: ClassVar[int]
    CUBE: ClassVar[int]
    CUBE_LIST: ClassVar[int]
    CYLINDER: ClassVar[int]
    DELETE: ClassVar[int]
    DELETEALL: ClassVar[int]
    LINE_LIST: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    MESH_RESOURCE: ClassVar[int]
    MODIFY: ClassVar[int]
    POINTS: ClassVar[int]
    SPHERE: ClassVar[int]
    SPHERE_LIST: ClassVar[int]
    TEXT_VIEW_FACING: ClassVar[int]
    TRIANGLE_LIST: ClassVar[int]
    header: std_msgs.msg.Header
    ns: str
    id: int
    type: int
    action: int
    pose: geometry_msgs.msg.Pose
    scale: geometry_msgs.msg.Vector3
    color: std_msgs.msg.ColorRGBA
    lifetime: builtin_interfaces.msg.Duration
    frame_locked: bool
    points: list[geometry_msgs.msg.Point]
    colors: list[std_msgs.msg.ColorRGBA]
    texture_resource: str
    texture: sensor_msgs.msg.CompressedImage
    uv_coordinates: list[UVCoordinate]
    text: str
    mesh_resource: str
    mesh_file: MeshFile
    mesh_use_embedded_materials: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., pose: geometry_msgs.msg.Pose = ..., scale: geometry_msgs.msg.Vector3 = ..., color: std_msgs.msg.ColorRGBA = ..., lifetime: builtin_interfaces.msg.Duration = ..., frame_locked: bool = ..., points: Sequence[geometry_msgs.msg.Point] = ..., colors: Sequence[std_msgs.msg.ColorRGBA] = ..., texture_resource: str = ..., texture: sensor_msgs.msg.CompressedImage = ..., uv_coordinates: Sequence[UVCoordinate] = ..., text: str = ..., mesh_resource: str = ..., mesh_file: MeshFile = ..., mesh_use_embedded_materials: bool = ...) -> None: ...

class MarkerArray:
    markers: list[Marker]
    def __init__(self, *, markers: Sequence[Marker] = ...) -> None: ...

class MeshFile:
    filename: str
    data: NumbersField[int]
    def __init__(self, *, filename: str = ..., data: Numbers[int] = ...) -> None: ...

class UVCoordinate:
    u: float
    v: float
    def __init__(self, *, u: float = ..., v: float = ...) -> None: ...
