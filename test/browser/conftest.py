"""A lab with its pages, a gateway at which people sign in, and a browser that draws in 3D."""

from __future__ import annotations

import shutil
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright
from served_lab import Gateway, ServedLab, gateway_with_people, served_lab

# Without the second one headless Chromium has no WebGL, and a page without 3D would pass.
FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader")
# Of a page that waits for something, ms; software draws the 3D view on few cores.
PATIENCE_MS = 30_000
CHROMIUM = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The system's Chromium, else the one that `playwright install chromium` put here."""
    found = next((path for name in CHROMIUM if (path := shutil.which(name))), None)
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=found, args=FLAGS)
        yield started
        started.close()


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedLab]:
    """A lab on this machine, for one local user."""
    with served_lab(tmp_path_factory.mktemp("lab")) as lab:
        yield lab


@pytest.fixture(scope="session")
def gateway(lab: ServedLab, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Gateway]:
    """A second gateway of the same lab, at which people sign in."""
    with gateway_with_people(lab, tmp_path_factory.mktemp("gateway")) as gateway:
        yield gateway


class Troubles(list[str]):
    """What a page complained of: errors in the console, exceptions."""

    def watch(self, page: Page) -> None:
        """Note what `page` complains of from now on."""
        page.on("pageerror", lambda error: self.append(str(error)))
        page.on(
            "console",
            lambda message: message.type == "error" and self.append(message.text),
        )


@pytest.fixture
def troubles() -> Troubles:
    return Troubles()


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    """A browser of one's own: no cookies, English."""
    made = browser.new_context(locale="en-GB", viewport={"width": 1280, "height": 900})
    made.set_default_timeout(PATIENCE_MS)
    yield made
    made.close()


@pytest.fixture
def page(context: BrowserContext, lab: ServedLab, troubles: Troubles) -> Iterator[Page]:
    """The upload page, signed in by the link that `mrlab open` prints; without complaints."""
    page = context.new_page()
    page.set_default_timeout(PATIENCE_MS)
    troubles.watch(page)
    page.goto(lab.signed_in_url())
    yield page
    assert troubles == []
