# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import std_msgs.msg
from message_bases import Numbers
from message_bases import NumbersField

class CompressedImage:
    header: std_msgs.msg.Header
    format: str
    data: NumbersField[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., format: str = ..., data: Numbers[int] = ...) -> None: ...

class JointState:
    header: std_msgs.msg.Header
    name: list[str]
    position: NumbersField[float]
    velocity: NumbersField[float]
    effort: NumbersField[float]
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: Sequence[str] = ..., position: Numbers[float] = ..., velocity: Numbers[float] = ..., effort: Numbers[float] = ...) -> None: ...
