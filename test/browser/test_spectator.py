"""The lab page beside a headset: seen with its eyes, a point for all, and an act undone."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from math import dist

import pytest
from browser_side import difference, eventually, pixels
from page_objects import LabPage
from playwright.sync_api import Browser, StorageState, expect
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)


@pytest.fixture
def teacher(browser: Browser, signed_in: StorageState, lab: ServedLab) -> Iterator[LabPage]:
    """The lab page, with a robot, as on a projector."""
    lab.done("scene", "load", "empty")
    lab.done("spawn", "ur5e")
    context = browser.new_context(
        viewport={"width": 1200, "height": 700}, reduced_motion="reduce", storage_state=signed_in
    )
    yield LabPage(context.new_page()).open(lab.url)
    context.close()


def test_the_projector_shows_what_a_student_sees_and_all_see_where_a_teacher_points(
    teacher: LabPage, headsets: Callable[[], Headset]
) -> None:
    page = teacher.page
    canvas = page.locator("canvas")
    student = headsets()
    student.enter()
    inside = page.get_by_role("article", name="In the room")
    see = inside.get_by_role("button", name=re.compile("See what .* sees"))
    see.click()
    status = page.get_by_role("status").filter(has_text="Through the eyes of")
    expect(status).to_be_visible()
    # The picture is that of the head: it turns as the head turns.
    student.page.evaluate("headset.device.quaternion.set(0, 0, 0, 1)")
    student.frames()
    before = pixels(canvas)
    student.page.evaluate("headset.device.quaternion.set(-0.17, 0, 0, 0.985)")
    eventually(page, lambda: difference(before, pixels(canvas)) > 0.01)

    # The point that is clicked is the one that the student is shown.
    page.get_by_role("button", name="Look here").click()
    box = canvas.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.7)
    student.wait_for("room.lookHere.point !== null")
    assert "look here" in student.page.evaluate("room.board.notice")
    at = student.page.evaluate("room.lookHere.point.toArray()")
    eyes = "room.stage.world.worldToLocal(room.head.clone()).toArray()"
    assert 0.3 < dist(at, student.page.evaluate(eyes)) < 8

    # A slip on the page is undone inside, for all.
    card = teacher.robot("ur5e_1")
    card.get_by_role("button", name="What to do with ur5e_1").click()
    card.get_by_role("button", name="Remove the robot").click()
    expect(card).to_have_count(0)
    student.wait_for("room.handles.size === 0")
    student.act(BOARD, "undo")
    expect(card).to_be_visible()

    # Whoever leaves takes the view along.
    student.page.context.close()
    expect(status).to_have_count(0)
    expect(page.get_by_role("status").filter(has_text="has left the room")).to_be_visible()
