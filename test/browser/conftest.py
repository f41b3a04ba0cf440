"""A lab with its pages, a gateway at which people sign in, and a browser that draws in 3D."""

from __future__ import annotations

import shutil
from collections.abc import Iterator

import pytest
from playwright.sync_api import (
    Browser,
    BrowserContext,
    Page,
    StorageState,
    expect,
    sync_playwright,
)
from served_lab import Gateway, ServedLab, gateway_with_people, served_lab

# Without the second one headless Chromium has no WebGL, and a page without 3D would pass.
FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader")
# Of a page that waits for something, ms; software draws the 3D view on few cores.
PATIENCE_MS = 30_000
expect.set_options(timeout=PATIENCE_MS)
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


@pytest.fixture(scope="session")
def signed_in(browser: Browser, lab: ServedLab) -> StorageState:
    """Return the cookies of the browser that the link of `mrlab open` signs in, once."""
    context = browser.new_context()
    page = context.new_page()
    page.goto(lab.signed_in_url())
    page.get_by_role("navigation", name="Main").wait_for()
    state = context.storage_state()
    context.close()
    return state


@pytest.fixture
def context(browser: Browser, signed_in: StorageState) -> Iterator[BrowserContext]:
    """A browser of the local user, in English."""
    made = browser.new_context(
        locale="en-GB", viewport={"width": 1100, "height": 700}, storage_state=signed_in
    )
    made.set_default_timeout(PATIENCE_MS)
    yield made
    made.close()


@pytest.fixture
def page(context: BrowserContext, lab: ServedLab, troubles: Troubles) -> Iterator[Page]:
    """The upload page of the local user, which must not complain of anything."""
    page = context.new_page()
    troubles.watch(page)
    page.goto(lab.url)
    yield page
    assert troubles == []
