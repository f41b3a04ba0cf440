# Generated from the message definitions by `make docs`.
import geometry_msgs.msg
from typing import ClassVar
from message_bases import Numbers
from message_bases import NumbersField

class SolidPrimitive:
    BOX: ClassVar[int]
    BOX_X: ClassVar[int]
    BOX_Y: ClassVar[int]
    BOX_Z: ClassVar[int]
    CONE: ClassVar[int]
    CONE_HEIGHT: ClassVar[int]
    CONE_RADIUS: ClassVar[int]
    CYLINDER: ClassVar[int]
    CYLINDER_HEIGHT: ClassVar[int]
    CYLINDER_RADIUS: ClassVar[int]
    PRISM: ClassVar[int]
    PRISM_HEIGHT: ClassVar[int]
    SPHERE: ClassVar[int]
    SPHERE_RADIUS: ClassVar[int]
    type: int
    dimensions: NumbersField[float]
    polygon: geometry_msgs.msg.Polygon
    def __init__(self, *, type: int = ..., dimensions: Numbers[float] = ..., polygon: geometry_msgs.msg.Polygon = ...) -> None: ...
