# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import rcl_interfaces.msg
from typing import ClassVar
from message_bases import Service

class GetParameters(Service[GetParameters.Request, GetParameters.Response]):
    class Request:
        names: list[str]
        def __init__(self, *, names: Sequence[str] = ...) -> None: ...
    class Response:
        values: list[rcl_interfaces.msg.ParameterValue]
        def __init__(self, *, values: Sequence[rcl_interfaces.msg.ParameterValue] = ...) -> None: ...

class ListParameters(Service[ListParameters.Request, ListParameters.Response]):
    class Request:
        DEPTH_RECURSIVE: ClassVar[int]
        prefixes: list[str]
        depth: int
        def __init__(self, *, prefixes: Sequence[str] = ..., depth: int = ...) -> None: ...
    class Response:
        result: rcl_interfaces.msg.ListParametersResult
        def __init__(self, *, result: rcl_interfaces.msg.ListParametersResult = ...) -> None: ...
