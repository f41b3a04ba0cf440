"""Settings of Fast DDS, the middleware that ROS's wheels come with.

The ROS domain of this process.

Clears shared memory that a killed process left half-made, on which the next one would wait.

Fast DDS, with which the wheels of ROS come, makes a segment for each of its ports under /dev/shm:
it creates the file, gives it a size, and writes 2 into its first word (Boost.Interprocess,
`managed_open_or_create_impl`). Who opens a segment that is not finished waits for its maker, and
for ever where that was killed; some ports are the same for all domains of a machine.

Messages without what their modules import and a process may never use.

The code generator costs a process 11 MB, numpy 16 MB.
"""

from __future__ import annotations

import contextlib
import importlib.util
import os
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

from mrlab_ros.adapters import share
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.ros.diagnostics import BAD_DOMAIN, NO_LOG_FOLDER

FOLDER = Path("/dev/shm")
PORTS = "fastrtps_port*"
# Beside a segment: an empty file that is only locked.
LOCK = "_el"
INITIALIZED = (2).to_bytes(4, "little")
# Making a segment takes well below a millisecond; a maker that needs longer than this, s, is dead.
LONGEST_S = 2.0


def remove_abandoned(folder: Path = FOLDER) -> list[str]:
    """Remove the segments of ports that nobody will finish; return their names."""
    now, removed = time.time(), []
    for path in folder.glob(PORTS):
        # Gone meanwhile, or of another user: not ours to remove.
        with contextlib.suppress(OSError):
            if path.name.endswith(LOCK) or now - path.stat().st_mtime < LONGEST_S:
                continue
            with path.open("rb") as segment:
                finished = os.pread(segment.fileno(), len(INITIALIZED), 0) == INITIALIZED
            if not finished:
                path.unlink()
                removed.append(path.name)
    return sorted(removed)


# Fast DDS reads its profiles from here; other middlewares ignore it.
PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"
# Has rmw_fastrtps leave what the profiles say of writers and readers.
PROFILES_OF_ENDS = "RMW_FASTRTPS_USE_QOS_FROM_XML"
RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
# Either of these asks for participants elsewhere.
ELSEWHERE = ("ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER")


def prepare() -> None:
    """Set what the first participant of this process reads; call it before rclpy.init().

    Profiles that the user has chosen stay.
    """
    remove_abandoned()
    os.environ.update(settings(os.environ))


def check_log_folder() -> None:
    """Raise BadInput where rcl, as it says in no such words, cannot write its log."""
    import tempfile  # seldom needed

    home = os.environ.get("ROS_HOME") or "~/.ros"
    folder = Path(os.environ.get("ROS_LOG_DIR") or f"{home}/log").expanduser()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        why = os.strerror(error.errno or 0)
        raise BadInput(NO_LOG_FOLDER(folder=str(folder), why=why)) from error


def settings(environment: Mapping[str, str]) -> dict[str, str]:
    """Return the variables of a process with this environment; none where it has profiles."""
    chosen = environment.get(PROFILES)
    if chosen and not _ours(Path(chosen)):
        return {}
    profiles = profile_file(loopback=stays_here(environment))
    if not profiles.is_file():
        return {}
    return {PROFILES: str(profiles), PROFILES_OF_ENDS: environment.get(PROFILES_OF_ENDS, "1")}


def stays_here(environment: Mapping[str, str]) -> bool:
    """Return whether the graph is to stay on this machine."""
    if environment.get("ROS_LOCALHOST_ONLY") == "1":
        return True
    within = environment.get(RANGE, "").upper() == "LOCALHOST"
    return within and not any(environment.get(name) for name in ELSEWHERE)


def profile_file(*, loopback: bool = False) -> Path:
    """Return a file of the lab's profiles; it says what they are for.

    loopback: of a graph that stays on this machine.
    """
    name = "fastdds_loopback.xml" if loopback else "fastdds.xml"
    return share.directory() / "config" / name


def _ours(chosen: Path) -> bool:
    """Return whether these are the lab's profiles: a shell may name those of the source tree."""
    try:
        text = chosen.read_bytes()
        return any(text == profile_file(loopback=b).read_bytes() for b in (False, True))
    except OSError:
        return False


def domain_id() -> int:
    """Return the ROS domain of this process's environment."""
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not text.isdecimal() or int(text) > 232:
        raise Misuse(BAD_DOMAIN(found=text))
    return int(text)


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


def load_type_supports() -> None:
    """Load the libraries of all imported messages, which each loads on its first use."""
    for name, module in list(sys.modules.items()):
        if name.endswith((".msg", ".srv", ".action")):
            for kind in vars(module).values():
                if getattr(kind, "_TYPE_SUPPORT", True) is None:
                    kind.__import_type_support__()


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
