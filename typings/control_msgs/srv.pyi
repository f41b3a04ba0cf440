# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
from message_bases import Numbers
from message_bases import NumbersField
from message_bases import Service

class QueryTrajectoryState(Service[QueryTrajectoryState.Request, QueryTrajectoryState.Response]):
    class Request:
        time: builtin_interfaces.msg.Time
        def __init__(self, *, time: builtin_interfaces.msg.Time = ...) -> None: ...
    class Response:
        success: bool
        message: str
        name: list[str]
        position: NumbersField[float]
        velocity: NumbersField[float]
        acceleration: NumbersField[float]
        def __init__(self, *, success: bool = ..., message: str = ..., name: Sequence[str] = ..., position: Numbers[float] = ..., velocity: Numbers[float] = ..., acceleration: Numbers[float] = ...) -> None: ...
