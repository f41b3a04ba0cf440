"""Names of robots, systems and objects: what they may look like and which are reserved."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Iterable

from mrlab_ros.core.base.diagnostics import BAD_NAME, NAME_TAKEN, RESERVED_NAME
from mrlab_ros.core.base.errors import BadInput

NAME = re.compile(r"[a-z][a-z0-9_]{0,62}")
GERMAN = str.maketrans(
    {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue"}
)


# Names below which the lab's own topics and services live.
RESERVED = frozenset(
    {
        "assets",
        "bridge",
        "contacts",
        "converter",
        "coordinator",
        "frames",
        "lab",
        "look_here",
        "markers",
        "objects",
        "overlaps",
        "physics",
        "place",
        "playback_host",
        "processes",
        "recorder",
        "robot_description",
        "robots",
        "rosout",
        "schema",
        "surfaces",
        "systems",
        "tf",
        "tf_static",
        "trajectories",
        "undoable",
    }
)
# Beginnings of the names of parameters that rclpy declares on every node.
PARAMETERS_OF_RCLPY = ("use_sim_time", "start_type_description_service", "qos_overrides.")


def checked_name(name: str, taken: frozenset[str], what: str) -> str:
    """Return `name` where it can be a namespace and is free; raise BadInput otherwise.

    what: robot, object or system.
    """
    if not NAME.fullmatch(name) or name.endswith("_") or "__" in name:
        raise BadInput(BAD_NAME(name=name, what=what))
    if name in RESERVED:
        raise BadInput(RESERVED_NAME(name=name))
    if name in taken:
        raise BadInput(NAME_TAKEN(name=name))
    return name


def without_accents(text: str) -> str:
    """Return a text with umlauts as German writes them without, and no other accents."""
    text = unicodedata.normalize("NFKD", unicodedata.normalize("NFC", text).translate(GERMAN))
    return "".join(c for c in text if not unicodedata.combining(c))


def close_to(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that is closest; None where none is close.

    A name that contains `name`, as kuka_kr6_r900_sixx contains KR6, counts where none is similar.
    """
    names = list(known)
    wanted = name.lower().replace("-", "_").replace(" ", "_")
    # One letter of a short name weighs more: ur6 is similar to ur5e, nothere is not to three.
    cutoff = 0.55 if len(wanted) <= 4 else 0.68
    close = difflib.get_close_matches(wanted, names, n=1, cutoff=cutoff)
    if not close and len(wanted) > 1:
        close = [one for one in names if wanted in one]
    return close[0] if close else None
