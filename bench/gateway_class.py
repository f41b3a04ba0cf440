"""A class at once: fifty uploads with their conversions, and how fast the pages appear.

A lab with one UR5e is launched. Each of fifty senders uploads the shipped quintic motion and has
it converted, all at the same time. Then Chromium opens each page anew, with an empty cache.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import report
from gateway import CHROMIUM, FLAGS, free_port
from playwright.sync_api import sync_playwright

from mrlab_ros.commands.demo.lab import claim_free_domain

NEEDS = ("chromium", "playwright")
ROOT = Path(__file__).resolve().parents[1]
MOTION = ROOT / "examples" / "quintic_ur5e.mat"
MRLAB = (sys.executable, "-m", "mrlab_ros.cli")
DEADLINE_S = 180.0
PAGES = ("/", "/trajectories", "/lab")
PAINTS = """() => Object.fromEntries(
  performance.getEntriesByType('paint').map((entry) => [entry.name, entry.startTime]))"""


@contextmanager
def launched(folder: Path) -> Iterator[tuple[str, dict[str, str]]]:
    """Run a lab with pages; yield their address and the environment of commands."""
    run_file, domain = claim_free_domain()
    run_file.release()
    environment = dict(
        os.environ,
        ROS_DOMAIN_ID=str(domain),
        ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
        XDG_RUNTIME_DIR=str(folder),
    )
    http, log = free_port(), folder / "up.log"
    command = (
        *(*MRLAB, "up", "--robots", "ur5e", "--http", f"127.0.0.1:{http}"),
        *("--zenoh-listen", f"tcp/127.0.0.1:{free_port()}", "--state-dir", folder / "state"),
    )
    with log.open("wb") as output:
        process = subprocess.Popen(
            list(map(str, command)), env=environment, stdout=output, stderr=subprocess.STDOUT
        )
    try:
        end = time.monotonic() + DEADLINE_S
        while "is ready" not in log.read_text():
            if process.poll() is not None or time.monotonic() > end:
                raise SystemExit(log.read_text())
            time.sleep(0.2)
        yield f"http://127.0.0.1:{http}", environment
    finally:
        process.terminate()
        process.wait(60)


def opening(environment: dict[str, str], path: str = "/") -> str:
    """Return an address that signs one browser in, once."""
    command = (*MRLAB, "open", "--print", path)
    return subprocess.run(
        command, env=environment, check=True, capture_output=True, text=True
    ).stdout.strip()


def at_once(url: str, cookie: str, senders: int) -> dict[str, Any]:
    """Upload and convert in `senders` threads; return how many got a motion, and times in s."""
    headers = {"cookie": cookie, "origin": url}
    headers["x-csrf-token"] = httpx.get(f"{url}/api/session", headers=headers).json()["csrf"]
    data = MOTION.read_bytes()

    def send(number: int) -> tuple[str, float]:
        begun = time.perf_counter()
        with httpx.Client(base_url=url, headers=headers, timeout=DEADLINE_S) as client:
            sent = client.put(f"/api/uploads/motion_{number}.mat", content=data)
            if sent.status_code != 201:
                return f"upload {sent.status_code}", time.perf_counter() - begun
            body = {"upload": sent.json()["upload"], "robot_model": "ur5e"}
            answer = client.post("/api/conversions", json=body)
        found = answer.json().get("outcome") if answer.is_success else str(answer.status_code)
        return found, time.perf_counter() - begun

    begun = time.perf_counter()
    with ThreadPoolExecutor(senders) as pool:
        outcomes = list(pool.map(send, range(senders)))
    elapsed = time.perf_counter() - begun
    times = [taken for _, taken in outcomes]
    return {
        "senders": senders,
        "accepted": sum(outcome == "accepted" for outcome, _ in outcomes),
        "others": " ".join(sorted({o for o, _ in outcomes if o != "accepted"})) or "none",
        "all, s": elapsed,
        "p50, s": float(np.median(times)),
        "max, s": max(times),
    }


def main() -> None:
    arguments = report.options(__doc__.splitlines()[0]).parse_args()
    with tempfile.TemporaryDirectory() as name, launched(Path(name)) as (url, environment):
        entered = httpx.get(opening(environment))
        cookie = entered.headers["set-cookie"].partition(";")[0]
        rows = [at_once(url, cookie, senders) for senders in (1, 50)]
        report.show("uploads and conversions at once", rows, arguments.json)
        painted = []
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            for path in PAGES:
                page = browser.new_context(bypass_csp=True).new_page()
                page.goto(opening(environment, path))
                page.wait_for_function(f"Object.keys(({PAINTS})()).length === 2")
                paints = page.evaluate(PAINTS)
                painted.append({"page": path, "first paint, ms": paints["first-contentful-paint"]})
                page.close()
            browser.close()
        report.show("pages in Chromium, empty cache", painted, arguments.json)


if __name__ == "__main__":
    main()
