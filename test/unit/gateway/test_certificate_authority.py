"""The lab's own authority over HTTP, and the names of its certificate."""

from __future__ import annotations

from pathlib import Path

import pytest
from cryptography import x509
from gateway_side import Gateway, code_of
from refusals import refused

from mrlab_ros.adapters.diagnostics import FILE_UNWRITABLE
from mrlab_ros.adapters.keys import certificates
from mrlab_ros.adapters.keys.diagnostics import KEY_FILE_OPEN
from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.gateway.diagnostics import (
    BAD_ADDRESS,
    BAD_PUBLIC_URL,
    CERTIFICATE_WITHOUT_KEY,
    INSECURE_WITH_KEYS,
    NO_HTTPS_FILE,
    OPEN_TO_NETWORK,
)
from mrlab_ros.gateway.guard import Hosts
from mrlab_ros.gateway.settings import Settings, parsed_address


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> Keys:
    folder = tmp_path_factory.mktemp("lab") / "keys"
    return Keys.create(folder, ["192.168.7.7", "Lab.example.org"], Login.CERTIFICATE, now())


def test_anybody_can_read_the_authority_and_compare_it(tmp_path: Path, keys: Keys) -> None:
    with Gateway(tmp_path, keys=keys.folder, host="0.0.0.0") as lab:
        stranger = lab.browser()
        page = stranger.get("/ca")
        assert keys.fingerprint in page.text
        assert "<script" not in page.text
        assert "<style" not in page.text
        assert stranger.get("/ca.css").headers["content-type"].startswith("text/css")
        sent = stranger.get("/ca.pem")
        assert sent.headers["content-type"] == "application/x-x509-ca-cert"
        assert b"PRIVATE" not in sent.content
        found = x509.load_pem_x509_certificate(sent.content)
        assert certificates.fingerprint(found) == keys.fingerprint


def test_without_one_there_is_nothing_to_install(local_lab: Gateway) -> None:
    for path in ("/ca", "/ca.pem"):
        assert code_of(local_lab.browser().get(path)) == (404, "no_authority")


def test_a_gateway_is_called_what_its_certificate_names(keys: Keys) -> None:
    hosts = Hosts.of(Settings(state_dir=Path(), host="0.0.0.0", keys=keys.folder))
    for host in ("localhost", "192.168.7.7", "lab.example.org", "LAB.example.org.", "10.0.0.9"):
        assert hosts.allows(host), host
    for host in ("evil.example", "192.168.7.7.evil.example", "", "xlab.example.org"):
        assert not hosts.allows(host), host
    wild = Hosts(frozenset({"*.uni.example"}))
    assert wild.allows("lab.uni.example")
    assert not wild.allows("a.lab.uni.example")
    assert not wild.allows("uni.example")


@pytest.mark.parametrize(
    "url",
    ["foo", "lab.example.org", "ftp://lab", "https://", "https://lab/pages", "https://lab:port",
     "https://[lab", "https://lab?a=b", "https://lab:0"],
)  # fmt: skip
def test_a_public_address_must_be_one_of_a_site(url: str) -> None:
    with refused(BAD_PUBLIC_URL, BadInput, url=url):
        Settings(state_dir=Path(), public_url=url).check()


def test_a_class_may_be_new_where_it_can_be_made(tmp_path: Path) -> None:
    Settings(state_dir=tmp_path, classroom=tmp_path / "new").check()
    with refused(FILE_UNWRITABLE, BadInput, file=str(tmp_path / "gone" / "new")):
        Settings(state_dir=tmp_path, classroom=tmp_path / "gone" / "new").check()


def test_beyond_this_machine_there_is_https_or_nothing(keys: Keys, tmp_path: Path) -> None:
    here = {"state_dir": tmp_path, "host": "0.0.0.0"}
    with refused(OPEN_TO_NETWORK, BadInput, host="0.0.0.0") as caught:
        Settings(**here).check()
    commands = [fix.command for fix in caught.value.diagnostic.fixes]
    assert commands == ["mrlab keys init", "mrlab up --keys keys", "mrlab up --insecure"]
    with refused(OPEN_TO_NETWORK, BadInput):
        Settings(**here, public_url="https://lab.example.org").check()
    Settings(**here, insecure=True).check()
    Settings(**here, keys=keys.folder).check()
    Settings(state_dir=tmp_path).check()
    with refused(INSECURE_WITH_KEYS, BadInput):
        Settings(**here, keys=keys.folder, insecure=True).check()
    with refused(CERTIFICATE_WITHOUT_KEY, BadInput):
        Settings(**here, certificate=tmp_path / "c").check()
    with refused(NO_HTTPS_FILE, BadInput, path=str(tmp_path / "c")):
        Settings(**here, certificate=tmp_path / "c", certificate_key=tmp_path / "k").check()
    open_key = tmp_path / "open.key"
    open_key.write_bytes((keys.folder / "server.key").read_bytes())
    open_key.chmod(0o644)
    with refused(KEY_FILE_OPEN, BadInput, path=str(open_key), mode="644"):
        Settings(**here, certificate=keys.folder / "server.pem", certificate_key=open_key).check()


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("8080", ("127.0.0.1", 8080)), ("0.0.0.0:0", ("0.0.0.0", 0)), ("[::1]:80", ("::1", 80)),
        ("lab:65535", ("lab", 65535)),
    ],
)  # fmt: skip
def test_addresses_are_read(text: str, address: tuple[str, int]) -> None:
    assert parsed_address(text) == address


@pytest.mark.parametrize(
    "text", ["", "lab", ":80", "lab:", "lab:65536", "lab:-1", "lab:8o", "lab:٣"]
)
def test_what_is_no_address_is_refused(text: str) -> None:
    with refused(BAD_ADDRESS, BadInput, address=text):
        parsed_address(text)


def test_with_insecure_whoever_comes_may_do_everything(tmp_path: Path) -> None:
    with Gateway(tmp_path, host="0.0.0.0", insecure=True) as lab:
        stranger = lab.browser()
        assert stranger.user == {"id": "local", "name": "local", "role": "instructor"}
        assert stranger.get("/", headers={"host": "evil.example"}).status_code == 403
