"""A lab with its pages, a gateway at which people sign in, and a browser that draws in 3D."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator, Sequence

import pytest
from playwright.sync_api import (
    Browser,
    BrowserContext,
    Page,
    StorageState,
    expect,
    sync_playwright,
)
from room_side import Headset
from served_lab import Gateway, ServedLab, gateway_with_people, served_lab

# Without the second one headless Chromium has no WebGL, and a page without 3D would pass.
FLAGS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader")
PLAIN = ("--no-sandbox", "--disable-gpu", "--disable-3d-apis")
# Of a page that waits for something, ms; software draws the 3D view on few cores.
PATIENCE_MS = 30_000
expect.set_options(timeout=PATIENCE_MS)
CHROMIUM = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


# Playwright keeps an event loop running in the thread that started it, in which no other test
# could run one: so it ends with its file.
@pytest.fixture(scope="module")
def chromium() -> Iterator[Callable[[Sequence[str]], Browser]]:
    """Start the system's Chromium, else the one that `playwright install chromium` put here."""
    found = next((path for name in CHROMIUM if (path := shutil.which(name))), None)
    with sync_playwright() as playwright:
        yield lambda flags: playwright.chromium.launch(executable_path=found, args=flags)


@pytest.fixture(scope="module")
def browser(chromium: Callable[[Sequence[str]], Browser]) -> Iterator[Browser]:
    """A browser that draws in 3D."""
    started = chromium(FLAGS)
    yield started
    started.close()


@pytest.fixture(scope="module")
def plain_browser(chromium: Callable[[Sequence[str]], Browser]) -> Iterator[Browser]:
    """A browser without WebGL: where 3D does not matter, no click waits for its drawing."""
    started = chromium(PLAIN)
    yield started
    started.close()


@pytest.fixture(scope="package")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedLab]:
    """A lab on this machine, for one local user."""
    with served_lab(tmp_path_factory.mktemp("lab")) as lab:
        yield lab


@pytest.fixture(scope="package")
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


@pytest.fixture(scope="module")
def signed_in(plain_browser: Browser, lab: ServedLab) -> StorageState:
    """Return the cookies of the browser that the link of `mrlab open` signs in, once."""
    context = plain_browser.new_context()
    page = context.new_page()
    page.goto(lab.signed_in_url())
    page.get_by_role("navigation", name="Main").wait_for()
    state = context.storage_state()
    context.close()
    return state


def opened(browser: Browser, signed_in: StorageState) -> BrowserContext:
    """Return a window of the local user, in English."""
    made = browser.new_context(
        locale="en-GB", viewport={"width": 1100, "height": 700}, storage_state=signed_in
    )
    made.set_default_timeout(PATIENCE_MS)
    return made


@pytest.fixture
def page(
    plain_browser: Browser, signed_in: StorageState, lab: ServedLab, troubles: Troubles
) -> Iterator[Page]:
    """The upload page of the local user without 3D, which must not complain of anything."""
    context = opened(plain_browser, signed_in)
    page = context.new_page()
    troubles.watch(page)
    page.goto(lab.url)
    yield page
    context.close()
    assert troubles == []


@pytest.fixture
def drawn_page(
    browser: Browser, signed_in: StorageState, lab: ServedLab, troubles: Troubles
) -> Iterator[Page]:
    """The upload page of the local user with 3D, which must not complain of anything."""
    context = opened(browser, signed_in)
    page = context.new_page()
    troubles.watch(page)
    page.goto(lab.url)
    yield page
    context.close()
    assert troubles == []


@pytest.fixture
def headsets(
    chromium: Callable[[Sequence[str]], Browser], signed_in: StorageState, lab: ServedLab
) -> Iterator[Callable[[], Headset]]:
    """Return what opens the room with one more emulated headset."""
    # WebGL itself is replaced: no_webgl.js needs its constants
    browser = chromium(("--no-sandbox", "--disable-gpu"))
    size = {"width": 480, "height": 360}

    def another() -> Headset:
        made = browser.new_context(viewport=size, locale="en-GB", storage_state=signed_in)
        return Headset(made, lab.url)

    yield another
    browser.close()
