# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
from message_bases import Numbers
from message_bases import NumbersField

class FloatingPointRange:
    from_value: float
    to_value: float
    step: float
    def __init__(self, *, from_value: float = ..., to_value: float = ..., step: float = ...) -> None: ...

class IntegerRange:
    from_value: int
    to_value: int
    step: int
    def __init__(self, *, from_value: int = ..., to_value: int = ..., step: int = ...) -> None: ...

class ListParametersResult:
    names: list[str]
    prefixes: list[str]
    def __init__(self, *, names: Sequence[str] = ..., prefixes: Sequence[str] = ...) -> None: ...

class ParameterDescriptor:
    name: str
    type: int
    description: str
    additional_constraints: str
    read_only: bool
    dynamic_typing: bool
    floating_point_range: list[FloatingPointRange]
    integer_range: list[IntegerRange]
    def __init__(self, *, name: str = ..., type: int = ..., description: str = ..., additional_constraints: str = ..., read_only: bool = ..., dynamic_typing: bool = ..., floating_point_range: Sequence[FloatingPointRange] = ..., integer_range: Sequence[IntegerRange] = ...) -> None: ...

class ParameterValue:
    type: int
    bool_value: bool
    integer_value: int
    double_value: float
    string_value: str
    byte_array_value: list[bytes]
    bool_array_value: list[bool]
    integer_array_value: NumbersField[int]
    double_array_value: NumbersField[float]
    string_array_value: list[str]
    def __init__(self, *, type: int = ..., bool_value: bool = ..., integer_value: int = ..., double_value: float = ..., string_value: str = ..., byte_array_value: Sequence[bytes] = ..., bool_array_value: Sequence[bool] = ..., integer_array_value: Numbers[int] = ..., double_array_value: Numbers[float] = ..., string_array_value: Sequence[str] = ...) -> None: ...

class SetParametersResult:
    successful: bool
    reason: str
    def __init__(self, *, successful: bool = ..., reason: str = ...) -> None: ...
