"""Writes masses of links that nobody published: `inertials.py [--library DIR] [ID ...]`.

Centres of mass and inertias become those of the drawn bodies as uniform solids, masses are spread
over links by their volume; totals stay. robot.yaml and robot.urdf are written anew; the notes of
robot.yaml say which of its figures come from here.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path

import measure
import numpy as np
import trimesh
import yaml
from urdf_writer import LinkFiles, urdf

from mrlab_ros.core.base.geometry import Array

ROBOTS = Path(__file__).resolve().parents[2] / "robots"
ARM = ("base_link", *(f"link_{n}" for n in range(1, 7)))
CYBERTECH = ("base_link", "link_1", "link_4", "link_5", "link_6")
# Links with the centre of mass and the inertia of their body, and those that share one mass.
UNIFORM: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "kuka_kr3_r540": (ARM, ARM),
    "kuka_kr6_r900_sixx": (ARM, ARM),
    "kuka_kr16_r1610_2": (CYBERTECH, CYBERTECH[2:]),
    "kuka_kr20_r1810_2": (CYBERTECH, CYBERTECH[2:]),
    "kuka_kr120_r2500_pro": (ARM, ARM),
    "kuka_kr560_r3100_2": (ARM, ()),
    "kuka_lbr_iisy15_r930": (ARM, ()),
}


def block(link: str, mass: float, body: trimesh.Trimesh) -> str:
    """Return the lines of robot.yaml that give a link of `mass`, kg, its body's inertial data."""
    middle = body.center_mass
    inertia: Array = body.moment_inertia * (mass / body.volume)
    six = inertia[np.triu_indices(3)]
    return (
        f"  {link}:\n"
        f"    {{mass: {mass:.6g}, com: [{', '.join(str(round(v, 4) + 0.0) for v in middle)}],\n"
        f"     inertia: [{', '.join(_number(v) for v in six)}]}}\n"
    )


def _number(value: float) -> str:
    """Return a number of seven digits as YAML reads it: an exponent needs a point before it."""
    text = f"{value:.7g}"
    return re.sub(r"^(-?\d+)e", r"\1.0e", text)


def write(folder: Path) -> None:
    """Write the inertial data of one robot anew, from its shipped bodies."""
    solid, sharing = UNIFORM[folder.name]
    source = folder / "robot.yaml"
    text = source.read_text()
    figures = yaml.safe_load(text)
    masses = {link: float(data["mass"]) for link, data in figures["inertials"].items()}
    bodies = {link: measure.body(folder / "meshes" / f"{link}.glb") for link in solid}
    total, volume = sum(masses[n] for n in sharing), sum(bodies[n].volume for n in sharing)
    for link in solid:
        if link in sharing:
            masses[link] = total * bodies[link].volume / volume
        pattern = rf"^  {link}:\n    \{{mass:[^}}]*\}}\n"
        text, found = re.subn(
            pattern, lambda _, link=link: block(link, masses[link], bodies[link]), text, flags=re.M
        )
        if found != 1:
            raise SystemExit(f"{source}: {found} blocks of {link} with a mass; expected 1")
    source.write_text(text)
    files = {}
    for glb in (folder / "meshes").glob("*.glb"):
        count = len(list(glb.parent.glob(f"{glb.stem}_hull_*.stl")))
        hulls = tuple(f"{glb.stem}_hull_{n}.stl" for n in range(count))
        files[glb.stem] = LinkFiles(glb.name, hulls)
    uri = f"package://mrlab_ros/robots/{folder.name}/meshes"
    (folder / "robot.urdf").write_text(urdf(yaml.safe_load(text), files, uri))


def main() -> None:
    """Write the robots named on the command line, or all whose inertial data is not published."""
    parser = argparse.ArgumentParser(description="Write inertial data that nobody published.")
    parser.add_argument("--library", type=Path, default=ROBOTS, help="the library to write to")
    parser.add_argument("ids", nargs="*", metavar="ID", help=f"of {', '.join(UNIFORM)}; none: all")
    chosen = parser.parse_args()
    published = sorted(set(chosen.ids) - set(UNIFORM))
    if published:
        parser.error(f"the inertial data of {', '.join(published)} is published or described")
    for robot in chosen.ids or UNIFORM:
        write(chosen.library / robot)


if __name__ == "__main__":
    main()
