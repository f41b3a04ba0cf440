"""The gateway serves over HTTP what the bridge serves over zenoh."""

from __future__ import annotations

import json
import threading
from pathlib import Path
from xml.etree import ElementTree

import httpx
import pytest
import uvicorn
from gateway_side import Gateway
from graph import wait_for

from mrlab_ros.gateway.lab.zenoh_lab import lab_at

ROOT = Path(__file__).parents[2]


@pytest.fixture
def browser(bridge, endpoint, tmp_path):
    """A browser of a gateway whose lab is the bridge."""
    gateway = Gateway(tmp_path, lab=lab_at(endpoint, None, ""))
    # A server of its own: the connection to the lab belongs to one event loop.
    config = uvicorn.Config(gateway.app, port=0, log_level="warning")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        wait_for(lambda: server.started, "the server", timeout=60)
        port = server.servers[0].sockets[0].getsockname()[1]
        url = f"http://127.0.0.1:{port}"
        with httpx.Client(base_url=url, follow_redirects=True, timeout=60) as client:
            client.get(f"/?token={gateway.people.accounts.open(gateway.clock())}")
            # The gateway's session opens in the background.
            wait_for(
                lambda: client.get("/assets/robots.json").status_code == 200, "the lab", timeout=60
            )
            yield client
    finally:
        server.should_exit = True
        thread.join(60)


def test_a_browser_draws_a_robot_from_the_gateway_alone(browser):
    robots = {each["id"]: each for each in browser.get("/assets/robots.json").json()["robots"]}
    response = browser.get(f"/{robots['ur5e']['urdf']}")
    assert response.headers["content-type"] == "application/xml"
    uris = {mesh.get("filename") for mesh in ElementTree.fromstring(response.text).iter("mesh")}
    for uri in uris:
        mesh = browser.get(uri.replace("package://", "/assets/"))
        place = uri.removeprefix("package://mrlab_ros/")
        assert mesh.content == (ROOT / place).read_bytes()
    again = browser.get(
        f"/{robots['ur5e']['urdf']}", headers={"if-none-match": response.headers["etag"]}
    )
    assert again.status_code == 304


def test_every_thumbnail_is_a_picture(browser):
    robots = browser.get("/assets/robots.json").json()
    objects = browser.get("/assets/objects.json").json()["objects"]
    for entry in (*robots["robots"], *robots["end_effectors"], *objects):
        picture = browser.get(f"/{entry['thumbnail']}")
        assert picture.headers["content-type"] == "image/webp"
        assert picture.content[8:12] == b"WEBP", entry["id"]


def test_the_definitions_are_there_too(browser):
    bundle = json.loads(browser.get("/assets/schema.json").text)
    assert "mrlab_msgs/msg/Robots" in bundle["messages"]


def test_what_is_outside_is_not_served(browser):
    for path in (
        "/assets/mrlab_ros/config/bridge.yaml",
        "/assets/mrlab_ros/robots/ur5e/meshes/%2e%2e/robot.yaml",
        "/assets/mrlab_ros/robots/ur5e/meshes/..%2frobot.yaml",
        "/assets/%2fetc/passwd",
    ):
        response = browser.get(path)
        assert response.status_code == 404, path
        assert response.json()["error"]["kind"] == "not_found"
