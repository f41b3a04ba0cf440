"""The lab page beside a headset: seen with its eyes, a point for all, and an act undone."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from math import dist
from pathlib import Path

import pytest
from browser_side import difference, eventually, pixels
from page_objects import LabPage
from playwright.sync_api import Browser, StorageState, expect
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
NEXT, BACK = "Stop \u203a", "\u2039 Stop"


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


def test_a_recorded_session_is_walked_through_from_stop_to_stop(
    teacher: LabPage, headsets: Callable[[], Headset], lab: ServedLab
) -> None:
    student = headsets()
    student.enter()
    student.act(BOARD, "tab lab")
    student.act(BOARD, "record")
    student.wait_for("room.board.panel.ids.includes('end_recording')")
    lab.done("play", "ur5e_1", str(MOTION))
    student.page.evaluate("room.lookHere.ask(room.head.clone().set(0.4, 0.5, 0.2))")
    student.wait_for("room.lookHere.point !== null")
    student.act(BOARD, "end_recording")
    student.act(BOARD, "replay 0")
    student.act(BOARD, "replay_play")
    student.wait_for("room.follower.recorder.value.state === 3")
    student.page.evaluate("room.follower.replay.seek(0)")
    student.act(BOARD, "next_stop")

    # Where the run begins, for everybody.
    stop = "room.follower.recorder.value.code === 'tour_stop' && room.lookHere.point?.toArray()"
    student.wait_for(stop)
    began = student.page.evaluate("room.follower.replay.position()")
    assert "begins" in student.page.evaluate("room.board.notice")
    card = teacher.page.get_by_role("article").filter(has_text="Recordings")
    expect(card).to_contain_text("Stop 1 of")
    # The teacher goes on to the end of the motion, and to where somebody pointed then.
    stops = int(re.search(r"Stop 1 of (\d)", card.inner_text())[1])  # type: ignore[index]
    for number in range(2, stops + 1):
        card.get_by_role("button", name=NEXT).click()
        expect(card).to_contain_text(f"Stop {number} of")
    student.wait_for(f"Math.abs({stop}[0] - 0.4) < 1e-9")
    card.get_by_role("button", name=BACK).click()
    expect(card).to_contain_text(f"Stop {stops - 1} of")
    student.wait_for(f"room.follower.replay.position() >= {began}")
    card.get_by_role("button", name="End the replay").click()
    student.wait_for("room.lookHere.point === null && room.handles.size === 1")
