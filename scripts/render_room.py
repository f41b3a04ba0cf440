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
TARGET = ROOT / "docs" / "images" / "room.webp"
SIZE = (760, 460)  # CSS pixels, and pixels of the file
COUNT = 38
RATE = 6  # frames a second
QUALITY = 60
ARGUMENTS = ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader")
# s for the page and for a pose to be there.
PATIENCE = 240
SETTLE_MS = 900
# The room alone, without the bar of the pages and what they say; eyes a step to the right.
VIEW = """() => {
  for (const part of document.querySelectorAll('header, .room-hops, .room-bar'))
    part.style.display = 'none'
  const view = document.querySelector('.room-view')
  Object.assign(view.style, { position: 'fixed', inset: '0', width: '100vw', height: '100vh' })
  room.stage.camera.position.set(0.25, 1.5, 0.75)
  room.stage.controls.target.set(0.3, 0.72, -1.5)
}"""
PANEL = "room.panels.of('ur5e_1').panel"


def until(page: Page, condition: str) -> None:
    """Wait until a condition holds in the page; raises SystemExit where it does not."""
    end = time.monotonic() + PATIENCE
    while not page.evaluate(f"Boolean({condition})"):
        if time.monotonic() > end:
            raise SystemExit(f"it took too long until {condition}")
        time.sleep(0.2)


def frames(lab: ServedLab, page: Page, count: int) -> list[Image.Image]:
    """Return the room at `count` times, evenly over the motion."""
    page.goto(lab.signed_in_url("/room"))
    page.goto(f"{lab.url}/room?inspect")
    until(page, "window.room && room.scene.robot('ur5e_1')?.meshesHere > 5")
    lab.done("play", "ur5e_1", str(MOTION), "--no-wait")
    until(page, "room.follower.course('ur5e_1')")
    page.evaluate(f"{PANEL}.act('show'), {PANEL}.act('path'), {PANEL}.act('reach')")
    page.evaluate(f"{PANEL}.act('back')")
    page.evaluate(VIEW)
    lab.done("stop", "ur5e_1")
    found = []
    player = "room.follower.robots.value[0].player"
    for number in range(count):
        page.evaluate(f"{player}.seek({player}.duration * {number / (count - 1)})")
        page.wait_for_timeout(SETTLE_MS)
        shown = page.screenshot()
        found.append(Image.open(io.BytesIO(shown)).convert("RGB").resize(SIZE))
        print(f"{number + 1} of {count}", flush=True)
    return found


def main() -> None:
    """Write the animation."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--target", type=Path, default=TARGET)
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
            first, *rest = frames(lab, page, arguments.count)
            browser.close()
    first.save(
        arguments.target,
        save_all=True,
        append_images=rest,
        duration=[1000 // RATE] * len(rest) + [1200],
        loop=0,
        quality=QUALITY,
        method=6,
    )
    print(f"{arguments.target}: {arguments.target.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
