# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import std_msgs.msg
from typing import ClassVar

class DiagnosticArray:
    header: std_msgs.msg.Header
    status: list[DiagnosticStatus]
    def __init__(self, *, header: std_msgs.msg.Header = ..., status: Sequence[DiagnosticStatus] = ...) -> None: ...

class DiagnosticStatus:
    ERROR: ClassVar[bytes]
    OK: ClassVar[bytes]
    STALE: ClassVar[bytes]
    WARN: ClassVar[bytes]
    level: bytes
    name: str
    message: str
    hardware_id: str
    values: list[KeyValue]
    def __init__(self, *, level: bytes = ..., name: str = ..., message: str = ..., hardware_id: str = ..., values: Sequence[KeyValue] = ...) -> None: ...

class KeyValue:
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ...) -> None: ...
