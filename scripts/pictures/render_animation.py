#!/usr/bin/env python3
"""Render docs/images/motion.webp, the animation at the top of README, from `mrlab show`.

Needs Chromium and the built pages; takes some minutes where there is no GPU.
"""

from __future__ import annotations

import argparse
import io
import shutil
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright
from typer.testing import CliRunner

from mrlab_ros.cli import make_app

ROOT = Path(__file__).resolve().parents[2]
MOTION = ROOT / "examples" / "pick_and_place_ur5e.mat"
TARGET = ROOT / "docs" / "images" / "motion.webp"
SIZE = (760, 430)  # CSS pixels, and pixels of the file
RATE = 10  # frames a second
DURATION = 7.6  # s
QUALITY = 62
ARGUMENTS = ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader")
# The picture alone, without title, controls and plots.
PLAIN = """
  document.body.replaceChildren(document.getElementById('view'))
  const view = document.getElementById('view')
  Object.assign(document.body.style, { margin: '0', padding: '0', maxWidth: 'none' })
  Object.assign(view.style, { width: '100vw', height: '100vh' })
"""
SEEK = """(time) => {
  const slider = document.querySelector('.scene-time')
  slider.value = time
  slider.dispatchEvent(new Event('input'))
}"""
# Where it draws slowly, the picture becomes sharp this long after the last change.
SHARP_MS = 700


def frames(page_file: Path, count: int) -> list[Image.Image]:
    """Return the picture at `count` times, evenly over the motion."""
    found = []
    path = shutil.which("chromium") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(ARGUMENTS))
        page = browser.new_page(
            viewport={"width": SIZE[0], "height": SIZE[1]},
            reduced_motion="reduce",
            color_scheme="light",
        )
        page.set_default_timeout(180_000)
        page.goto(page_file.as_uri())
        page.locator("html[data-ready]").wait_for(state="attached")
        page.evaluate(PLAIN)
        for number in range(count):
            page.evaluate(SEEK, number * DURATION / (count - 1))
            page.wait_for_timeout(SHARP_MS)
            shown = page.locator(".scene-view").screenshot()
            found.append(Image.open(io.BytesIO(shown)).convert("RGB").resize(SIZE))
        browser.close()
    return found


def main() -> None:
    """Write the animation."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=int(DURATION * RATE))
    parser.add_argument("--target", type=Path, default=TARGET)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        tool = ["--end-effector", "parallel_gripper"]
        command = ["show", str(MOTION), "--robot", "ur5e", *tool, "-o", str(page)]
        done = CliRunner().invoke(make_app(), command, catch_exceptions=False)
        if done.exit_code:
            raise SystemExit(done.output)
        first, *rest = frames(page, arguments.count)
    # The last picture stands a moment before it begins again.
    lengths = [1000 // RATE] * len(rest) + [1200]
    first.save(
        arguments.target,
        save_all=True,
        append_images=rest,
        duration=lengths,
        loop=0,
        quality=QUALITY,
        method=6,
    )
    print(f"{arguments.target}: {arguments.target.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
