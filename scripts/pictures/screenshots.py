#!/usr/bin/env python3
"""Take the pictures of docs/pages.md: every page of a lab, phone and desktop, both themes.

python scripts/pictures/screenshots.py             all
python scripts/pictures/screenshots.py upload lab  these pages
python scripts/pictures/screenshots.py clip        the clip of the first tutorial, twice
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import Browser, Page, expect, sync_playwright
from scipy.io import loadmat, savemat

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(path) for path in (ROOT / "test" / "support").iterdir()]

import student_files  # noqa: E402
from browser_side import eventually  # noqa: E402
from page_objects import SignInPage, UploadPage  # noqa: E402
from served_lab import Gateway, ServedLab, gateway_with_people, served_lab  # noqa: E402

from mrlab_ros.core.bridge.rules import Role  # noqa: E402

IMAGES = ROOT / "docs" / "images" / "pages"
# Pages without 3D are drawn faster without a GPU of software.
PLAIN = ("--no-sandbox", "--disable-gpu")
FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader")
# Width and height of the window, px, and how many pixels of the picture one of them is.
SIZES = {"desktop": (1280, 860, 1.0), "phone": (390, 844, 1.5)}
THEMES = ("light", "dark")
LOCALES = ("en-GB", "de-DE")
QUALITY = 82
# Of a clip: the window, and the pixels of the file.
CLIP_SIZE = {"width": 1100, "height": 620}
CLIP_PIXELS = (880, 496)
CLIP_QUALITY = 60
PASSWORD = "long enough to be one"
# Software draws slowly on few cores, ms.
PATIENCE_MS = 90_000
# Until what moves stands still, ms.
SETTLE_MS = 700
# A machine that draws slowly gets fewer pixels while something moves: is the picture whole again?
SHARP = """() => [...document.querySelectorAll('canvas.scene-canvas')].every(
  (canvas) => canvas.width >= Math.floor(canvas.clientWidth * devicePixelRatio))"""


@dataclass(frozen=True)
class Stage:
    """What the pages are taken of; files: a folder of student_files."""

    lab: ServedLab
    gateway: Gateway
    files: Path


def start(page: Page, stage: Stage) -> None:
    page.goto(stage.gateway.url)
    page.locator(".picker-choice").first.wait_for()
    # not the network's silence: the page always waits for the next motion of a program
    whole = "[...document.images].every((image) => image.complete || image.loading === 'lazy')"
    eventually(page, lambda: bool(page.evaluate(whole)))


def sent(page: Page, stage: Stage, file: Path) -> UploadPage:
    start(page, stage)
    upload = UploadPage(page)
    upload.send(file)
    return upload


def accepted(page: Page, stage: Stage) -> None:
    sent(page, stage, ROOT / "examples" / "quintic_ur5e.mat").wait_for_robot()
    page.get_by_label("Time").fill("2.4")


def refused(page: Page, stage: Stage) -> None:
    upload = sent(page, stage, student_files.beyond(stage.files))
    upload.wait_for_robot()
    upload.finding("joint_limit").get_by_role("button", name="rows").click()


def chooser(page: Page, stage: Stage) -> None:
    sent(page, stage, student_files.ambiguous(stage.files)).wait_for_robot()


def published(page: Page, stage: Stage) -> None:
    upload = sent(page, stage, ROOT / "examples" / "quintic_ur5e.mat")
    upload.wait_for_robot()
    upload.publish("quintic", shared=True)
    page.evaluate("scrollTo(0, 0)")


def marked(page: Page, stage: Stage) -> None:
    """The class of the teacher's tutorial: a motion, whole and as students hand it in."""
    handed_in = stage.files / "submissions"
    if not handed_in.exists():
        handed_in.mkdir()
        example = loadmat(ROOT / "examples" / "pick_and_place_ur5e.mat")
        q, fs = example["q"], example["fs"]
        for name, made in {
            "Ada": (q, fs),
            "Alan": (q[: len(q) * 3 // 4], fs),
            "Edsger": (np.rad2deg(q), fs),
            "Grace": (q, fs * 0.8),
            "Kurt": (q[::-1], fs),
        }.items():
            savemat(handed_in / f"{name}.mat", {"q": made[0], "fs": made[1]})
        rubric = ROOT / "examples" / "rubrics" / "pick_and_place.yaml"
        words = ("class", handed_in, "--rubric", rubric, "--out", stage.files / "marked")
        subprocess.run([sys.executable, "-m", "mrlab_ros.cli", *words], check=True)
    page.goto((stage.files / "marked" / "index.html").as_uri())


def first_motion(page: Page, stage: Stage, steps: int = 40) -> Iterator[int]:
    """The first tutorial: a file in degrees, the press that mends it, its motion.

    Yields for how long each picture stands, ms; steps: pictures of the motion.
    """
    q = np.tile([0.0, -90.0, 90.0, -90.0, -90.0, 0.0], (401, 1))
    q[:, 0] = 30 * (1 - np.cos(2 * np.pi * np.arange(401) / 400))
    file = stage.files / "my_motion.mat"
    savemat(file, {"q": q, "fs": 100.0})
    start(page, stage)
    yield 1500
    page.locator("input[type=file]").set_input_files(file)
    finding = page.locator(".finding[data-code=degrees]")
    finding.wait_for()
    UploadPage(page).wait_for_robot()
    yield 2500
    fix = finding.locator("button:has(svg)").first
    fix.focus()
    yield 700
    fix.click()
    finding.wait_for(state="detached")
    UploadPage(page).wait_for_robot()
    yield 1200
    slider = page.locator("input[type=range]").first
    for time_s in np.linspace(0, 4, steps):
        slider.fill(f"{time_s:.2f}")
        yield 100


def trajectories(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/trajectories")
    page.locator(".trajectory").first.wait_for()


def comparison(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/trajectories/ada/wide?with=ada%2Fnarrow")
    page.locator(".comparison-result").wait_for()
    UploadPage(page).wait_for_robot()
    page.get_by_label("Time").fill("1")


def lab(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/lab")
    page.locator("canvas").first.wait_for()
    page.wait_for_load_state("networkidle")
    page.wait_for_timeout(5 * SETTLE_MS)


def people(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/people")
    page.locator("[data-device]").first.wait_for()


def sign_in(page: Page, stage: Stage) -> None:
    page.context.clear_cookies()
    page.goto(f"{stage.gateway.url}/sign-in")
    page.get_by_label("Password").wait_for()


def pair(page: Page, stage: Stage) -> None:
    page.context.clear_cookies()
    page.goto(f"{stage.gateway.url}/pair")
    page.locator(".qr").wait_for()


def invitation(page: Page, stage: Stage) -> None:
    link = stage.gateway.invite(f"grace{time.monotonic_ns() % 10**6}", Role.STUDENT)
    page.context.clear_cookies()
    page.goto(link)
    page.get_by_label("The same again").wait_for()


WITH_3D = ("accepted", "refused", "chooser", "published", "comparison", "lab")
PAGES: dict[str, Callable[[Page, Stage], None]] = {
    "upload": start,
    "accepted": accepted,
    "refused": refused,
    "chooser": chooser,
    "published": published,
    "marked": marked,
    "trajectories": trajectories,
    "comparison": comparison,
    "lab": lab,
    "people": people,
    "sign-in": sign_in,
    "pair": pair,
    "invitation": invitation,
}


def prepare(page: Page, stage: Stage) -> None:
    """Let the teacher in whose pages are shown, with a few trajectories and people."""
    page.set_default_timeout(PATIENCE_MS)
    SignInPage(page).accept(stage.gateway.invite("ada", Role.INSTRUCTOR), PASSWORD)
    for name, role in (
        ("grace", Role.STUDENT),
        ("alan", Role.STUDENT),
        ("projector", Role.DISPLAY),
    ):
        stage.gateway.invite(name, role)
    for name, size in (("narrow", 0.4), ("wide", 0.6), ("wide", 0.7)):
        upload = sent(page, stage, student_files.good(stage.files, f"{name}.mat", size))
        upload.publish(name, shared=name == "wide")


def picture(page: Page) -> Image.Image:
    """Return the page as it is once all of it is sharp."""
    eventually(page, lambda: bool(page.evaluate(SHARP)))
    return Image.open(io.BytesIO(page.screenshot(timeout=PATIENCE_MS))).convert("RGB")


def take_clip(browser: Browser, stage: Stage, cookies: Path) -> None:
    """Write the clip of the first tutorial in the languages that it has."""
    for locale in LOCALES:
        context = browser.new_context(
            viewport=CLIP_SIZE, locale=locale, reduced_motion="reduce", storage_state=cookies
        )
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        lasts, taken = [], []
        for stands_ms in first_motion(page, stage):
            lasts.append(stands_ms)
            taken.append(picture(page).resize(CLIP_PIXELS, Image.Resampling.LANCZOS))
        file = IMAGES / f"first_motion-{locale[:2]}.webp"
        rest = {"append_images": taken[1:], "duration": lasts, "loop": 0}
        taken[0].save(file, save_all=True, quality=CLIP_QUALITY, method=6, **rest)
        print(file.relative_to(ROOT), f"{file.stat().st_size / 1000:.0f} kB", flush=True)
        context.close()


def take(browsers: tuple[Browser, Browser], stage: Stage, cookies: Path, names: list[str]) -> None:
    """Write the pictures of the pages `names`; browsers: for pages without and with 3D."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name in names:
        for size, (width, height, scale) in SIZES.items():
            context = browsers[name in WITH_3D].new_context(
                viewport={"width": width, "height": height},
                device_scale_factor=scale,
                color_scheme="light",
                locale="en-GB",
                reduced_motion="reduce",
                storage_state=cookies,
            )
            page = context.new_page()
            page.set_default_timeout(PATIENCE_MS)
            PAGES[name](page, stage)
            for theme in THEMES:
                page.emulate_media(color_scheme=theme)  # type: ignore[arg-type]
                page.wait_for_timeout(SETTLE_MS)
                image = picture(page)
                file = IMAGES / f"{name}-{size}-{theme}.webp"
                image.save(file, quality=QUALITY, method=6)
                print(file.relative_to(ROOT), flush=True)
            context.close()


@contextmanager
def staged(*options: str) -> Iterator[tuple[tuple[Browser, Browser], Stage, Path]]:
    """Start a lab and let the teacher in; yield browsers without and with 3D, and the cookies.

    options: of the gateway.
    """
    expect.set_options(timeout=PATIENCE_MS)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        place = Path(folder)
        for part in ("lab", "gateway", "files"):
            (place / part).mkdir()
        chromium = shutil.which("chromium")
        plain = playwright.chromium.launch(executable_path=chromium, args=PLAIN)
        drawing = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        with (
            served_lab(place / "lab") as there,
            gateway_with_people(there, place / "gateway", 0, *options) as gateway,
        ):
            stage = Stage(there, gateway, place / "files")
            context = plain.new_context(locale="en-GB")
            prepare(context.new_page(), stage)
            cookies = place / "cookies.json"
            context.storage_state(path=cookies)
            context.close()
            yield (plain, drawing), stage, cookies
        plain.close()
        drawing.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pages", nargs="*", metavar="page", help=", ".join([*PAGES, "clip"]))
    names = parser.parse_args().pages or [*PAGES, "clip"]
    with staged() as (browsers, stage, cookies):
        take(browsers, stage, cookies, [name for name in names if name != "clip"])
        if "clip" in names:
            take_clip(browsers[1], stage, cookies)


if __name__ == "__main__":
    main()
