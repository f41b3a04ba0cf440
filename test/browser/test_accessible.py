"""Every page by keyboard and screen reader: names, roles, contrast, both themes and languages."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from page_objects import LabPage, UploadPage
from playwright.sync_api import Browser, Page, StorageState, expect
from served_lab import ServedLab

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
# Answers what is wrong, one line each.
RUN = """
async (tags) => {
  const { violations } = await axe.run(document, { runOnly: tags })
  return violations.flatMap(({ id, help, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${help}: ${target} ${failureSummary}`))
}
"""


def wrong(page: Page) -> list[str]:
    """Return what axe finds wrong with a page as it is now."""
    page.evaluate(AXE.read_text())
    found: list[str] = json.loads(json.dumps(page.evaluate(RUN, RULES)))
    return found


ENGLISH = ("en-GB", "Try the example", "accepted", "Add a robot")
GERMAN = ("de-DE", "Beispiel ausprobieren", "angenommen", "Roboter aufstellen")


@pytest.mark.parametrize(("scheme", "words"), [("light", GERMAN), ("dark", ENGLISH)])
def test_nothing_bars_anybody(
    plain_browser: Browser,
    signed_in: StorageState,
    lab: ServedLab,
    scheme: str,
    words: tuple[str, ...],
) -> None:
    locale, example, accepted, add = words
    context = plain_browser.new_context(
        locale=locale,
        color_scheme=scheme,
        # what fades in has less contrast on its way
        reduced_motion="reduce",
        storage_state=signed_in,  # type: ignore[arg-type]
    )
    page = context.new_page()
    page.goto(lab.url)
    page.get_by_role("radio", name="UR5e").wait_for(state="attached")
    assert wrong(page) == []
    page.get_by_role("button", name=example).click()
    expect(UploadPage(page).outcome(accepted)).to_be_visible()
    page.locator(".strip canvas").last.wait_for()
    assert wrong(page) == []
    LabPage(page).open(lab.url)
    assert wrong(page) == []
    page.get_by_role("button", name=add).click()
    page.get_by_role("dialog").get_by_role("radio").first.wait_for(state="attached")
    assert wrong(page) == []
    for place in ("/trajectories", "/people", "/nothing"):
        page.goto(lab.url + place)
        page.get_by_role("heading").first.wait_for()
        assert wrong(page) == []
    context.close()


def test_a_robot_is_played_and_paused_by_keyboard(page: Page, lab: ServedLab) -> None:
    there = LabPage(page).open(lab.url)
    there.load("ur5e_1", "quintic")
    card = there.robot("ur5e_1")
    # the list that was pressed is gone: a keyboard goes on here
    expect(card.get_by_role("button", name="Play")).to_be_focused()
    # slow enough for a machine that does much else
    card.get_by_label("Speed").select_option("0.1")
    card.get_by_role("combobox").press("Shift+Tab")
    expect(card.get_by_role("button", name="Play")).to_be_focused()
    page.keyboard.press("Enter")
    # Beside it stands a sentence about what comes before playing.
    chip = card.locator(".chip")
    expect(chip).to_have_text("playing")
    # what changes all the time is not read all the time
    expect(page.locator(".scene-clock:not([aria-live=off])")).to_have_count(0)
    page.keyboard.press("Space")
    expect(chip).to_have_text("paused")
    card.get_by_label("Speed").select_option("1")
