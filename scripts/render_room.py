#!/usr/bin/env python3
"""Render docs/images/room.webp, an animation of the room, of a lab that it starts.

Needs Chromium, the built pages and what the tests need; takes some minutes where there is no GPU.
"""

from __future__ import annotations

import argparse
import io
import shutil
import sys
import tempfile
import time
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "test"))

from served_lab import ServedLab, served_lab  # noqa: E402

MOTION = ROOT / "examples" / "pick_and_place_ur5e.mat"
CELL = ROOT / "examples" / "handover_cell.yaml"
TARGET = ROOT / "docs" / "images" / "room.webp"
PICTURES = ROOT / "docs" / "images" / "pages"
SIZE = (760, 460)  # CSS pixels, and pixels of the file
COUNT = 38
RATE = 6  # frames a second
QUALITY = 60
ARGUMENTS = ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader")
# s for the page and for a pose to be there.
PATIENCE = 240
SETTLE_MS = 900
# The room alone, without the bar of the pages and what they say.
VIEW = """() => {
  for (const part of document.querySelectorAll('header, .room-hops, .room-bar'))
    part.style.display = 'none'
  const view = document.querySelector('.room-view')
  Object.assign(view.style, { position: 'fixed', inset: '0', width: '100vw', height: '100vh' })
}"""
PANEL = "room.panels.of('ur5e_1').panel"


def until(page: Page, condition: str) -> None:
    """Wait until a condition holds in the page; raises SystemExit where it does not."""
    end = time.monotonic() + PATIENCE
    while not page.evaluate(f"Boolean({condition})"):
        if time.monotonic() > end:
            raise SystemExit(f"it took too long until {condition}")
        time.sleep(0.2)


def enter(lab: ServedLab, page: Page) -> None:
    """Open the room and wait until its robot is drawn."""
    page.goto(lab.signed_in_url("/room"))
    page.goto(f"{lab.url}/room?inspect")
    until(page, "window.room && room.scene.robot('ur5e_1')?.meshesHere > 5")
    page.evaluate("room.guide.panel.panel.act('skip_tour')")


def look(page: Page, eyes: tuple[float, float, float], at: tuple[float, float, float]) -> None:
    """Look from one place of the scene at another, m."""
    page.evaluate(
        "([eyes, at]) => { room.stage.camera.position.set(...eyes);"
        " room.stage.controls.target.set(...at) }",
        [eyes, at],
    )


def shot(page: Page) -> Image.Image:
    """Return the page as it is, once it is drawn."""
    drawn = page.evaluate("room.frames")
    page.evaluate("room.stage.invalidate()")
    page.wait_for_timeout(SETTLE_MS)
    until(page, f"(room.stage.invalidate(), room.frames > {drawn + 2})")
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def keep(name: str, page: Page) -> None:
    """Write a picture of the docs."""
    path = PICTURES / f"{name}.webp"
    shot(page).save(path, quality=82, method=6)
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB", flush=True)


def pictures(lab: ServedLab, page: Page) -> None:
    """Write the pictures of docs/room.md."""
    page.set_viewport_size({"width": 1200, "height": 720})
    enter(lab, page)
    look(page, (0.15, 1.5, 0.9), (0.0, 0.72, -1.5))
    keep("room-catalogue", page)
    lab.done("play", "ur5e_1", str(MOTION), "--no-wait")
    until(page, "room.follower.course('ur5e_1')")
    page.evaluate("room.board.panel.group.visible = false")
    page.evaluate(f"{PANEL}.act('show'), {PANEL}.act('path'), {PANEL}.act('reach')")
    lab.done("stop", "ur5e_1")
    seek(page, 0.45)
    look(page, (0.5, 1.35, 0.55), (0.2, 0.5, -1.5))
    keep("room-path", page)
    page.evaluate(f"{PANEL}.act('reach'), {PANEL}.act('back'), {PANEL}.act('telemetry')")
    lab.done("play", "ur5e_1", str(MOTION), "--no-wait")
    page.wait_for_timeout(9000)
    look(page, (-0.2, 1.35, 0.35), (0.35, 0.6, -1.5))
    keep("room-telemetry", page)
    page.evaluate(f"{PANEL}.act('telemetry')")
    lab.done("stop", "ur5e_1")
    lab.done("remove", "ur5e_1")
    lab.done("scene", "load", "handover")
    lab.done("system", "create", str(CELL))
    until(page, "room.systems.of('handover')?.panel.ids.includes('play')")
    until(page, "[...room.handles.keys()].every(n => room.scene.robot(n)?.meshesHere > 5)")
    lab.done("system", "play", "handover")
    page.wait_for_timeout(4000)
    page.evaluate("room.systems.of('handover').panel.act('play')")
    look(page, (0.6, 1.5, 0.9), (0.1, 0.55, -1.4))
    keep("room-system", page)


def seek(page: Page, share: float) -> None:
    """Go to a share of the motion and wait until the robot is there."""
    player = "room.follower.robots.value[0].player"
    page.evaluate(f"{player}.seek({player}.duration * {share})")
    page.wait_for_timeout(SETTLE_MS)


def frames(lab: ServedLab, page: Page, count: int) -> list[Image.Image]:
    """Return the room at `count` times, evenly over the motion."""
    enter(lab, page)
    lab.done("play", "ur5e_1", str(MOTION), "--no-wait")
    until(page, "room.follower.course('ur5e_1')")
    page.evaluate("room.board.panel.group.visible = false")
    page.evaluate(f"{PANEL}.act('show'), {PANEL}.act('path')")
    page.evaluate(f"{PANEL}.act('back')")
    page.evaluate(VIEW)
    look(page, (0.75, 1.3, 0.25), (0.3, 0.55, -1.4))
    lab.done("stop", "ur5e_1")
    found = []
    for number in range(count):
        seek(page, number / (count - 1))
        found.append(shot(page).resize(SIZE))
        print(f"{number + 1} of {count}", flush=True)
    return found


def main() -> None:
    """Write the animation, or the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--target", type=Path, default=TARGET)
    parser.add_argument(
        "--pictures", action="store_true", help="write the pictures of docs/room.md"
    )
    arguments = parser.parse_args()
    path = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as folder, served_lab(Path(folder)) as lab:
        lab.done("tool", "ur5e_1", "parallel_gripper")
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=path, args=list(ARGUMENTS))
            page = browser.new_page(
                viewport={"width": SIZE[0], "height": SIZE[1]},
                color_scheme="light",
                locale="en-GB",
            )
            page.set_default_timeout(PATIENCE * 1000)
            if arguments.pictures:
                pictures(lab, page)
            else:
                write(frames(lab, page, arguments.count), arguments.target)
            browser.close()


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


if __name__ == "__main__":
    main()
