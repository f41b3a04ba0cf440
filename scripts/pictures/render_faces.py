#!/usr/bin/env python3
"""Render the pictures of docs/faces.md: robots, tools and things as pages draw them.

Needs Chromium and what the tests need; takes some minutes where there is no GPU.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "bench")]

from faces_page import Faces, faces  # noqa: E402

PICTURES = ROOT / "docs" / "images" / "faces"
SIZE = (1200, 800)
TOOLS = ("parallel_gripper", "centric_gripper", "vacuum_cup", "holding_magnet")
LARGE = ("kuka_kr16_r1610_2", "kuka_kr50_r2100", "kuka_kr150_r2700_2", "kuka_kr560_r3100_2")
# Of a robot at three distances: eyes and what they look at, in reaches from its base.
DISTANCES = (((1.35, -1.5, 0.95), (0.2, 0, 0.45)), ((0.62, -0.8, 0.75), (0.15, 0, 0.5)),
             ((0.48, -0.55, 0.42), (0.06, 0, 0.3)))  # fmt: skip
TABLE = [
    {"id": "table", "at": (0.1, 0, 0.37, 0)},
    {"id": "cup", "at": (-0.22, -0.12, 0.78, 0.6)},
    {"id": "bottle", "at": (-0.07, 0.03, 0.84, 0)},
    {"id": "can", "at": (0.08, -0.13, 0.7975, 0.4)},
    {"id": "peg", "at": (0.2, -0.18, 0.79, 0)},
    {"id": "hole", "at": (0.45, -0.17, 0.77, 0.3)},
    {"id": "fixture", "at": (0.4, 0.12, 0.76, 0.1)},
    {"id": "bin", "at": (-0.24, 0.18, 0.805, 0.1)},
]
FLOOR = [
    {"id": "pallet", "at": (-1.25, -0.1, 0.072, 0.25)},
    {"id": "crate", "at": (-1.3, -0.1, 0.264, 0.4)},
    {"id": "conveyor", "at": (1.35, 0.45, 0.375, -0.35)},
    {"id": "pedestal", "at": (1.0, -0.75, 0.2, 0.3)},
]
BEHIND = {"id": "kuka_kr16_r1610_2", "tool": "parallel_gripper", "at": (-0.3, 1.9, 0, 0)}


def things(page: Faces) -> Image.Image:
    """All things of the catalogue that have a body, before a robot."""
    page.show([BEHIND], [*TABLE, *FLOOR])
    return page.look((0.25, -3.1, 1.8), (0.0, 0.1, 0.42), 36)


def on_the_table(page: Faces) -> Image.Image:
    """Small things from arm's length."""
    page.show([BEHIND], TABLE)
    return page.look((0.18, -1.0, 1.25), (0.1, 0.02, 0.8), 36)


def tools(page: Faces) -> Image.Image:
    """The end effectors on a flange, side by side."""
    shown = []
    for tool in TOOLS:
        page.show([{"id": "ur5e", "tool": tool}])
        seen = page.look((0.98, -0.62, 0.55), (0.49, 0.13, 0.38), 22)
        shown.append(seen.crop((300, 0, 900, 800)))
    return _beside(shown)


def robots(page: Faces) -> Image.Image:
    """Four large robots from three distances."""
    rows = []
    for name in LARGE:
        reach = page.reach(name)
        page.show([{"id": name}])
        seen = []
        for eyes, at in DISTANCES:
            for _ in range(2):  # until no level dissolves into the other
                picture = page.look([reach * v for v in eyes], [reach * v for v in at], 34)
            seen.append(picture.resize((600, 400), Image.Resampling.LANCZOS))
        rows.append(_beside(seen))
    whole = Image.new("RGB", (rows[0].width, sum(row.height for row in rows)))
    for n, row in enumerate(rows):
        whole.paste(row, (0, n * row.height))
    return whole


def _beside(shown: list[Image.Image]) -> Image.Image:
    whole = Image.new("RGB", (sum(each.width for each in shown), shown[0].height))
    at = 0
    for each in shown:
        whole.paste(each, (at, 0))
        at += each.width
    return whole


SHOTS: dict[str, Callable[[Faces], Image.Image]] = {
    each.__name__: each for each in (things, on_the_table, tools, robots)
}


def main() -> None:
    """Write the pictures, or those that are named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(SHOTS)}")
    names = parser.parse_args().names or list(SHOTS)
    if unknown := sorted(set(names) - set(SHOTS)):
        parser.error(f"there is no picture {', '.join(unknown)}; expected {', '.join(SHOTS)}")
    PICTURES.mkdir(exist_ok=True)
    with faces(SIZE) as page:
        for name in names:
            path = PICTURES / f"{name}.webp"
            SHOTS[name](page).save(path, quality=84, method=6)
            print(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e3:.0f} kB", flush=True)


if __name__ == "__main__":
    main()
