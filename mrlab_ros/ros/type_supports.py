"""Messages without what their modules import and a process may never use.

The code generator costs a process 11 MB, numpy 16 MB.
"""

from __future__ import annotations

import importlib.util
import sys
import threading
from types import ModuleType
from typing import Any

GENERATOR = "rosidl_generator_py"
NUMPY = "numpy"
# Names with underscores that are read to use a module; others are read of every module.
USED = ("__path__", "__version__")


def skip_generator() -> None:
    """Let messages load their type support without the generator's parsers, a tenth of a command.

    A message's class asks the package `rosidl_generator_py` for one function, and the package
    imports empy and lark for another one that builds messages.
    """
    if GENERATOR in sys.modules or (spec := importlib.util.find_spec(GENERATOR)) is None:
        return
    package = ModuleType(GENERATOR)
    package.__spec__, package.__path__ = spec, spec.submodule_search_locations or []
    sys.modules[GENERATOR] = package
    try:
        impl = importlib.import_module(f"{GENERATOR}.import_type_support_impl")
        package.import_type_support = impl.import_type_support  # type: ignore[attr-defined]
    except (ImportError, AttributeError):  # another release: as it imports itself
        del sys.modules[GENERATOR]


def postpone_numpy() -> None:
    """Import numpy when something of it is used first: messages only need it for fixed arrays.

    Each use of what imported it before that passes through a stand-in, so a process that computes
    with numpy imports it itself.
    """
    if NUMPY not in sys.modules:
        sys.modules[NUMPY] = _Postponed(NUMPY)


class _Postponed(ModuleType):
    """Stands for a module that is imported once an attribute of it is read."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.__dict__["_importing"] = threading.RLock()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") and name not in USED:  # who looks for a frame's file, and such
            raise AttributeError(name)
        with self.__dict__["_importing"]:
            if sys.modules.get(self.__name__) is self:
                del sys.modules[self.__name__]
            module = importlib.import_module(self.__name__)
        return getattr(module, name)
