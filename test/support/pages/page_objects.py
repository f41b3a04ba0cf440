"""What a person sees and does on each page, by roles and names as a screen reader has them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from browser_side import difference, eventually, pixels
from playwright.sync_api import Locator, Page, expect


class UploadPage:
    """`/`: from a file to a motion that is published."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.verdict = page.get_by_role("article")
        self.canvas = page.locator(".motion-scene canvas.scene-canvas")
        self.findings = page.locator(".finding")
        self.strips = page.locator(".strip")

    def send(self, file: Path) -> None:
        """Choose a file; wait for its verdict."""
        self.page.get_by_role("radio", name="UR5e").wait_for(state="attached")
        self.page.locator("input[type=file]").set_input_files(file)
        self.verdict.wait_for()

    def outcome(self, word: str) -> Locator:
        """Return the chip that says what became of the file."""
        return self.verdict.locator(".chip", has_text=word)

    def finding(self, code: str) -> Locator:
        return self.page.locator(f".finding[data-code={code}]")

    def wait_for_robot(self) -> None:
        """Wait until every mesh of the robot is there: the picture is whole and stands still."""
        self.canvas.wait_for()
        expect(self.page.locator(".scene-note")).to_be_hidden()
        # not the network's silence: the page always waits for the next motion of a program
        before = [self.picture()]

        def stands() -> bool:
            before.append(self.picture())
            return difference(*before[-2:]) == 0.0 and len(np.unique(before[-1])) > 20

        eventually(self.page, stands)

    def picture(self) -> np.ndarray:
        """Return the pixels of the 3D view, (height, width, 3)."""
        return pixels(self.canvas)

    def publish(self, name: str, *, shared: bool = False) -> None:
        """Publish under a name; wait until it is done."""
        self.page.get_by_label("Name", exact=True).fill(name)
        if shared:
            self.page.get_by_label("Everybody in the class may see it").check()
        self.page.get_by_role("button", name="Publish").click()
        expect(self.page.get_by_role("heading", name="Published as")).to_be_visible()


class SignInPage:
    """`/sign-in` and `/invitation/...`"""

    def __init__(self, page: Page) -> None:
        self.page = page

    def accept(self, link: str, password: str) -> None:
        """Choose a password with a one-time link."""
        self.page.goto(link)
        self.page.get_by_label("Password", exact=True).fill(password)
        self.page.get_by_label("The same again").fill(password)
        self.page.get_by_role("button", name="Save and go in").click()
        expect(self.page.get_by_role("navigation", name="Main")).to_be_visible()

    def sign_in(self, url: str, name: str, password: str) -> None:
        """Sign in with name and password."""
        self.page.goto(f"{url}/sign-in")
        self.page.get_by_label("Name").fill(name)
        self.page.get_by_label("Password").fill(password)
        self.page.get_by_role("button", name="Sign in", exact=True).click()


class ClassPage:
    """`/class`: one submission after another."""

    def __init__(self, page: Page) -> None:
        self.page = page

    def open(self, url: str, key: str = "") -> ClassPage:
        """Open the page; wait until a submission is shown."""
        self.page.goto(f"{url}/class{key and f'/{key}'}")
        self.page.get_by_role("button", name="Next").wait_for()
        return self

    def expect_shown(self, name: str) -> None:
        expect(self.page.get_by_role("heading", level=1, name=name)).to_be_visible()

    @property
    def marks(self) -> Locator:
        return self.page.get_by_role("region", name="Marks")


class LabPage:
    """`/lab`: the robots of a running lab."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.link = page.locator(".lab-link")

    def open(self, url: str) -> LabPage:
        """Open the page; wait until the first robot is there."""
        self.page.goto(f"{url}/lab")
        self.page.locator(".lab-panel article h2").first.wait_for()
        return self

    def robot(self, name: str) -> Locator:
        return self.page.get_by_role("article", name=name)

    def load(self, robot: str, trajectory: str) -> None:
        """Load a trajectory; where there is none for the robot, the example.

        Whatever others published in this lab, and whatever the robot has or does.
        """
        card = self.robot(robot)
        listed = card.get_by_role("button", name=trajectory)
        example = card.get_by_role("button", name="Load the example")
        another = card.get_by_role("button", name="Load another")
        expect(listed.or_(example).or_(another).first).to_be_visible()
        if card.get_by_role("button", name="Pause", exact=True).is_visible():
            card.get_by_role("button", name="Pause", exact=True).click()
        if another.is_visible():
            another.click()
        search = card.get_by_role("searchbox")
        expect(listed.or_(example).or_(search).first).to_be_visible()
        if search.is_visible():
            search.fill(trajectory)
        expect(listed.or_(example).first).to_be_visible()
        (example if example.is_visible() else listed.first).click()
        expect(card.get_by_role("button", name="Play")).to_be_enabled()
