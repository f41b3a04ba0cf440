"""What a phone waits for: the first paint of each page, and the answer to a press on the lab page.

A launched lab with 13 robots that play; Chromium with the screen of a phone, a processor four
times slower and a link of 1.6 Mbit/s and 150 ms. Pages are opened with an empty cache. The first
paint has something of the page in it, the page's own begins with its heading. The answer to a
press is what browsers call interaction to next paint, the slowest of them; its wait is that
before the page's code got the press, its work that of the code. Held is the share of the time in
which the page's thread stood still until a picture was drawn and read back.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
from lab import ROOT
from measures.gateway import chromium, launched
from size import Size

NEEDS = ("chromium", "playwright")
ROBOTS = (2, 13, 13)
MOTION = ROOT / "examples" / "quintic_ur5e.mat"
SLOWER = 4
LINK = {
    "offline": False, "latency": 150,
    "downloadThroughput": 1.6e6 / 8, "uploadThroughput": 0.75e6 / 8,
}  # fmt: skip
PAGES = {"upload": "/", "trajectories": "/trajectories", "lab": "/lab", "people": "/people"}
PAINT_MS, ANSWER_MS = 1000, 100
DEADLINE_S = 60.0
READ_BACK = "GLES2::ReadPixels"
# Set in the page: when its heading came, and how long each press took.
WATCH = """
new MutationObserver((_, watching) => {
  if (!document.querySelector('main h1')) return
  watching.disconnect()
  requestAnimationFrame(() => { window.headed = performance.now() })
}).observe(document, { childList: true, subtree: true })
window.answers = []
new PerformanceObserver((list) => {
  for (const each of list.getEntries())
    if (each.interactionId)
      window.answers.push([
        each.duration,
        each.processingStart - each.startTime,
        each.processingEnd - each.processingStart,
      ])
}).observe({ type: 'event', durationThreshold: 16 })
"""
PAINTED = """[
  performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? 0, window.headed ?? 0
]"""


def play(client: httpx.Client, robots: int) -> None:
    """Publish a motion and have the robots play it."""
    upload = client.put(f"/api/uploads/{MOTION.name}", content=MOTION.read_bytes())
    body = {"upload": upload.raise_for_status().json()["upload"], "robot_model": "ur5e"}
    draft = client.post("/api/conversions", json=body).raise_for_status().json()["draft"]
    shared = {"draft": draft, "id": "bench", "shared": True}
    client.post("/api/trajectories", json=shared).raise_for_status()
    for number in range(1, robots + 1):
        path = f"/api/robots/ur5e_{number}/play"
        client.post(path, json={"trajectory": "bench", "rate": 0.1}).raise_for_status()


def phone(browser: Any, state: Any) -> Any:
    """Return a page of a phone with its processor and its link."""
    context = browser.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, storage_state=state, locale="en-GB"
    )
    context.add_init_script(WATCH)
    page = context.new_page()
    page.set_default_timeout(120_000)
    session = context.new_cdp_session(page)
    session.send("Network.enable")
    session.send("Network.setCacheDisabled", {"cacheDisabled": True})
    session.send("Network.emulateNetworkConditions", LINK)
    session.send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    return page


def painted(browser: Any, state: Any, url: str) -> tuple[float, float]:
    """Return when a page paints something, and when its heading is there, ms."""
    page = phone(browser, state)
    page.goto(url, wait_until="commit")
    end = time.monotonic() + DEADLINE_S
    first = heading = 0.0
    while not (first and heading) and time.monotonic() < end:
        page.wait_for_timeout(50)
        first, heading = page.evaluate(PAINTED)
    page.context.close()
    return first, heading


def answered(browser: Any, state: Any, url: str, robots: int, presses: int) -> dict[str, float]:
    """Return the median and the slowest answer to presses on the lab page's topics, ms."""
    page = phone(browser, state)
    page.goto(url)
    page.locator("canvas").wait_for()
    page.locator(".lab-card").nth(robots - 1).wait_for()
    # All meshes are here.
    page.wait_for_load_state("networkidle")
    page.evaluate("window.answers.length = 0")
    began = time.monotonic()
    browser.start_tracing(page=page, categories=["-*", "gpu"])
    for _ in range(presses):
        page.get_by_role("button", name="Topics").tap()
        page.wait_for_timeout(300)
    page.wait_for_timeout(500)
    events = json.loads(browser.stop_tracing())["traceEvents"]
    lasted = time.monotonic() - began
    held = sum(each.get("dur", 0) * 1e-6 for each in events if each["name"] == READ_BACK)
    answers = sorted(page.evaluate("window.answers")) or [[16.0, 0.0, 0.0]]
    page.context.close()
    slowest, wait, work = answers[-1]
    middle = answers[len(answers) // 2][0]
    times = {"p50 ms": middle, "slowest ms": slowest, "wait ms": wait, "work ms": work}
    return times | {"held %": 100 * held / lasted}


@contextmanager
def playing(count: int) -> Iterator[tuple[str, Any, Any]]:
    """Yield the address of a lab whose robots play, a browser, and the state of a sign-in."""
    with (
        tempfile.TemporaryDirectory() as name,
        launched(Path(name), "--robots", ",".join(["ur5e"] * count)) as lab,
        chromium() as browser,
    ):
        token = lab.done("users", "token").split()[-1]
        bearer = {"authorization": f"Bearer {token}"}
        with httpx.Client(base_url=lab.url, headers=bearer, timeout=60) as client:
            play(client, count)
        context = browser.new_context()
        first = context.new_page()
        first.goto(lab.signed_in_url("/people"))
        first.get_by_role("navigation").first.wait_for()
        state = context.storage_state()
        context.close()
        yield lab.url, browser, state


def pages(size: Size) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    with playing(size.of(*ROBOTS)) as (url, browser, state):
        for page, path in size.some(list(PAGES.items())):
            times = [painted(browser, state, url + path) for _ in range(size.of(1, 3, 5))]
            paint, heading = (sorted(each)[len(each) // 2] for each in zip(*times, strict=True))
            mark = f"< {PAINT_MS}"
            rows.append(
                {"page": page, "first paint ms": paint, "heading ms": heading, "mark": mark}
            )
    return rows


def presses(size: Size) -> list[dict[str, Any]]:
    count = size.of(*ROBOTS)
    with playing(count) as (url, browser, state):
        found = answered(browser, state, f"{url}/lab", count, size.of(2, 10, 30))
    return [{"robots": count, **found, "mark": f"< {ANSWER_MS}"}]


TABLES = {
    "Pages on a phone, 13 robots that play": pages,
    "Presses on the lab page on a phone": presses,
}
