"""Renders every robot beside a person of 1.8 m into docs/gallery/: `gallery.py [ID ...]`."""

from __future__ import annotations

import sys
from pathlib import Path

from picture import take

from mrlab_ros.adapters.robots.library import RobotLibrary

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    """Render the robots named on the command line, or all, and the end effectors on a UR5e."""
    library = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none imported")
    folder = ROOT / "docs" / "gallery"
    wanted = sys.argv[1:]
    for robot in library.ids():
        if not wanted or robot in wanted:
            take(library, robot, folder / f"{robot}.png", size=(800, 800), samples=5)
            print(robot)
    for tool in library.end_effectors():
        if not wanted or tool in wanted:
            path = folder / f"{tool}.png"
            take(library, "ur5e", path, tool, size=(800, 800), samples=5, figure=False)
            print(tool)


if __name__ == "__main__":
    main()
