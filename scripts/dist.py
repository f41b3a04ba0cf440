#!/usr/bin/env python3
"""Build the source archive and, from it, the wheel; check that both are complete.

The argument is the folder they come to, which is emptied first; without one, dist/.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARE = "/data/share/mrlab_ros/"
# One file of each thing that the installed lab reads.
NEEDED = (
    f"{SHARE}config/lab.yaml",
    f"{SHARE}examples/quintic_ur5e.mat",
    f"{SHARE}launch/lab.launch.py",
    f"{SHARE}msg_schemas/trajectory.schema.json",
    f"{SHARE}package.xml",
    f"{SHARE}robots/ur5e/robot.urdf",
    f"{SHARE}web/dist/index.html",
    f"{SHARE}web/dist/licences.md",
    f"{SHARE}web/dist/flat/flat.js",
    f"{SHARE}web/dist/show/show.js",
    "mrlab_ros/py.typed",
    ".dist-info/entry_points.txt",
    ".dist-info/licenses/LICENSE",
)


def run(*command: str, cwd: Path) -> None:
    # The clone's own packages are not what is built.
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(
            f"{' '.join(command)} failed:\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
        )


def missing(names: list[str]) -> list[str]:
    """Return what a wheel with files of these names lacks."""
    return [end for end in NEEDED if not any(name.endswith(end) for name in names)]


def main(folder: str = "dist") -> int:
    target = ROOT / folder
    shutil.rmtree(target, ignore_errors=True)
    with tempfile.TemporaryDirectory() as aside:
        egg_info = ("egg_info", "--egg-base", aside)
        run(sys.executable, "setup.py", "-q", *egg_info, "sdist", "-d", str(target), cwd=ROOT)
    (archive,) = target.glob("*.tar.gz")
    # From the archive: what it lacks, the wheel lacks.
    pip = (sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation")
    run(*pip, "-w", str(target), str(archive), cwd=target)
    (wheel,) = target.glob("*.whl")
    if lacks := missing(zipfile.ZipFile(wheel).namelist()):
        raise SystemExit(f"{wheel.name} lacks {', '.join(lacks)}; see MANIFEST.in and setup.py")
    for file in (archive, wheel):
        print(f"{folder}/{file.name} ({file.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
