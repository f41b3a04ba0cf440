"""A file is dropped, judged, mended, seen and published, in a real browser at a real lab."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import student_files
from browser_side import difference, eventually
from page_objects import UploadPage
from playwright.sync_api import Page, expect


def test_a_good_file_moves_after_two_clicks_and_is_published(
    drawn_page: Page, tmp_path: Path
) -> None:
    page = drawn_page
    upload = UploadPage(page)
    upload.send(student_files.good(tmp_path))
    expect(upload.outcome("accepted")).to_be_visible()
    expect(upload.strips).to_have_count(6)
    upload.wait_for_robot()
    first = upload.picture()
    # A view in which WebGL draws nothing has one colour, or a few of a gradient.
    assert len(np.unique(first.reshape(-1, 3), axis=0)) > 200
    page.get_by_role("button", name="Play").click()
    expect(page.locator(".scene-clock")).not_to_contain_text("0.00 /")
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    page.get_by_label("Time").fill("1")
    eventually(page, lambda: difference(first, upload.picture()) > 0.01)
    upload.publish("wave")
    # a keyboard and a screen reader go on at the answer
    expect(page.get_by_role("heading", name="Published as")).to_be_focused()
    # a phone cannot open 127.0.0.1: the address that it can open is asked for once
    page.get_by_label("Address at which others reach").fill("https://lab.example:8765")
    page.get_by_role("button", name="Use it for links").click()
    code = page.get_by_role("img", name="QR code of https://lab.example:8765/trajectories/")
    expect(code).to_be_visible()
    page.get_by_role("link", name="See the trajectory").click()
    expect(page.get_by_role("heading", name="wave")).to_be_visible()
    expect(page.locator(".strip")).to_have_count(6)


def test_what_the_robot_touches_is_the_cause(page: Page, tmp_path: Path) -> None:
    upload = UploadPage(page)
    upload.send(student_files.into_the_floor(tmp_path))
    expect(upload.finding("collision")).to_contain_text("rows")
    expect(page.get_by_role("heading", level=1)).to_contain_text("Wrist 3 touches")


def test_the_example_is_one_click(page: Page) -> None:
    page.get_by_role("button", name="Try the example").click()
    expect(UploadPage(page).outcome("accepted")).to_be_visible()


def test_of_several_matrices_one_is_chosen(page: Page, tmp_path: Path) -> None:
    upload = UploadPage(page)
    upload.send(student_files.ambiguous(tmp_path))
    expect(upload.outcome("your choice")).to_be_visible()
    expect(page.locator(".candidate .sparkline path")).to_have_count(12)
    expect(page.locator(".candidate").nth(1)).to_contain_text("201 \N{MULTIPLICATION SIGN} 6")
    page.locator(".candidate").nth(1).get_by_role("button", name="Take second").click()
    expect(upload.outcome("accepted")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(upload.outcome("your choice")).to_be_visible()


def test_a_fix_is_applied_by_its_button_and_taken_back(page: Page, tmp_path: Path) -> None:
    upload = UploadPage(page)
    upload.send(student_files.jumping(tmp_path))
    expect(upload.outcome("refused")).to_be_visible()
    finding = upload.finding("jump_2pi")
    expect(finding).to_contain_text("unwrap")
    finding.get_by_role("button", name="Remove jumps by a full turn").click()
    expect(upload.outcome("accepted")).to_be_visible()
    expect(page.get_by_role("heading", level=1)).to_be_focused()
    page.get_by_role("button", name="Undo").click()
    expect(upload.outcome("refused")).to_be_visible()


def test_a_refused_file_is_shown_with_the_failing_frame(drawn_page: Page, tmp_path: Path) -> None:
    page = drawn_page
    upload = UploadPage(page)
    upload.send(student_files.beyond(tmp_path))
    expect(upload.outcome("refused")).to_be_visible()
    upload.wait_for_robot()
    # at the first failing frame, with the strip of its joint alone
    expect(page.locator(".scene-clock")).to_contain_text("0.89")
    expect(upload.strips).to_have_count(1)
    first = upload.picture()
    expect(page.get_by_role("button", name="Publish")).to_have_count(0)
    finding = upload.finding("joint_limit")
    assert finding.locator(".finding-number").inner_text() == "2"
    page.get_by_role("button", name="Next finding").click()
    expect(page.locator(".scene-clock")).to_contain_text("0.90")
    expect(finding.get_by_role("button", name="rows 91 to 111")).to_be_visible()
    eventually(page, lambda: difference(first, upload.picture()) > 0.01)
    page.get_by_role("button", name="Show all 6 joints").click()
    expect(upload.strips).to_have_count(6)


def test_a_file_that_is_none_says_what_to_do(page: Page, tmp_path: Path) -> None:
    file = tmp_path / "holiday.mat"
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(200))
    upload = UploadPage(page)
    upload.send(file)
    expect(upload.outcome("refused")).to_be_visible()
    expect(upload.findings.first).to_contain_text("save('traj.mat', 'q', '-v7')")
    expect(upload.strips).to_have_count(0)


def test_the_same_choices_meet_the_next_file(page: Page, tmp_path: Path) -> None:
    page.get_by_role("radio", name="KR 3 R540").check(force=True)
    page.reload()
    expect(page.get_by_role("radio", name="KR 3 R540")).to_be_checked()


def test_the_pages_speak_german(page: Page) -> None:
    page.get_by_role("button", name="Account").click()
    page.get_by_text("Deutsch").click()
    expect(page.get_by_role("button", name="Datei wählen")).to_be_visible()
    assert page.locator("html").get_attribute("lang") == "de"


def test_the_keyboard_reaches_everything(page: Page) -> None:
    page.get_by_role("button", name="Choose a file").wait_for()
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip to the page")).to_be_focused()
    reached = set()
    for _ in range(12):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.textContent.trim()"))
    assert {"Upload", "Trajectories", "Lab", "Choose a file", "Try the example"} <= reached
