"""A launched lab and its pages: from an upload to what a headset sees; killed in between."""

from __future__ import annotations

import io
import json
import re
import signal
import socket
import time
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlsplit

import httpx
import numpy as np
import psutil
import pytest
import scipy.io
from graph import wait_for
from launched_lab import done, launched_lab
from mrlab_msgs.msg import TrajectoryCatalogue
from own_port import free_endpoint
from rclpy.serialization import deserialize_message
from s3_server import BUCKET, s3_server
from zenoh_side import connect

# Students who send at once; test_trajectories has fifty.
CLASS = 5
LONG = 90.0


def workspace(scale=1.0, rows=120):
    u = np.linspace(0, 1, rows)[:, None]
    q = scale * (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.1
    file = io.BytesIO()
    scipy.io.savemat(file, {"q": q, "fs": 100.0}, do_compression=True)
    return file.getvalue()


class Browser:
    """What the pages do, signed in by the URL that the lab printed."""

    def __init__(self, url):
        self.origin = "http://" + urlsplit(url).netloc
        self.http = httpx.Client(base_url=self.origin, timeout=LONG, follow_redirects=True)
        self.http.get(url)
        csrf = self.http.get("/api/session").json()["csrf"]
        self.headers = {"Origin": self.origin, "X-CSRF-Token": csrf}

    def send(self, method, path, **options):
        headers = self.headers | options.pop("headers", {})
        return self.http.request(method, path, headers=headers, **options)

    def publish(self, name, data):
        sent = self.send("PUT", f"/api/uploads/{name}.mat", content=data).json()
        asked = {"upload": sent["upload"], "robot_model": "ur5e"}
        made = self.send("POST", "/api/conversions", json=asked).json()
        assert made["outcome"] == "accepted", made
        body = {"draft": made["draft"], "id": name}
        return self.send("POST", "/api/trajectories", json=body)

    def ids(self):
        found = self.http.get("/api/trajectories").json()["trajectories"]
        return [f"{each['id']}@{each['version']}" for each in found]


@pytest.fixture
def lab(tmp_path, monkeypatch):
    """Yield a browser, a zenoh session and the state folder of a lab that runs."""
    endpoint = free_endpoint()
    state = tmp_path / "state"
    options = ("--http", "127.0.0.1:0", "--zenoh-listen", endpoint, "--state-dir", state)
    with launched_lab(tmp_path, monkeypatch, *options, "--no-physics"):
        log = tmp_path / "up.log"
        wait_for(lambda: "?token=" in log.read_text(), "the URL", LONG)
        (url,) = re.findall(r"(http://\S+token=\S+)", log.read_text())
        with connect(endpoint) as session:
            yield Browser(url), session, state


def web_process():
    (web,) = [
        each
        for each in json.loads(done("status", "--json"))["supervisor"]["processes"]
        if each["name"] == "web"
    ]
    return psutil.Process(web["pid"])


@pytest.mark.timeout(400)  # a call that a killed converter owes is given up after a minute
def test_a_headset_sees_a_new_version_and_whoever_is_killed_loses_nothing(lab):
    browser, session, state = lab
    seen = []

    def take(sample):
        message = deserialize_message(sample.payload.to_bytes(), TrajectoryCatalogue)
        seen.append({t.id: t.version for t in message.trajectories})

    session.declare_subscriber("trajectories", take)
    for version in (1, 2):
        assert browser.publish("wave", workspace(version / 2)).status_code == 200
        wait_for(lambda v=version: seen and seen[-1].get("wave") == v, "the headset", LONG)
    assert browser.ids() == ["wave@2"]

    # a refused file is drawn, and leaves the catalogue alone
    sent = browser.send("PUT", "/api/uploads/far.mat", content=workspace(20.0)).json()
    asked = {"upload": sent["upload"], "robot_model": "ur5e"}
    refused = browser.send("POST", "/api/conversions", json=asked).json()
    assert (refused["outcome"], refused["draft"]) == ("rejected", None)
    (fix, *_) = refused["diagnostics"][0]["fixes"]
    assert (fix["option"], fix["value"]) == ("units", "deg")
    drawn = browser.http.get(refused["motion"]).json()
    assert (drawn["verdict"], drawn["source"]["file"]) == ("refused", "far.mat")
    mended = browser.send("POST", "/api/conversions", json={**asked, "units": "deg"}).json()
    assert mended["outcome"] == "accepted"
    assert browser.ids() == ["wave@2"]

    # a class at once, all answered
    def one(i):
        return browser.publish(f"run{i}", workspace(0.5 + i / 100)).status_code

    with ThreadPoolExecutor(CLASS) as pool:
        assert set(pool.map(one, range(CLASS))) == {200}
    assert len(browser.ids()) == CLASS + 1
    wait_for(lambda: len(seen[-1]) == CLASS + 1, "the class", LONG)
    # nobody else on the machine reads what they sent
    kept = [state, *state.rglob("*")]
    assert len(kept) > CLASS
    assert {p for p in kept if p.exists() and p.stat().st_mode & 0o077} == set()

    # the gateway is killed in the middle of an upload
    uploads = state / "store" / "users" / "=lab" / "uploads"
    before = sorted(p.name for p in uploads.rglob("*") if p.is_file())
    host, port = urlsplit(browser.origin).netloc.split(":")
    with socket.create_connection((host, int(port))) as half:
        cookies = "; ".join(f"{name}={value}" for name, value in browser.http.cookies.items())
        headers = {**browser.headers, "Host": f"{host}:{port}", "Cookie": cookies,
                   "Content-Length": "50000000"}  # fmt: skip
        lines = [f"{name}: {value}\r\n" for name, value in headers.items()]
        half.sendall(f"PUT /api/uploads/half.mat HTTP/1.1\r\n{''.join(lines)}\r\n".encode())
        half.sendall(bytes(20_000_000))
        victim = web_process()
        wait_for(lambda: sum(f.path.endswith("(deleted)") for f in victim.open_files())
                 or victim.io_counters().write_bytes > 10_000_000, "the body", LONG)  # fmt: skip
        victim.send_signal(signal.SIGKILL)
    wait_for(lambda: answers(browser), "the gateway", LONG)
    assert sorted(p.name for p in uploads.rglob("*") if p.is_file()) == before
    assert list((state / "work").iterdir()) == []
    assert len(browser.ids()) == CLASS + 1

    # the converter is killed in the middle of publishing
    lab_process = next(
        psutil.Process(each["pid"])
        for each in json.loads(done("status", "--json"))["supervisor"]["processes"]
        if each["name"] == "lab"
    )
    with ThreadPoolExecutor(4) as pool:
        asked = [pool.submit(attempt, browser, f"late{i}") for i in range(4)]
        wait_for(lambda: any(f.done() for f in asked), "an answer", LONG)
        lab_process.send_signal(signal.SIGKILL)
        published = [f.result() for f in asked]
    wait_for(lambda: attempt(browser, "after") == "after", "the converter", 2 * LONG)
    listed = {name.split("@")[0] for name in browser.ids()}
    assert {name for name in published if name} <= listed
    for name in sorted(listed - {f"run{i}" for i in range(CLASS)}):
        motion = browser.http.get(f"/api/trajectories/{name}/motion")
        assert motion.status_code == 200, name


def test_a_lab_with_an_s3_server_that_goes_away_and_comes_back(tmp_path, monkeypatch):
    options = ("--http", "127.0.0.1:0", "--zenoh-listen", free_endpoint(), "--no-physics",
               "--state-dir", tmp_path / "state", "--store", f"s3://{BUCKET}/class")  # fmt: skip
    with s3_server() as server, launched_lab(tmp_path, monkeypatch, *options):
        log = tmp_path / "up.log"
        wait_for(lambda: "?token=" in log.read_text(), "the URL", LONG)
        (url,) = re.findall(r"(http://\S+token=\S+)", log.read_text())
        browser = Browser(url)
        assert browser.publish("wave", workspace()).json()["id"] == "wave"
        for part in ("motion", "file?format=csv"):
            assert browser.http.get(f"/api/trajectories/wave/{part}").status_code == 200
        assert not (tmp_path / "state" / "store").exists()
        server.kill()
        # What is known is still shown, and said to be the last known; nothing new is taken.
        known = browser.http.get("/api/trajectories").json()
        assert [each["id"] for each in known["trajectories"]] == ["wave"]
        assert known["problem"]["code"] == "last_known"
        refused = browser.send("PUT", "/api/uploads/a.mat", content=workspace())
        assert refused.status_code == 503
        assert refused.json()["error"]["code"] in ("store_silent", "store_failed")
        server.start()
        assert browser.publish("two", workspace()).json()["version"] == 1
        assert browser.http.get("/api/trajectories/two/motion").status_code == 200


def attempt(browser, name):
    """Publish; return the name where that was answered well."""
    try:
        return name if browser.publish(name, workspace()).status_code == 200 else ""
    except (httpx.HTTPError, KeyError, AssertionError, ValueError):
        time.sleep(0.2)
        return ""


def answers(browser):
    try:
        return browser.http.get("/api/trajectories").status_code == 200
    except httpx.HTTPError:
        return False
