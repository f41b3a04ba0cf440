# Generated from the message definitions by `make docs`.
from typing import ClassVar

class JointComponentTolerance:
    ROTATION: ClassVar[int]
    TRANSLATION: ClassVar[int]
    X_AXIS: ClassVar[int]
    Y_AXIS: ClassVar[int]
    Z_AXIS: ClassVar[int]
    joint_name: str
    component: int
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, joint_name: str = ..., component: int = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointTolerance:
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, name: str = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...
