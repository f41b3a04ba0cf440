# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import geometry_msgs.msg

class TFMessage:
    transforms: list[geometry_msgs.msg.TransformStamped]
    def __init__(self, *, transforms: Sequence[geometry_msgs.msg.TransformStamped] = ...) -> None: ...
