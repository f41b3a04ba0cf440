"""From a call in Octave to the pose on a page: what each hop takes, and many calls in a row.

Octave runs `mrlab.show` of the toolbox against a launched lab while Chromium has the page open.
`call`: until it returns, with saving the array and curl. `request`: the same bytes sent from
Python, thus upload, conversion and answer. `conversion`: of an upload that is there already.
`page`: from the call's return until the page has drawn the first pose, on the same clock.
"""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import psutil
import scipy.io
from lab import ROOT
from measures.gateway import chromium, launched
from size import Size

NEEDS = ("chromium", "playwright", "octave-cli", "curl")
DEADLINE_S = 300.0
CASES = ((601, 6), (100_000, 7))
# Notes when the controls of another motion are there, and when the picture after that is drawn.
WATCH = """() => {
  window.drawn = {}
  new MutationObserver(() => {
    const clock = document.querySelector('.scene-clock')?.textContent ?? ''
    const total = clock.split('/')[1]?.trim()
    if (!total || total in window.drawn) return
    window.drawn[total] = 0
    requestAnimationFrame(() => requestAnimationFrame(() => { window.drawn[total] = Date.now() }))
  }).observe(document.body, { subtree: true, childList: true, characterData: true })
}"""
SCRIPT = """
mrlab.connect('{url}', 'token', '{token}');
for k = 1:{calls}
    n = {rows} + k * {step};
    q = zeros(n, {columns});
    q(:, 1:6) = 0.2 * sin((1:n)' / 200) * ones(1, 6) - 0.5;
    begun = time();
    report = mrlab.show(q, 100, 'robot', 'ur5e'{more});
    printf('%.2f %.6f %.6f\\n', (n - 1) / 100, begun, time());
    fflush(stdout);
    pause({pause});
end
"""


@dataclass(frozen=True)
class Open:
    """A launched lab, a token of its local user, a client with it, and the upload page."""

    lab: Any
    token: str
    client: httpx.Client
    page: Any


@contextmanager
def opened(folder: Path) -> Iterator[Open]:
    """Start a lab in `folder` and open its upload page in Chromium."""
    with launched(folder) as lab, chromium() as browser:
        token = lab.done("users", "token").split()[-1]
        bearer = {"authorization": f"Bearer {token}"}
        with httpx.Client(base_url=lab.url, timeout=DEADLINE_S, headers=bearer) as client:
            page = browser.new_context(bypass_csp=True).new_page()
            page.goto(lab.signed_in_url("/"))
            page.get_by_role("radio", name="UR5e").wait_for(state="attached")
            yield Open(lab, token, client, page)


def octave(folder: Path, script: str) -> str:
    (folder / "bench.m").write_text(script)
    command = ("octave-cli", "--no-init-file", "--no-history", "--path", str(ROOT / "matlab"))
    done = subprocess.run(
        (*command, "bench.m"), cwd=folder, capture_output=True, text=True, check=True,
        timeout=DEADLINE_S, env=os.environ | {"HOME": str(folder)},
    )  # fmt: skip
    return done.stdout


def saved(q: Any) -> bytes:
    """Return a workspace file that holds an array."""
    made = io.BytesIO()
    scipy.io.savemat(made, {"q": q})
    return made.getvalue()


def ms(values: list[float]) -> float:
    return float(np.median(values)) * 1e3


def hops(size: Size) -> list[dict[str, Any]]:
    rows = []
    with tempfile.TemporaryDirectory() as name, opened(Path(name)) as there:
        there.page.evaluate(WATCH)
        for frames, columns in size.some(CASES):
            calls = size.of(2, 10, 20) if frames < 10_000 else size.of(2, 3, 6)
            more = "" if columns == 6 else ", 'end_effector', 'parallel_gripper'"
            text = SCRIPT.format(
                url=there.lab.url, token=there.token, calls=calls, rows=frames, columns=columns,
                step=1 if frames < 10_000 else 100, more=more, pause=1 if frames < 10_000 else 4,
            )  # fmt: skip
            # The first call of a page has the robot to load.
            said = re.findall(r"^(\S+) (\d+\.\d{6}) (\d+\.\d{6})$", octave(Path(name), text), re.M)
            last = f"{float(said[-1][0]):.2f} s"
            there.page.wait_for_function(f"window.drawn['{last}'] > 0")
            drawn = there.page.evaluate("window.drawn")
            seen = {f"{float(total):.2f} s": float(end) for total, _, end in said[1:]}
            request, conversion = direct(there.client, frames, columns)
            rows.append(
                {
                    "array": f"{frames} x {columns}",
                    "call ms": ms([float(end) - float(begun) for _, begun, end in said[1:]]),
                    "request ms": request,
                    "conversion ms": conversion,
                    "page ms": ms(
                        [drawn[t] / 1e3 - end for t, end in seen.items() if drawn.get(t)]
                    ),
                    "drawn": sum(bool(drawn.get(t)) for t in seen),
                    "of": len(seen),
                }
            )
    return rows


def direct(client: httpx.Client, frames: int, columns: int) -> tuple[float, float]:
    """Return how long request and conversion of such an array take, ms."""
    q = np.zeros((frames, columns))
    q[:, :6] = 0.2 * np.sin(np.arange(frames) / 200)[:, None] - 0.5
    content = saved(q)
    options = {"robot_model": "ur5e", "frame_rate": 100}
    if columns > 6:
        options["end_effector"] = "parallel_gripper"
    requests, conversions = [], []
    for _ in range(5):
        begun = time.perf_counter()
        answer = client.put("/api/live/direct.mat", content=content, params=options)
        requests.append(time.perf_counter() - begun)
        upload = answer.raise_for_status().json()["upload"]["upload"]
        begun = time.perf_counter()
        client.post("/api/conversions", json={"upload": upload, **options}).raise_for_status()
        conversions.append(time.perf_counter() - begun)
    return ms(requests), ms(conversions)


def many(size: Size) -> list[dict[str, Any]]:
    """Ten calls a second: what becomes of them, and of the gateway's memory."""
    seconds = size.of(2, 20, 60)
    q = 0.2 * np.sin(np.arange(601) / 200)[:, None] - 0.5 + np.zeros((601, 6))
    outcomes: list[int] = []
    with tempfile.TemporaryDirectory() as name, opened(Path(name)) as there:
        (process,) = [
            each for each in psutil.process_iter(["cmdline", "environ"])
            if "mrlab_ros.gateway" in (each.info["cmdline"] or ())
            and name in (each.info["environ"] or {}).get("XDG_RUNTIME_DIR", "")
        ]  # fmt: skip
        memory = []
        content = saved(q)
        begun = time.monotonic()
        for k in range(seconds * 10):
            time.sleep(max(0.0, begun + k * 0.1 - time.monotonic()))
            answer = there.client.put(
                f"/api/live/call_{k}.mat", content=content,
                params={"robot_model": "ur5e", "frame_rate": 100},
            )  # fmt: skip
            outcomes.append(answer.status_code)
            memory.append(process.memory_info().rss / 1e6)
        took = time.monotonic() - begun
        there.page.locator(".verdict-file", has_text=f"call_{k}.mat").wait_for()
        shown = time.monotonic() - begun - took
        user = json.loads(there.client.get("/api/session").text)["user"]["name"]
        kept = len(list((there.lab.state / "store" / "users").rglob("*.mat")))
    tenth = max(1, len(memory) // 10)
    return [
        {
            "calls": len(outcomes),
            "taken": outcomes.count(201),
            "s": took,
            "newest shown after s": shown,
            "gateway MB, first tenth": float(np.median(memory[:tenth])),
            "last tenth": float(np.median(memory[-tenth:])),
            f"files of {user} left": kept,
        }
    ]


TABLES = {"From Octave to the page": hops, "Ten calls a second": many}
