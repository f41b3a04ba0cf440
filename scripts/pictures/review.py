#!/usr/bin/env python3
"""Take pictures of every page, state and report, for who changes them: nothing of it is kept.

python scripts/pictures/review.py FOLDER             all
python scripts/pictures/review.py FOLDER upload lab  these pages

From top to bottom at three widths, in both themes and languages; a report also as PDF, as a
printer gets it.
"""

from __future__ import annotations

import argparse
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import screenshots
from playwright.sync_api import Browser, Error, Page, WebSocketRoute
from screenshots import LOCALES, PAGES, PATIENCE_MS, ROOT, SETTLE_MS, SHARP, THEMES, Stage

import student_files  # isort: skip
from browser_side import eventually  # isort: skip
from class_folder import make_class  # isort: skip
from page_objects import UploadPage  # isort: skip

# Width and height of the window, px.
SIZES = ((390, 844), (820, 1180), (1440, 900))
MOTION = ROOT / "examples" / "quintic_ur5e.mat"
PICK = ROOT / "examples" / "pick_and_place_ur5e.mat"
MRLAB = (sys.executable, "-m", "mrlab_ros.cli")
ROBOTS = 13
# Presses the language in the account's menu, whatever covers it.
SPEAK = """(locale) => {
  const name = new Intl.DisplayNames([locale], { type: 'language' }).of(locale.slice(0, 2))
  const menu = document.querySelector('.header .menu > button')
  const shut = menu.ariaExpanded !== 'true'
  if (shut) menu.click()
  requestAnimationFrame(() => {
    const choices = document.querySelectorAll('.account-choice :is(button, label)')
    ;[...choices].find((each) => each.textContent.trim() === name).click()
    if (shut) menu.click()
  })
}"""


def report(page: Page, stage: Stage, *command: object) -> None:
    """Open the page that a command writes."""
    file = stage.files / f"{command[0]}-{Path(str(command[1])).stem}.html"
    if not file.exists():
        # a refused file ends with 1 and is written all the same
        subprocess.run((*MRLAB, *map(str, command), "-o", str(file)), check=False)
    page.goto(file.as_uri())
    page.locator("html[data-ready]").wait_for()


def motion_report(page: Page, stage: Stage) -> None:
    report(page, stage, "show", MOTION, "--robot", "ur5e")


def refused_report(page: Page, stage: Stage) -> None:
    report(page, stage, "show", student_files.beyond(stage.files), "--robot", "ur5e")


def check_report(page: Page, stage: Stage) -> None:
    report(page, stage, "check", PICK, "--robot", "ur5e", "--scene", "table")


def session_report(page: Page, stage: Stage) -> None:
    report(page, stage, "show", recorded(stage))


def marked_row(page: Page, stage: Stage) -> None:
    screenshots.marked(page, stage)
    page.locator("tbody tr").nth(1).get_by_role("link").first.click()
    page.locator("html[data-ready]").wait_for()


def recorded(stage: Stage) -> Path:
    """Return a bag in the recorder's folder in which the robot plays the example."""
    bag = stage.lab.state / "recordings" / "lesson"
    if not bag.exists():
        command = (*MRLAB, "record", str(bag), "--json")
        recorder = subprocess.Popen(
            command, env=stage.lab.environment, stdout=subprocess.PIPE, text=True
        )
        assert recorder.stdout is not None
        recorder.stdout.readline()
        stage.lab.done("play", "ur5e_1", str(MOTION))
        recorder.send_signal(signal.SIGINT)
        recorder.communicate()
    return bag


def topics(page: Page, stage: Stage) -> None:
    screenshots.lab(page, stage)
    page.get_by_role("button", name="Topics").click()
    drawer = page.get_by_role("region", name="Topics")
    drawer.get_by_role("searchbox").fill("ur5e_1/joint_st")
    drawer.get_by_role("button", name="ur5e_1/joint_states sensor_msgs").click()
    numbers = drawer.locator("summary", has_text="position").locator("..")
    numbers.get_by_role("checkbox").first.check()


def adding(page: Page, stage: Stage) -> None:
    screenshots.lab(page, stage)
    page.get_by_role("button", name="Add a robot").click()
    page.get_by_role("dialog").get_by_role("radio").first.wait_for(state="attached")


def joining(page: Page, stage: Stage) -> None:
    screenshots.lab(page, stage)
    page.get_by_role("button", name="Join on your phone").click()


def replay(page: Page, stage: Stage) -> None:
    bag = recorded(stage)
    screenshots.lab(page, stage)
    card = page.get_by_role("article").filter(has_text="Recordings")
    card.get_by_role("searchbox").fill(str(bag))
    card.get_by_role("searchbox").press("Enter")
    card.get_by_role("slider").wait_for()
    page.wait_for_timeout(5 * SETTLE_MS)


def lost(page: Page, stage: Stage) -> None:
    links: list[WebSocketRoute] = []

    def connect(socket: WebSocketRoute) -> None:
        if links:
            socket.close(code=1011)
        else:
            socket.connect_to_server()
            links.append(socket)

    page.route_web_socket("**/link", connect)
    screenshots.lab(page, stage)
    links[0].close(code=1011)
    page.get_by_text("this is what was last known").wait_for()


def many(page: Page, stage: Stage) -> None:
    """Thirteen robots, until the lab ends: it is the last page."""
    for _ in range(stage.lab.done("status").count("ur5e_"), ROBOTS):
        stage.lab.done("spawn", "ur5e")
    screenshots.lab(page, stage)


def motion(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/trajectories/ada/wide")
    UploadPage(page).wait_for_robot()


def graded(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/class/ben")
    page.get_by_role("region", name="Marks").wait_for()
    UploadPage(page).wait_for_robot()


def room(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/room")
    page.wait_for_timeout(10 * SETTLE_MS)


def nothing(page: Page, stage: Stage) -> None:
    page.goto(f"{stage.gateway.url}/nothing")
    page.get_by_role("heading").first.wait_for()


def account(page: Page, stage: Stage) -> None:
    nothing(page, stage)
    page.get_by_role("button", name="Account").click()


def token(page: Page, stage: Stage) -> None:
    screenshots.people(page, stage)
    page.get_by_role("button", name="Add a program").click()


def used(page: Page, stage: Stage) -> None:
    page.context.clear_cookies()
    page.goto(f"{stage.gateway.url}/invitation/used")
    page.get_by_role("heading", name="This link cannot be used").wait_for()


# Opened from the disk: they speak the browser's language, and are printed.
REPORTS: dict[str, Callable[[Page, Stage], None]] = {
    "motion-report": motion_report,
    "refused-report": refused_report,
    "check-report": check_report,
    "session-report": session_report,
    "marked": screenshots.marked,
    "marked-row": marked_row,
}
STATES: dict[str, Callable[[Page, Stage], None]] = {
    **PAGES,
    **REPORTS,
    **{
        each.__name__: each
        for each in (
            motion, graded, room, nothing, account, token, used, topics, adding, joining, replay,
            lost, many,
        )
    },
}  # fmt: skip
# Without a GPU of software they are there sooner.
WITHOUT_3D = ("upload", "marked", "trajectories", "people", "sign-in", "pair", "invitation",
              "used", "nothing", "account", "token")  # fmt: skip


def whole(page: Page, file: Path) -> None:
    """Write the pictures of a page as it is now."""
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        for theme in THEMES:
            page.emulate_media(color_scheme=theme)  # type: ignore[arg-type]
            page.wait_for_timeout(SETTLE_MS)
            eventually(page, lambda: bool(page.evaluate(SHARP)))
            page.screenshot(path=f"{file}-{width}-{theme}.png", full_page=True)
    if page.url.startswith("file:"):
        page.pdf(path=f"{file}.pdf", format="A4", print_background=True)
    print(file.name, flush=True)


def review(browser: Browser, stage: Stage, cookies: Path, name: str, folder: Path) -> None:
    """Write the pictures of one page."""
    for locale in LOCALES if name in REPORTS else LOCALES[:1]:
        context = browser.new_context(
            locale=locale,
            reduced_motion="reduce",
            storage_state=cookies,
            viewport={"width": SIZES[-1][0], "height": SIZES[-1][1]},
        )
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        try:
            STATES[name](page, stage)
            for spoken in (locale,) if name in REPORTS else LOCALES:
                if spoken != locale:
                    page.evaluate(SPEAK, spoken)
                whole(page, folder / f"{name}-{spoken[:2]}")
        except (AssertionError, Error) as error:
            print(f"{name}: {error}", flush=True)
        context.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("pages", nargs="*", metavar="page", help=", ".join(STATES))
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        marks = make_class(Path(folder) / "class", frames=200)
        with screenshots.staged("--classroom", str(marks)) as (browsers, stage, cookies):
            for name in asked.pages or STATES:
                browser = browsers[name not in WITHOUT_3D]
                review(browser, stage, cookies, name, asked.folder)


if __name__ == "__main__":
    main()
