"""Every page by keyboard and screen reader: names, roles, contrast, in both themes."""

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


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_bars_anybody(
    plain_browser: Browser, signed_in: StorageState, lab: ServedLab, scheme: str
) -> None:
    context = plain_browser.new_context(
        locale="en-GB",
        color_scheme=scheme,
        # what fades in has less contrast on its way
        reduced_motion="reduce",
        storage_state=signed_in,  # type: ignore[arg-type]
    )
    page = context.new_page()
    page.goto(lab.url)
    page.get_by_role("radio", name="UR5e").wait_for(state="attached")
    assert wrong(page) == []
    page.get_by_role("button", name="Try the example").click()
    expect(UploadPage(page).outcome("accepted")).to_be_visible()
    page.locator(".strip canvas").last.wait_for()
    assert wrong(page) == []
    LabPage(page).open(lab.url)
    assert wrong(page) == []
    page.get_by_role("button", name="Add a robot").click()
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
    # slow enough for a machine that does much else
    card.get_by_label("Speed").select_option("0.1")
    page.get_by_role("link", name="Skip to the page").focus()
    reached = []
    for _ in range(40):
        page.keyboard.press("Tab")
        name = page.evaluate(
            "document.activeElement.title || document.activeElement.textContent.trim()"
        )
        reached.append(name)
        if name == "Play":
            break
    assert reached[-1] == "Play", reached
    page.keyboard.press("Enter")
    # Beside it stands a sentence about what comes before playing.
    chip = card.locator(".chip")
    expect(chip).to_have_text("playing")
    page.keyboard.press("Space")
    expect(chip).to_have_text("paused")
    card.get_by_label("Speed").select_option("1")
