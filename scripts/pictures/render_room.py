#!/usr/bin/env python3
"""Render the room's pictures and docs/images/room.webp, an animation, of a lab that it starts.

An emulated headset in a furnished room. Needs Chromium, the built pages and what the tests need;
takes some minutes where there is no GPU.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "test" / "support" / room) for room in ("labs", "pages")]

from emulated_room import EmulatedRoom  # noqa: E402
from served_lab import ServedLab, served_lab  # noqa: E402

MOTION = ROOT / "examples" / "pick_and_place_ur5e.mat"
OTHER = ROOT / "examples" / "quintic_ur5e.mat"
CELL = ROOT / "examples" / "handover_cell.yaml"
TARGET = ROOT / "docs" / "images" / "room.webp"
PICTURES = ROOT / "docs" / "images" / "room"
SIZE = (1200, 720)
CLIP = (720, 432)
COUNT = 40
RATE = 8  # frames a second
QUALITY = 58
ARGUMENTS = (
    *("--headless=new", "--no-sandbox"),
    *("--enable-unsafe-swiftshader", "--use-angle=swiftshader"),
)
ROBOT = "room.panels.of('ur5e_1')"
VIEW = "room.follower.robots.value.find(({ robot }) => robot.name === 'ur5e_1')"
SYSTEM = "room.systems.of('handover')"
# Of the control panel in most pictures.
EYES = (0.2, 1.55, 0.15)


def seek(room: EmulatedRoom, share: float) -> None:
    """Go to a share of the motion and wait until the lab is there."""
    room.page.evaluate(f"{VIEW}.player.seek({VIEW}.player.duration * {share})")
    room.until(f"Math.abs({VIEW}.player.position() / {VIEW}.player.duration - {share}) < 0.02")


def carry(lab: ServedLab, room: EmulatedRoom) -> None:
    """Play the example until its gripper carries the cube, and pause."""
    lab.done("scene", "load", "pick_and_place")
    room.settle()
    start(lab, room)
    room.until(f"{VIEW}.holding !== ''")
    room.act(ROBOT, "play")
    room.until(f"{VIEW}.state === 'PAUSED'")
    room.stand(0.1, -1.9, 0.35, 0.9)


def start(lab: ServedLab, room: EmulatedRoom) -> None:
    """Load the example and play it: at once, as a command takes some seconds to end."""
    lab.done("load", "ur5e_1", str(MOTION))
    room.until(f"{VIEW}.state === 'READY' && room.follower.course('ur5e_1')")
    room.act(ROBOT, "play")


def board(room: EmulatedRoom, shown: bool) -> None:
    """Show the board, or leave it out of the picture."""
    room.page.evaluate(f"room.board.panel.group.visible = {str(shown).lower()}")


def catalogue(lab: ServedLab, room: EmulatedRoom) -> None:
    """Robots to choose from, and one on the floor."""
    room.stand(0.05, -2.0, 0.35, 0.9)
    board(room, True)
    room.hands((0.02, 1.12, -0.15))
    room.look((0.0, 1.6, 0.1), (-0.35, 1.2, -1.6), 74)


def motion(lab: ServedLab, room: EmulatedRoom) -> None:
    """A motion half way: panel, path of the tool, cubes at grasp and release."""
    carry(lab, room)
    board(room, False)
    room.hands(None)
    room.act(ROBOT, "show", "path", "back")
    seek(room, 0.5)
    room.look(EYES, (0.42, 0.85, -1.9))


def reach(lab: ServedLab, room: EmulatedRoom) -> None:
    """How far a robot reaches, and another motion as its ghost."""
    room.act(ROBOT, "show", "reach", "compare", "choose quintic_ur5e@1")
    room.until("room.drawings.reference('ur5e_1') !== null")
    room.look((0.15, 1.6, 0.45), (0.2, 0.72, -1.9), 64)


def telemetry(lab: ServedLab, room: EmulatedRoom) -> None:
    """What a robot measures while it plays."""
    room.act(ROBOT, "reach", "compare", "choose ", "path", "back", "telemetry", "stop")
    lab.done("scene", "load", "pick_and_place")
    room.settle()
    room.look((0.25, 1.55, 0.25), (0.85, 1.05, -1.9), 74)
    start(lab, room)
    room.until(f"{VIEW}.state === 'PLAYING' && {VIEW}.player.position() > 4")
    room.act(ROBOT, "play")


def halt(lab: ServedLab, room: EmulatedRoom) -> None:
    """An arm that a real table stopped."""
    lab.done("scene", "load", "empty")
    lab.done("spawn", "ur5e", "--at", "0,0", "--tool", "parallel_gripper")
    room.settle()
    room.stand(-1.15, -1.5, -0.3, 0.95)
    room.frames(3)
    start(lab, room)
    room.until(f"{VIEW}.state === 'COLLISION_HALT'")
    board(room, False)
    room.look((0.6, 1.5, -1.85), (-1.1, 0.72, -1.7))


def system(lab: ServedLab, room: EmulatedRoom) -> None:
    """Two robots that hand over, with one panel for both."""
    lab.done("scene", "load", "handover")
    lab.done("system", "create", str(CELL))
    room.stand(-0.35, -1.95, 1.0, 0.0)
    room.settle()
    lab.done("system", "play", "handover")
    room.until("room.follower.systems.value[0]?.system.label === 'PLAYING'")
    room.frames(8)
    room.act(SYSTEM, "play")
    room.look((0.25, 1.6, 0.45), (0.4, 0.75, -1.9), 68)


SHOTS: dict[str, Callable[[ServedLab, EmulatedRoom], None]] = {
    each.__name__: each for each in (catalogue, motion, reach, telemetry, halt, system)
}


def pictures(lab: ServedLab, room: EmulatedRoom, names: list[str]) -> None:
    """Write pictures of docs/room.md. `reach` and `telemetry` go on from those before them."""
    PICTURES.mkdir(exist_ok=True)
    for name in names:
        SHOTS[name](lab, room)
        path = PICTURES / f"{name}.webp"
        room.shot().save(path, quality=84, method=6)
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e3:.0f} kB", flush=True)


def animation(lab: ServedLab, room: EmulatedRoom, count: int) -> list[Image.Image]:
    """Return the room at `count` times, evenly over the motion, the eyes going round a little."""
    carry(lab, room)
    board(room, False)
    room.act(ROBOT, "show", "path", "back")
    found = []
    for number in range(count):
        share = number / (count - 1)
        seek(room, share)
        room.look((0.45 - 0.5 * share, 1.5, 0.05), (0.28, 0.8, -1.9), 62, settle=False)
        found.append(room.shot())
        print(f"{number + 1} of {count}", flush=True)
    return found


def write(shown: list[Image.Image], target: Path) -> None:
    """Write the animation."""
    first, *rest = shown
    first.save(
        target,
        save_all=True,
        append_images=rest,
        duration=[1000 // RATE] * len(rest) + [1200],
        loop=0,
        quality=QUALITY,
        method=6,
    )
    print(f"{target}: {target.stat().st_size / 1e3:.0f} kB")


def main() -> None:
    """Write the animation, or the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT, help="frames of the animation")
    parser.add_argument("--target", type=Path, default=TARGET)
    parser.add_argument(
        "--pictures",
        nargs="*",
        choices=list(SHOTS),
        help="write the pictures of docs/room.md, or those that are named",
    )
    arguments = parser.parse_args()
    path = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as folder, served_lab(Path(folder)) as lab:
        lab.done("tool", "ur5e_1", "parallel_gripper")
        lab.done("load", "ur5e_1", str(OTHER))
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=path, args=list(ARGUMENTS))
            room = EmulatedRoom(browser, CLIP if arguments.pictures is None else SIZE)
            room.enter(lab.signed_in_url("/room"), lab.url)
            if arguments.pictures is None:
                write(animation(lab, room, arguments.count), arguments.target)
            else:
                pictures(lab, room, arguments.pictures or list(SHOTS))
            browser.close()


if __name__ == "__main__":
    main()
