"""People sign in, see their own, let headsets in and send them away again."""

from __future__ import annotations

import re
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
import student_files
from page_objects import SignInPage, UploadPage
from playwright.sync_api import Browser, BrowserContext, Page, expect
from served_lab import Gateway

from mrlab_ros.core.bridge.rules import Role

PASSWORD = "long enough to be one"


@pytest.fixture
def browsers(plain_browser: Browser) -> Iterator[list[BrowserContext]]:
    """Browsers of different people: nothing is shared between them."""
    made = [plain_browser.new_context(locale="en-GB") for _ in range(2)]
    yield made
    for context in made:
        context.close()


def member(context: BrowserContext, gateway: Gateway, name: str, role: Role) -> Page:
    """Let somebody in and return the person's page, signed in."""
    page = context.new_page()
    page.set_default_timeout(30_000)
    SignInPage(page).accept(gateway.invite(name, role), PASSWORD)
    return page


def test_two_people_see_nothing_of_each_other(
    browsers: list[BrowserContext], gateway: Gateway, tmp_path: Path
) -> None:
    anna = member(browsers[0], gateway, "anna", Role.STUDENT)
    ben = member(browsers[1], gateway, "ben", Role.STUDENT)
    upload = UploadPage(anna)
    upload.send(student_files.good(tmp_path))
    upload.publish("secret")
    upload.page.get_by_role("button", name="Another file").click()
    upload.send(student_files.good(tmp_path, "other.mat", 0.3))
    upload.publish("open", shared=True)
    ben.goto(f"{gateway.url}/trajectories")
    expect(ben.get_by_role("link", name=re.compile("^open"))).to_be_visible()
    expect(ben.get_by_role("link", name=re.compile("^secret"))).to_have_count(0)
    ben.goto(f"{gateway.url}/trajectories/anna/secret")
    expect(ben.get_by_role("alert").first).to_contain_text("There is no trajectory")
    # What is shared may be looked at, not changed.
    answer = ben.request.delete(
        f"{gateway.url}/api/trajectories/anna/open", headers=headers(ben, gateway)
    )
    assert answer.status == 403
    expect(ben.get_by_role("link", name="People")).to_have_count(0)
    assert ben.request.get(f"{gateway.url}/api/people").status == 403


def test_a_headset_is_paired_by_a_phone_and_revoked(
    browsers: list[BrowserContext], gateway: Gateway
) -> None:
    phone = member(browsers[0], gateway, "carla", Role.INSTRUCTOR)
    headset = browsers[1].new_page()
    headset.goto(f"{gateway.url}/pair")
    code = headset.get_by_test_id("code").inner_text()
    expect(headset.get_by_role("img", name="QR code of")).to_be_visible()
    phone.goto(f"{gateway.url}/pair")
    phone.get_by_label("Code").fill("BBBB-BBBB")
    phone.get_by_role("button", name="Approve").click()
    expect(phone.locator(".field-error")).to_contain_text("No device shows the code")
    phone.get_by_label("Code").fill(code.lower())
    phone.get_by_role("button", name="Approve").click()
    expect(phone.get_by_role("heading", name="is let in")).to_be_visible()
    expect(headset.get_by_role("navigation", name="Main")).to_be_visible()
    phone.goto(f"{gateway.url}/people")
    device = phone.locator("[data-device=headset]")
    expect(device).to_have_count(1)
    device.get_by_role("button", name="End").click()
    expect(device).to_have_count(0)
    headset.goto(f"{gateway.url}/trajectories")
    expect(headset.get_by_role("heading", name="Sign in")).to_be_visible()


def test_nobody_is_named_before_sign_in(browsers: list[BrowserContext], gateway: Gateway) -> None:
    gateway.invite("dora", Role.STUDENT)
    page = browsers[0].new_page()
    page.goto(f"{gateway.url}/people")
    expect(page.get_by_role("heading", name="Sign in")).to_be_visible()
    assert "dora" not in page.content()
    SignInPage(page).sign_in(gateway.url, "dora", PASSWORD)
    expect(page.locator(".field-error")).to_contain_text("do not belong together")


def test_a_link_is_good_once(browsers: list[BrowserContext], gateway: Gateway) -> None:
    link = gateway.invite("emil", Role.STUDENT)
    page = browsers[0].new_page()
    SignInPage(page).accept(link, PASSWORD)
    other = browsers[1].new_page()
    other.goto(link)
    expect(other.get_by_role("heading", name="This link cannot be used")).to_be_visible()


def test_a_foreign_page_changes_nothing(browsers: list[BrowserContext], gateway: Gateway) -> None:
    page = member(browsers[0], gateway, "frida", Role.STUDENT)
    own = headers(page, gateway)
    for foreign in ({**own, "Origin": "http://evil.example"}, {**own, "X-CSRF-Token": "guess"}):
        answer = page.request.put(f"{gateway.url}/api/uploads/x.mat", headers=foreign, data=b"x")
        assert answer.status == 403
    request = urllib.request.Request(
        f"{gateway.url}/api/session", headers={"Host": "evil.example"}
    )
    with pytest.raises(urllib.error.HTTPError, match="403"):
        urllib.request.urlopen(request)


def headers(page: Page, gateway: Gateway) -> dict[str, str]:
    """Return what the pages send with a request that changes something."""
    csrf = page.request.get(f"{gateway.url}/api/session").json()["csrf"]
    return {"X-CSRF-Token": csrf, "Origin": gateway.url}
