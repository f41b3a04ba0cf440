"""Messages without the code generator that their modules import."""

from __future__ import annotations

import importlib.util
import sys
from types import ModuleType

GENERATOR = "rosidl_generator_py"


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
