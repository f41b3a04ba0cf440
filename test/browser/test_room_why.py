"""The room says why it is empty: each hop that can fail, in the page and in the headset."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from browser_side import eventually
from playwright.sync_api import Browser, StorageState, WebSocketRoute, expect
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the headset's pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

# Keeps what is written on panels, the newest last.
WRITTEN = """() => {
  const { prototype } = CanvasRenderingContext2D
  const fill = prototype.fillText
  window.written = []
  prototype.fillText = function (text, x, y) {
    if (window.written.push(text) > 2000) window.written.splice(0, 1000)
    fill.call(this, text, x, y)
  }
}"""
FAILS = """() => {
  navigator.xr.ask = navigator.xr.requestSession
  navigator.xr.requestSession = () => Promise.reject(new DOMException('', 'NotAllowedError'))
  const { createAnchor } = XRFrame.prototype
  const full = () => Promise.reject(new DOMException('', 'QuotaExceededError'))
  XRFrame.prototype.createAnchor = async function (...place) {
    return Object.assign(await createAnchor.apply(this, place), { requestPersistentHandle: full })
  }
  headset.planes.clear()
}"""


def test_a_page_without_https_says_how_headsets_get_in(
    plain_browser: Browser, signed_in: StorageState, lab: ServedLab
) -> None:
    context = plain_browser.new_context(locale="en-GB", storage_state=signed_in)
    context.add_init_script("Object.defineProperty(window, 'isSecureContext', { value: false })")
    page = context.new_page()
    page.goto(f"{lab.url}/room")
    expect(page.locator("[data-hop=headset]")).to_contain_text("mrlab up --keys")
    context.close()


def test_each_hop_that_fails_is_named_in_the_page_and_in_the_headset(
    headsets: Callable[[], Headset], lab: ServedLab
) -> None:
    lab.done("scene", "load", "empty")
    headset = headsets()
    page = headset.page
    page.evaluate(WRITTEN)

    def written(*found: str) -> None:
        for words in found:
            headset.wait_for(f"window.written.join(' ').includes('{words}')")
        page.evaluate("window.written.length = 0")

    # No robot; then access to the room is refused, and granted at the second try.
    expect(page.locator("[data-hop=robots]")).to_contain_text("No robot is here yet")
    page.evaluate(FAILS)
    page.get_by_role("button", name="Enter the room").dispatch_event("click")
    expect(page.get_by_role("alert")).to_contain_text("it was not allowed")
    page.evaluate("() => { navigator.xr.requestSession = navigator.xr.ask }")
    headset.enter()
    written("No robot is here yet")

    # A room that nobody set up, in a headset whose places are all taken.
    headset.act(BOARD, "tab room")
    written("keeps no more places", "The headset knows no table or wall")
    lab.done("spawn", "ur5e")
    headset.wait_for("room.handles.size === 1")

    # The socket goes and does not come back; then it does.
    sockets: list[WebSocketRoute] = []

    def refuse(socket: WebSocketRoute) -> None:
        sockets.append(socket)
        socket.close(code=1013, reason="the cable is out")

    page.route_web_socket("**/link", refuse)
    page.evaluate("room.follower.link.lose('the cable is out')")
    expect(page.locator("[data-hop=gateway]")).to_contain_text("is lost, it is tried again")
    written("The way to the gateway is lost")
    assert page.evaluate("room.handles.size") == 1, "what was there stays"
    headset.frames()
    eventually(page, lambda: bool(sockets))

    # Another version at the other end: it is not tried again, and the page says what to do.
    def outdated(socket: WebSocketRoute) -> None:
        socket.close(code=4001, reason="this page is of another version: reload it")

    page.route_web_socket("**/link", outdated)
    expect(page.locator("[data-hop=gateway]")).to_contain_text("this page is of another version")
    written("does not let this page in")
