from __future__ import annotations

import hashlib

import pytest
from fake_lab import FakeLab
from gateway_side import Gateway, code_of, kind_of

from mrlab_ros.core.bridge.assets import LARGEST_PIECE, Described
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.connection import Refused, Sample

MESH = "/assets/mrlab_ros/robots/ur5e/meshes/link.glb"
BODY = b"glTF" + bytes(2000)
LARGE = b"glTF" + bytes(40 * LARGEST_PIECE)


class Lab(FakeLab):
    """A lab with two meshes; `asked`: the queries for them."""

    def __init__(self) -> None:
        super().__init__()
        self.files = {MESH[1:]: BODY, "assets/large.glb": LARGE}
        self.asked: list[str] = []

    async def get(self, selector: str, timeout_s: float = 5.0) -> Sample | None:
        self.asked.append(selector)
        key, _, parameters = selector.partition("?")
        if key not in self.files:
            raise Refused(f"there is no asset {key}; robots.json says what there is")
        values = dict(each.split("=") for each in parameters.split(";"))
        offset, length = int(values["offset"]), int(values["length"])
        data = self.files[key]
        whole = Described(len(data), f"{len(data):064x}", "model/gltf-binary")
        if len(data) < LARGEST_PIECE:
            whole = Described(len(data), hashlib.sha256(data).hexdigest(), "model/gltf-binary")
        return Sample(key, data[offset : offset + length], attachment=whole.attachment(offset))


@pytest.fixture
def lab():
    return Lab()


@pytest.fixture
def gateway(tmp_path, lab):
    with Gateway(tmp_path, public_url="https://lab.example.org", lab=lab) as made:
        yield made


def test_a_mesh_comes_with_its_type_and_etag(gateway, lab):
    browser = gateway.browser("screen", Role.DISPLAY)
    response = browser.get(MESH)
    assert (response.status_code, response.content) == (200, BODY)
    assert response.headers["content-type"] == "model/gltf-binary"
    assert response.headers["cache-control"] == "private, no-cache"
    assert response.headers["content-encoding"] == "gzip"
    known = {"if-none-match": response.headers["etag"]}
    again = browser.get(MESH, headers=known)
    assert (again.status_code, again.content) == (304, b"")
    assert len(lab.asked) == 1


def test_who_is_not_signed_in_gets_nothing(gateway, lab):
    assert code_of(gateway.anyone.get(MESH)) == (401, "not_signed_in")
    assert not lab.asked


def test_what_is_not_there_is_said_in_the_lab_s_words(gateway):
    browser = gateway.browser("anna")
    response = browser.get("/assets/mrlab_ros/robots/nothing.glb")
    assert kind_of(response) == (404, "not_found")
    assert "robots.json says what there is" in response.text
    for path in (
        "/assets/%2e%2e/%2e%2e/etc/passwd",
        "/assets/a%00b",
        "/assets/**",
        "/assets/",
        "/assets//x",
    ):
        assert browser.get(path).status_code == 404


def test_a_large_mesh_is_streamed(gateway):
    browser = gateway.browser("anna")
    response = browser.get("/assets/large.glb")
    assert (response.status_code, len(response.content)) == (200, len(LARGE))
    assert response.headers["content-length"] == str(len(LARGE))
    known = {"if-none-match": response.headers["etag"]}
    assert browser.get("/assets/large.glb", headers=known).status_code == 304
    head = browser.http.head("/assets/large.glb")
    assert (head.status_code, head.content) == (200, b"")


def test_a_gateway_without_a_lab_says_so(tmp_path):
    with Gateway(tmp_path) as made:
        assert code_of(made.local().get(MESH)) == (503, "gateway_without_lab")
