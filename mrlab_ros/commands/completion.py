"""Completions of the Tab key: they ask no lab and import no ROS, so that they are quick."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from mrlab_ros.core.base.errors import LabError

# Is set by the scripts of the shells; the name is Typer's.
ASKED = "_MRLAB_COMPLETE"


def words() -> list[str] | None:
    """Return the words before the one that is completed, from the shell; None: it completes none.

    Typer parses them again, with quotes; this is to know the command alone.
    """
    if not os.environ.get(ASKED, "").startswith("complete_"):
        return None
    if "COMP_WORDS" in os.environ:
        given = os.environ["COMP_WORDS"].split()
        return given[1 : int(os.environ.get("COMP_CWORD") or len(given))]
    line = os.environ.get("_TYPER_COMPLETE_ARGS", "")
    given = line.split()[1:]
    return given if line[-1:].isspace() else given[:-1]


def robots(incomplete: str) -> list[str]:
    """Return the names of the running lab's robots that begin so."""
    return _beginning(incomplete, (robot["name"] for robot in _scene("robots")))


def systems(incomplete: str) -> list[str]:
    """Return the names of the running lab's systems that begin so."""
    return _beginning(incomplete, (system["name"] for system in _scene("systems")))


def models(incomplete: str) -> list[str]:
    """Return the ids of robot models that begin so, the imported ones too."""
    return _beginning(incomplete, (path.parent.name for path in _library("*/robot.yaml")))


def tools(incomplete: str) -> list[str]:
    """Return the ids of end effectors that begin so."""
    found = _library("end_effectors/*/end_effector.yaml")
    return _beginning(incomplete, (path.parent.name for path in found))


def _beginning(incomplete: str, names: Any) -> list[str]:
    return sorted({name for name in names if name.startswith(incomplete)})


def _library(pattern: str) -> list[Path]:
    from mrlab_ros.adapters import share
    from mrlab_ros.adapters.share import imported_folder

    folders = (share.directory() / "robots", imported_folder())
    return [path for folder in folders for path in folder.glob(pattern)]


def _scene(what: str) -> list[dict[str, Any]]:
    """Return the robots or systems that the lab of `mrlab up` on this domain saved last."""
    from mrlab_ros.processes.run_file import RunFile
    from mrlab_ros.ros.environment import domain_id

    try:
        lab = RunFile(domain_id()).read()
        text = (Path(str((lab or {})["state_dir"])) / "scene.json").read_text()
        return list(json.loads(text)[what])
    except (LabError, OSError, ValueError, KeyError):
        return []
