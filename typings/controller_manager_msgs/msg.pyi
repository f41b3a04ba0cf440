# Generated from the message definitions by `make docs`.
from collections.abc import Sequence

class ChainConnection:
    name: str
    reference_interfaces: list[str]
    def __init__(self, *, name: str = ..., reference_interfaces: Sequence[str] = ...) -> None: ...

class ControllerState:
    name: str
    state: str
    type: str
    is_async: bool
    update_rate: int
    claimed_interfaces: list[str]
    required_command_interfaces: list[str]
    required_state_interfaces: list[str]
    is_chainable: bool
    is_chained: bool
    exported_state_interfaces: list[str]
    reference_interfaces: list[str]
    chain_connections: list[ChainConnection]
    def __init__(self, *, name: str = ..., state: str = ..., type: str = ..., is_async: bool = ..., update_rate: int = ..., claimed_interfaces: Sequence[str] = ..., required_command_interfaces: Sequence[str] = ..., required_state_interfaces: Sequence[str] = ..., is_chainable: bool = ..., is_chained: bool = ..., exported_state_interfaces: Sequence[str] = ..., reference_interfaces: Sequence[str] = ..., chain_connections: Sequence[ChainConnection] = ...) -> None: ...
