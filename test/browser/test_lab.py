"""The page of the running lab: what is played there moves, and who may not play is told why."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from browser_side import difference, eventually, pixels
from own_port import free_port
from page_objects import LabPage, SignInPage
from playwright.sync_api import Browser, BrowserContext, Page, StorageState, expect
from served_lab import Gateway, ServedLab, gateway_with_people

from mrlab_ros.core.bridge.rules import Role

# A check runs only when nothing else wants the processor.
CHECKED_MS = 120_000
PASSWORD = "long enough to be one"
# Answers how a socket ended that a page of this origin opened: its code, or 0 once it is open.
SOCKET = """
(url) => new Promise((resolve) => {
  const socket = new WebSocket(url, 'mrlab.1')
  socket.onopen = () => resolve(0)
  socket.onclose = (event) => resolve(event.code)
})
"""


@pytest.fixture
def window(plain_browser: Browser) -> Iterator[BrowserContext]:
    """A browser of its own, without 3D."""
    made = plain_browser.new_context(locale="en-GB")
    yield made
    made.close()


def member(window: BrowserContext, gateway: Gateway, name: str, role: Role) -> LabPage:
    """Let somebody in; return the lab's page, open."""
    page = window.new_page()
    SignInPage(page).accept(gateway.invite(name, role), PASSWORD)
    return LabPage(page).open(gateway.url)


def test_two_clicks_make_a_robot_move(
    browser: Browser, signed_in: StorageState, lab: ServedLab
) -> None:
    context = browser.new_context(
        viewport={"width": 800, "height": 500}, reduced_motion="reduce", storage_state=signed_in
    )
    there = LabPage(context.new_page()).open(lab.url)
    canvas = there.page.locator("canvas")
    eventually(there.page, lambda: len(np.unique(pixels(canvas).reshape(-1, 3), axis=0)) > 400)
    there.load("ur5e_1", "quintic")
    before = pixels(canvas)
    card = there.robot("ur5e_1")
    card.get_by_role("button", name="Play").click()
    eventually(there.page, lambda: difference(before, pixels(canvas)) > 0.004)
    pause = there.page.get_by_role("button", name="Pause all")
    # it may be over before it is paused: then there is nothing left to pause
    if pause.is_enabled():
        pause.click()
    expect(pause).to_be_disabled()
    there.page.get_by_role("button", name="Topics").click()
    topics = there.page.get_by_role("region", name="Topics")
    topics.get_by_role("searchbox").fill("ur5e_1/joint_st")
    row = topics.get_by_role("button", name="ur5e_1/joint_states sensor_msgs/JointState")
    expect(topics.get_by_role("listitem")).to_have_count(1)
    row.click()
    # a number of the newest message, plotted
    topics.locator("summary", has_text="position").locator("..").get_by_role(
        "checkbox"
    ).first.check()
    expect(topics.locator("figure .sparkline")).to_be_visible()
    topics.get_by_role("button", name="Hold").click()
    expect(topics.get_by_role("button", name="Go on")).to_be_visible()
    context.close()


def test_a_robot_is_put_there_and_taken_away(page: Page, lab: ServedLab) -> None:
    there = LabPage(page).open(lab.url)
    page.get_by_role("button", name="Add a robot").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("radio", name="KR 3 R540").check(force=True)
    dialog.get_by_role("button", name="Put it there").click()
    card = there.robot("kuka_kr3_r540_1")
    expect(card).to_contain_text("There is no trajectory for kuka_kr3_r540 yet")
    card.get_by_role("button", name="What to do with").click()
    card.get_by_role("button", name="Remove the robot").click()
    expect(card).to_have_count(0)


def test_what_a_motion_would_touch_is_said_before_it_is_played(page: Page, lab: ServedLab) -> None:
    there = LabPage(page).open(lab.url)
    there.load("ur5e_1", "quintic")
    check = there.robot("ur5e_1").get_by_role("region", name="Check of ur5e_1")
    # what was loaded before this page was opened is checked when somebody asks
    button = check.get_by_role("button", name=re.compile("^Check"))
    verdict = check.get_by_role("status")
    expect(button.or_(verdict).first).to_be_visible()
    lab.done("objects", "spawn", "pedestal", "--name", "in_the_way", "--at", "0.75,0.05,0.2")
    try:
        expect(verdict).not_to_contain_text("Checking", timeout=CHECKED_MS)

        # the pages hear of the pedestal some time after the command has its answer
        def refused() -> bool:
            said = verdict.inner_text()
            if "Not ready" not in said and "Checking" not in said:
                button.click()
            return "Not ready" in said

        eventually(page, refused)
        finding = check.get_by_role("listitem").filter(has_text="in_the_way").first
        expect(finding).to_contain_text("Error")
        expect(finding).to_contain_text("Collision")
        at = finding.get_by_role("button", name="at ")
        time = float(at.inner_text().removeprefix("at ").removesuffix(" s"))
        at.click()
        timeline = there.robot("ur5e_1").get_by_label("Time", exact=True)
        eventually(page, lambda: abs(float(timeline.input_value()) - time) < 0.02)
        mark = there.robot("ur5e_1").locator(".scene-mark-error").first
        expect(mark).to_have_attribute("title", re.compile("Error: Collision, at"))
    finally:
        lab.done("objects", "remove", "in_the_way")
    page.reload()
    expect(check).to_contain_text("in_the_way is gone since. Check again.")


def test_a_phone_is_given_no_address_that_leads_to_itself(page: Page, lab: ServedLab) -> None:
    LabPage(page).open(lab.url)
    page.get_by_role("button", name="Join on your phone").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("127.0.0.1, which is this machine itself")
    expect(dialog.get_by_role("img")).to_have_count(0)


def test_a_student_is_told_who_loads_and_plays(window: BrowserContext, gateway: Gateway) -> None:
    there = member(window, gateway, "greta", Role.STUDENT)
    expect(there.page.get_by_text("Your role, student, may watch.")).to_be_visible()
    expect(there.page.get_by_role("button", name="Add a robot")).to_have_count(0)
    expect(there.page.get_by_role("button", name="Load the example")).to_have_count(0)


def test_the_page_goes_on_when_its_gateway_comes_back(
    window: BrowserContext, lab: ServedLab, tmp_path: Path
) -> None:
    port = free_port()
    with gateway_with_people(lab, tmp_path, port) as gateway:
        there = member(window, gateway, "hedy", Role.OPERATOR)
        there.load("ur5e_1", "quintic")
        card = there.robot("ur5e_1")
        card.get_by_label("Speed").select_option("0.1")
        card.get_by_role("button", name="Play").click()
        expect(card.locator(".chip")).to_have_text("playing")
    expect(there.link).to_contain_text("connection lost")
    expect(there.page.get_by_text("this is what was last known")).to_be_visible()
    expect(card.get_by_label("Speed")).to_be_disabled()
    expect(card.locator(".scene-play")).to_be_disabled()
    with gateway_with_people(lab, tmp_path, port):
        expect(there.link).to_contain_text("round trip")
        expect(card.locator(".chip")).to_have_text("playing")
        card.get_by_role("button", name="Pause").click()
        expect(card.locator(".chip")).to_have_text("paused")
        card.get_by_label("Speed").select_option("1")


def test_a_page_of_another_origin_gets_no_socket(
    page: Page, lab: ServedLab, troubles: list[str]
) -> None:
    link = f"{lab.url.replace('http', 'ws')}/link"
    assert page.evaluate(SOCKET, link) == 0
    # The host is the same, so the browser sends the cookie of the person who is signed in.
    elsewhere = "http://127.0.0.1:9/page"
    page.route(
        elsewhere, lambda route: route.fulfill(body="<p>elsewhere", content_type="text/html")
    )
    page.goto(elsewhere)
    assert page.evaluate(SOCKET, link) == 1006
    assert [each for each in troubles if "WebSocket" not in each] == []
    troubles.clear()


def test_the_page_says_that_a_sign_in_was_ended(
    plain_browser: Browser, window: BrowserContext, gateway: Gateway
) -> None:
    there = member(window, gateway, "ida", Role.OPERATOR)
    other = plain_browser.new_context(locale="en-GB")
    teacher = other.new_page()
    SignInPage(teacher).accept(gateway.invite("jane", Role.INSTRUCTOR), PASSWORD)
    teacher.goto(f"{gateway.url}/people")
    teacher.get_by_role("button", name="What to do with ida").click()
    teacher.get_by_role("button", name="Remove").click()
    teacher.get_by_role("dialog").get_by_role("button", name="Remove").click()
    expect(there.page.get_by_role("heading", name="Sign in")).to_be_visible()
    expect(there.page.get_by_text("Your sign-in was ended.")).to_be_visible()
    expect(there.page).to_have_url(re.compile(r"/sign-in\?problem=ended$"))
    other.close()
