"""The keys folder: certificates, passwords, files and what is said when something is wrong."""

from __future__ import annotations

import base64
import json
import os
import socket
import ssl
import stat
import threading
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest
import yaml
import zenoh
from cryptography import x509
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters.keys import certificates
from mrlab_ros.adapters.keys.diagnostics import (
    BAD_KEY_NAME,
    CAMPUS_WITHOUT_LABS,
    CERTIFICATE_EARLY,
    FOLDER_NOT_EMPTY,
    HAS_KEY,
    KEY_FILE_OPEN,
    KEY_FILE_UNREADABLE,
    NEW_KEYS_NEEDED,
    NO_CERTIFICATE,
    NO_HOST,
    NO_HUB_FILE,
    NO_KEY_FILE,
    NO_KEYS,
    NO_PRIVATE_KEY,
    OTHER_AUTHORITY,
    OTHER_KEY,
    RENEWAL_NEEDED,
    ROUTER_KEYS_NEEDED,
)
from mrlab_ros.adapters.keys.folder import (
    AUTHORITY_LIFETIME,
    SERVER_LIFETIME,
    Keys,
)
from mrlab_ros.adapters.keys.people import GATEWAY, NOBODY, read_passwords
from mrlab_ros.adapters.keys.zenoh_settings import Hub
from mrlab_ros.cli import make_app
from mrlab_ros.commands.diagnostics import BRIDGE_PORT_TAKEN, KEYS_OR_INSECURE, ROUTER_WITHOUT_KEYS
from mrlab_ros.commands.up import keys as up_keys
from mrlab_ros.commands.up.keys import checked_listen, checked_router, free_endpoint
from mrlab_ros.commands.up.web import prepare_keys
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.diagnostics import (
    KEYS_NEED_TLS,
    OPEN_ENDPOINT,
    ROUTER_WITHOUT_TLS,
    TLS_NEEDS_KEYS,
)
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.processes.lab import lab_processes
from mrlab_ros.processes.options import LabOptions

NOW = datetime(2026, 9, 1, 8, tzinfo=timezone.utc)
ROOT = Path(__file__).parents[4]
RULES = rules.parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text()))
DAY = timedelta(days=1)


def certificate(keys, name):
    return certificates.read_certificate(keys.folder / name)


def client_certificate(keys, name):
    config = zenoh.Config.from_file(str(keys.client_file(name)))
    encoded = json.loads(config.get_json("transport/link/tls/connect_certificate_base64"))
    return x509.load_pem_x509_certificate(base64.b64decode(encoded))


def purposes(found):
    return list(found.extensions.get_extension_for_class(x509.ExtendedKeyUsage).value)


def test_the_lab_s_certificate_names_where_it_may_listen_and_may_only_serve(keys):
    found, authority = certificate(keys, "server.pem"), certificate(keys, "ca.pem")
    assert certificates.hosts(found) == [
        "lab.example.org",
        "192.168.1.20",
        "localhost",
        "127.0.0.1",
    ]
    assert purposes(found) == [ExtendedKeyUsageOID.SERVER_AUTH]
    found.verify_directly_issued_by(authority)
    assert certificates.validity(found)[1] == NOW + SERVER_LIFETIME
    assert certificates.validity(authority)[1] == NOW + AUTHORITY_LIFETIME
    known = authority.extensions.get_extension_for_class(x509.SubjectKeyIdentifier).value
    named = found.extensions.get_extension_for_class(x509.AuthorityKeyIdentifier).value
    assert named.key_identifier == known.digest
    assert authority.extensions.get_extension_for_class(x509.BasicConstraints).value.ca
    assert not found.extensions.get_extension_for_class(x509.BasicConstraints).value.ca


def test_a_client_s_certificate_carries_the_name_and_may_only_connect(keys):
    entry = keys.add("anna", Role.OPERATOR, NOW)
    found = client_certificate(keys, "anna")
    assert purposes(found) == [ExtendedKeyUsageOID.CLIENT_AUTH]
    (name,) = found.subject.get_attributes_for_oid(NameOID.COMMON_NAME)
    assert name.value == entry.person.common_name
    assert str(name.value).startswith("anna.")


@pytest.mark.parametrize(
    ("name", "good"), [("localhost", True), ("127.0.0.1", True), ("elsewhere.example", False)]
)
def test_openssl_accepts_the_lab_under_its_names_only(tmp_path, name, good):
    # OpenSSL reads this machine's clock.
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    assert shakes_hands(keys, name) == good


def shakes_hands(keys, name):
    """Return whether OpenSSL as a client accepts the lab under `name`, in memory."""
    server = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    server.load_cert_chain(keys.folder / "server.pem", keys.folder / "server.key")
    client = ssl.create_default_context(cafile=str(keys.folder / "ca.pem"))
    to_server, to_client = ssl.MemoryBIO(), ssl.MemoryBIO()
    ends = [
        client.wrap_bio(to_client, to_server, server_hostname=name),
        server.wrap_bio(to_server, to_client, server_side=True),
    ]
    done = set()
    for _ in range(10):
        for end in ends:
            try:
                end.do_handshake()
                done.add(end)
            except ssl.SSLWantReadError:
                pass
            except ssl.SSLError:
                return False
    return len(done) == 2


def test_only_the_owner_can_read_the_files(keys):
    keys.add("anna", Role.DISPLAY, NOW)
    modes = {p: stat.S_IMODE(p.stat().st_mode) for p in keys.folder.rglob("*")}
    assert stat.S_IMODE(keys.folder.stat().st_mode) == 0o700
    assert all(mode == (0o700 if p.is_dir() else 0o600) for p, mode in modes.items()), modes
    assert (keys.folder / ".gitignore").read_text() == "*\n"
    assert {p.name for p in modes} == {
        ".gitignore",
        "anna.json5",
        "ca.key",
        "ca.pem",
        "clients",
        "gateway.json5",
        "passwords.txt",
        "people.json",
        "server.key",
        "server.pem",
    }


def test_nothing_that_exists_is_overwritten(keys):
    keys.add("anna", Role.DISPLAY, NOW)
    before = {p: p.read_bytes() for p in keys.folder.rglob("*") if p.is_file()}
    with refused(FOLDER_NOT_EMPTY, Misuse):
        Keys.create(keys.folder, [], Login.BOTH, NOW)
    with refused(HAS_KEY, Misuse, name="anna", role="display"):
        keys.add("anna", Role.INSTRUCTOR, NOW)
    assert {p: p.read_bytes() for p in keys.folder.rglob("*") if p.is_file()} == before


def test_who_gets_a_name_anew_does_not_bring_the_old_certificate_back(keys):
    first = keys.add("anna", Role.INSTRUCTOR, NOW).person.common_name
    password = read_passwords(keys.folder / "passwords.txt")["anna"]
    keys.revoke("anna")
    assert not keys.client_file("anna").exists()
    assert "anna" not in read_passwords(keys.folder / "passwords.txt")
    second = keys.add("anna", Role.DISPLAY, NOW).person.common_name
    subjects = keys.settings(RULES, "", NOW)["access_control"]["subjects"]
    names = {subject["id"]: subject["cert_common_names"] for subject in subjects}
    assert names["anna"] == [second]
    assert first != second
    assert read_passwords(keys.folder / "passwords.txt")["anna"] != password


def test_a_folder_is_read_back_as_it_was_written(keys):
    keys.add("anna", Role.OPERATOR, NOW)
    keys.add("ben", Role.DISPLAY, NOW, 7 * DAY)
    again = Keys(keys.folder)
    assert again.entries == keys.entries
    assert again.login is Login.BOTH
    assert again.hosts == keys.hosts
    assert again.entries[1].expires == NOW + 7 * DAY


def test_nothing_outlives_the_authority(keys):
    late = NOW + AUTHORITY_LIFETIME - 3 * DAY
    assert keys.add("anna", Role.DISPLAY, late).expires == NOW + AUTHORITY_LIFETIME


def test_a_renewed_lab_has_more_names_and_everybody_s_keys_still(keys):
    keys.add("anna", Role.DISPLAY, NOW)
    later = NOW + SERVER_LIFETIME + DAY
    with refused(RENEWAL_NEEDED, BadInput) as caught:
        keys.check(later)
    assert caught.value.diagnostic.values["why"].diagnostic.code == "certificate_expired"
    assert caught.value.diagnostic.fixes[0].command == f"mrlab keys renew --dir {keys.folder}"
    keys.renew(["10.0.0.5"], later)
    keys.check(later)
    assert "10.0.0.5" in certificates.hosts(certificate(keys, "server.pem"))
    assert client_certificate(keys, "anna").issuer == certificate(keys, "server.pem").issuer


def swap_authority(keys):
    other = Keys.create(keys.folder.parent / "other", [], Login.BOTH, NOW)
    (keys.folder / "ca.pem").write_bytes((other.folder / "ca.pem").read_bytes())


def open_to_others(name, mode):
    return lambda keys: (keys.folder / name).chmod(mode)


def swap_key(keys):
    other = Keys.create(keys.folder.parent / "other", [], Login.BOTH, NOW)
    (keys.folder / "server.key").write_bytes((other.folder / "server.key").read_bytes())


@pytest.mark.parametrize(
    ("spoil", "code", "values"),
    [
        (lambda keys: (keys.folder / "server.key").unlink(), NO_KEY_FILE, {}),
        (lambda keys: (keys.folder / "server.pem").unlink(), NO_KEY_FILE, {}),
        (lambda keys: (keys.folder / "ca.pem").unlink(), NO_KEY_FILE, {}),
        (lambda keys: (keys.folder / "passwords.txt").unlink(), NO_KEY_FILE, {}),
        (lambda keys: (keys.folder / "server.pem").write_text("x"), NO_CERTIFICATE, {}),
        (lambda keys: (keys.folder / "server.key").write_text("x"), NO_PRIVATE_KEY, {}),
        (swap_authority, OTHER_AUTHORITY, {}),
        (swap_key, OTHER_KEY, {}),
        (lambda keys: (keys.folder / "server.key").chmod(0o644), KEY_FILE_OPEN, {"mode": "644"}),
        (
            lambda keys: (keys.folder / "passwords.txt").chmod(0o640),
            KEY_FILE_OPEN,
            {"mode": "640"},
        ),
    ],
)
def test_a_lab_does_not_start_with_a_spoilt_folder_and_says_why(keys, spoil, code, values):
    keys.check(NOW)
    spoil(keys)
    with refused(code, BadInput, **values):
        keys.check(NOW)


@pytest.mark.parametrize(
    ("when", "code"),
    [(NOW - 3 * DAY, CERTIFICATE_EARLY), (NOW + AUTHORITY_LIFETIME + DAY, NEW_KEYS_NEEDED)],
)
def test_a_clock_out_of_bounds_is_said(keys, when, code):
    with refused(code, BadInput):
        keys.check(when)


def test_a_file_that_may_not_be_read_is_said(keys):
    # root may read everything, so the refusal comes from a folder in the file's place.
    (keys.folder / "server.key").unlink()
    (keys.folder / "server.key").mkdir()
    with refused(KEY_FILE_UNREADABLE, BadInput, why=os.strerror(21)):
        keys.check(NOW)


@pytest.mark.parametrize(
    "host", ["1.2.3.4:7447", "a_b", "", "-a", "256.1.1.1", "a..b", "*.a", "x" * 64]
)
def test_a_host_that_cannot_be_one_is_refused_and_nothing_is_made(tmp_path, host):
    with refused(NO_HOST, BadInput, host=host):
        Keys.create(tmp_path / "keys", [host], Login.BOTH, NOW)
    assert not (tmp_path / "keys").exists()


def run(*arguments):
    return CliRunner().invoke(make_app(), ["keys", *map(str, arguments)])


def test_a_certificate_names_the_address_and_the_host_name_of_its_machine(tmp_path, monkeypatch):
    class Probe(socket.socket):
        def connect(self, _address):
            if ours is None:
                raise OSError("Network is unreachable")

        def getsockname(self):
            return (ours, 1)

    monkeypatch.setattr(socket, "socket", Probe)
    monkeypatch.setattr(socket, "gethostname", lambda: "lab-pc")
    for ours, hosts in (
        ("192.168.1.20", ["x.org", "192.168.1.20", "lab-pc", "localhost", "127.0.0.1"]),
        ("127.0.0.1", ["x.org", "lab-pc", "localhost", "127.0.0.1"]),
        (None, ["x.org", "lab-pc", "localhost", "127.0.0.1"]),
    ):
        made = run("init", "--dir", tmp_path / str(ours), "--host", "x.org", "--json")
        assert json.loads(made.stdout)["hosts"] == hosts


@pytest.mark.slow
def test_the_command_makes_lists_and_takes_back_keys(tmp_path):
    folder = tmp_path / "keys"
    made = json.loads(run("init", "--dir", folder, "--host", "lab.example.org", "--json").stdout)
    assert made["login"] == "certificate"
    assert made["hosts"][0] == "lab.example.org"
    assert {"localhost", "127.0.0.1"} <= set(made["hosts"])
    added = json.loads(
        run("add", "anna", "ben", "--role", "operator", "--dir", folder, "--json").stdout
    )
    assert [Path(entry["file"]).is_file() for entry in added] == [True, True]
    assert "ben" in run("revoke", "ben", "--dir", folder).stdout
    gone = json.loads(run("add", "eve", "--role", "display", "--dir", folder, "--json").stdout)
    taken = json.loads(run("revoke", "eve", "--dir", folder, "--json").stdout)
    assert taken[0]["common_name"] == gone[0]["common_name"]
    found = json.loads(run("list", "--dir", folder, "--json").stdout)
    assert [(p["name"], p["role"]) for p in found["people"]] == [("anna", "operator")]
    assert "anna" in run("list", "--dir", folder).stdout
    assert "10.0.0.5" in run("renew", "--dir", folder, "--host", "10.0.0.5").stdout
    config = json.loads(run("config", "--dir", folder, "--prefix", "lab_1").stdout)
    assert config["access_control"]["subjects"][0]["id"] == "anna"
    assert config["transport"]["link"]["tls"]["enable_mtls"] is True
    assert isinstance(run("init", "--dir", folder).exception, LabError)


def test_init_says_what_to_do_next(tmp_path):
    said = run("init", "--dir", tmp_path / "keys").stdout
    assert "mrlab keys add" in said
    assert f"mrlab up --keys {tmp_path / 'keys'}" in said
    assert "mrlab keys renew --host ADDRESS" in said


def test_up_listens_everywhere_only_with_keys_or_when_told(tmp_path):
    folder = tmp_path / "keys"
    Keys.create(folder, [], Login.CERTIFICATE, datetime.now(timezone.utc))
    assert checked_listen("", None, False) == "tcp/127.0.0.1:7447"
    assert checked_listen("", folder, False) == "tls/0.0.0.0:7447"
    assert checked_listen("tcp/0.0.0.0:1", None, True) == "tcp/0.0.0.0:1"
    with refused(OPEN_ENDPOINT, BadInput, endpoint="tcp/0.0.0.0:1"):
        checked_listen("tcp/0.0.0.0:1", None, False)
    with refused(KEYS_NEED_TLS, BadInput, better="tls/127.0.0.1:1"):
        checked_listen("tcp/127.0.0.1:1", folder, False)
    with refused(KEYS_OR_INSECURE, BadInput):
        checked_listen("", folder, True)
    with refused(TLS_NEEDS_KEYS, BadInput, protocol="tls"):
        checked_listen("tls/0.0.0.0:1", None, False)
    with refused(NO_KEYS, BadInput):
        checked_listen("", tmp_path / "none", False)


def test_up_refuses_an_address_where_nobody_can_listen():
    kept, _, port = free_endpoint("tcp/127.0.0.1:0").rpartition(":")
    assert kept == "tcp/127.0.0.1"
    assert int(port) > 0, "who is told of the address can connect to it"
    with refused(BRIDGE_PORT_TAKEN, BadInput, endpoint="tcp/256.0.0.1:0"):
        free_endpoint("tcp/256.0.0.1:0")
    with socket.create_server(("127.0.0.1", 0)) as other:
        taken = f"tcp/127.0.0.1:{other.getsockname()[1]}"
        done = CliRunner().invoke(make_app(["up"]), ["up", "--no-web", "--zenoh-listen", taken])
        assert isinstance(done.exception, BadInput)
        assert done.exception.diagnostic.code == "bridge_port_taken"
        assert done.exception.diagnostic.values["endpoint"] == taken
    assert free_endpoint(taken) == taken


def test_up_connects_to_a_router_with_keys_alone(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    there = "tls/router.example.org:7447"
    with refused(ROUTER_WITHOUT_KEYS, BadInput, router=there):
        checked_router(there, "", None, False)
    with refused(ROUTER_WITHOUT_KEYS, BadInput, router=there):
        checked_router(there, "tls/0.0.0.0:7447", keys.folder, False)
    with refused(ROUTER_WITHOUT_TLS, BadInput):
        checked_router("tcp/router.example.org:7447", "", keys.folder, False)
    with refused(ROUTER_KEYS_NEEDED, BadInput):
        checked_router(there, "", keys.folder, False)
    assert "zenohd -c router.json5" in run("router", "--dir", keys.folder).stdout
    assert checked_router(there, "", keys.folder, False) == there
    options = LabOptions(tmp_path / "lab.yaml", tmp_path, connect=there, keys=keys.folder)
    argv = next(p.arguments(options) for p in lab_processes(options) if p.name == "bridge")
    assert f'bridge:connect:=["{there}"]' in argv
    assert 'bridge:mode:="client"' in argv
    assert not any("listen" in part for part in argv)


def test_the_router_s_file_is_for_its_owner_and_the_lab_keeps_its_name(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    run("router", "--dir", keys.folder)
    name = certificates.common_name(certificate(keys, "lab.pem"))
    added = run("add", "anna", "--role", "display", "--dir", keys.folder)
    assert "A router needs a new file" in added.stdout
    run("router", "--dir", keys.folder, "--prefix", "lab_1")
    added = run("add", "bert", "--role", "display", "--dir", keys.folder)
    assert f"mrlab keys router --dir {keys.folder} --prefix lab_1" in added.stdout
    for file in ("lab.pem", "lab.key", "router.json5"):
        assert stat.S_IMODE((keys.folder / file).stat().st_mode) == 0o600
    assert certificates.common_name(certificate(keys, "lab.pem")) == name
    assert purposes(certificate(keys, "lab.pem")) == [ExtendedKeyUsageOID.CLIENT_AUTH]
    document = json.loads((keys.folder / "router.json5").read_text())
    assert document["adminspace"] == {"enabled": False}
    assert document["transport"]["link"]["protocols"] == ["tls", "quic"]
    names = [subject["id"] for subject in document["access_control"]["subjects"]]
    assert names == ["anna", "gateway", "the lab"]
    assert document["access_control"]["subjects"][2]["cert_common_names"] == [name]


def test_the_lab_s_certificate_for_its_router_is_made_anew_with_the_file(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, NOW)
    keys.router(RULES, "", {}, NOW)
    later = NOW + SERVER_LIFETIME + DAY
    with refused(ROUTER_KEYS_NEEDED, BadInput):
        keys.lab_settings(later)
    keys.renew([], later)
    assert keys.server_expires(router=True) < later
    keys.router(RULES, "", {}, later)
    assert keys.server_expires(router=True) > later
    assert keys.lab_settings(later)["transport/link/tls/enable_mtls"] is True


def test_the_gateway_s_key_is_made_anew_and_the_one_before_is_taken_back(keys):
    def subject():
        found = keys.settings(RULES, "", NOW)["access_control"]["subjects"]
        return next(each for each in found if each["id"] == GATEWAY)

    assert keys.has_gateway(NOW)
    first, file = subject(), keys.gateway_file.read_text()
    assert run("gateway", "--dir", keys.folder).exit_code == 0
    assert Keys(keys.folder).gateway_file.read_text() != file
    again = Keys(keys.folder)
    found = again.settings(RULES, "", NOW)["access_control"]["subjects"]
    assert next(each for each in found if each["id"] == GATEWAY) != first
    assert not keys.has_gateway(NOW + SERVER_LIFETIME + DAY)
    keys.gateway_file.unlink()
    assert not keys.has_gateway(NOW)
    assert GATEWAY not in [entry.person.name for entry in again.entries]


def test_a_folder_of_before_the_gateway_is_read(keys):
    document = json.loads((keys.folder / "people.json").read_text())
    del document["gateway"]
    (keys.folder / "people.json").write_text(json.dumps(document))
    old = Keys(keys.folder)
    assert not old.has_gateway(NOW)
    prepare_keys(keys.folder)
    assert Keys(keys.folder).has_gateway(datetime.now(timezone.utc))


def test_commands_at_the_same_time_lose_nobody(tmp_path):
    folder = Keys.create(tmp_path / "keys", [], Login.BOTH, NOW).folder
    others = [Keys(folder) for _ in range(4)]
    threads = [
        threading.Thread(target=keys.add, args=(f"person_{i}", Role.DISPLAY, NOW))
        for i, keys in enumerate(others)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    everybody = {f"person_{i}" for i in range(4)}
    assert {entry.person.name for entry in Keys(folder).entries} == everybody
    assert set(read_passwords(folder / "passwords.txt")) == everybody | {NOBODY, GATEWAY}


def test_several_names_are_added_and_taken_back_all_or_none(keys):
    bad = run("add", "anna", "ben!", "--role", "display", "--dir", keys.folder)
    assert isinstance(bad.exception, BadInput)
    assert Keys(keys.folder).entries == []
    assert run("add", "anna", "anna", "--role", "display", "--dir", keys.folder).exit_code == 0
    assert isinstance(run("revoke", "anna", "eve", "--dir", keys.folder).exception, BadInput)
    assert [entry.person.name for entry in Keys(keys.folder).entries] == ["anna"]
    assert run("revoke", "anna", "anna", "--dir", keys.folder).exit_code == 0


def test_a_lab_says_when_its_certificate_expires_soon(tmp_path):
    said = []
    for age, told in ((DAY, False), (SERVER_LIFETIME - 10 * DAY, True)):
        begin = datetime.now(timezone.utc) - age
        folder = tmp_path / str(age.days)
        Keys.create(folder, [], Login.CERTIFICATE, begin)
        up_keys.tell_when_keys_expire(folder, lambda _, line: said.append(line))
        assert bool(said) == told
    assert "expires in 9 days" in said[0]
    assert "mrlab keys renew" in said[0]


class Turns:
    """Stands in for the event that ends follow_keys: each wait is one step of a test."""

    def __init__(self, steps) -> None:
        self.steps = steps

    def wait(self, _period: float) -> bool:
        """Run the test up to its next yield; True: it has ended."""
        return next(self.steps, True) is True


def test_a_running_lab_follows_its_keys_and_never_into_a_broken_folder(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    said, restarts = [], []

    def steps():
        yield
        assert said == []
        (keys.folder / "server.pem").unlink()
        keys.add("anna", Role.DISPLAY, datetime.now(timezone.utc))
        yield
        yield
        (complaint,) = said
        assert str(keys.folder / "server.pem") in complaint
        assert restarts == []
        keys.renew([], datetime.now(timezone.utc))
        yield
        yield
        assert restarts.count("bridge") == 1
        assert "starts again" in said[-1]
        aside = keys.folder.rename(tmp_path / "aside")
        yield
        yield
        assert "has no keys" in said[-1]
        assert len(said) == 3
        aside.rename(keys.folder)
        yield
        assert restarts.count("bridge") == 1
        keys.add("ben", Role.DISPLAY, datetime.now(timezone.utc))
        yield
        assert restarts.count("bridge") == 2
        assert "starts again" in said[-1]
        assert len(said) == 4

    def say(_, line):
        said.append(line)

    seen = up_keys.keys_changed_at(keys.folder)
    up_keys.follow_keys(keys.folder, seen, Turns(steps()), say, restarts.append)
    assert restarts.count("bridge") == 2


def test_keys_renewed_while_a_lab_starts_reach_bridge_and_pages(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    restarts = []
    seen = up_keys.keys_changed_at(keys.folder)
    keys.renew([], datetime.now(timezone.utc))
    once = Turns(iter([False]))
    up_keys.follow_keys(keys.folder, seen, once, lambda *_: None, restarts.append)
    assert restarts == ["bridge", "web"]


def test_keys_are_not_read_while_a_command_changes_them(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, datetime.now(timezone.utc))
    server = keys.folder / "server.pem"
    said, restarts = [], []

    def steps():
        with keys._alone():
            whole = server.read_bytes()
            server.unlink()
            yield
            yield
            assert said == []
            server.write_bytes(whole)
        yield
        assert restarts.count("bridge") == 1

    def say(_, line):
        said.append(line)

    seen = up_keys.keys_changed_at(keys.folder)
    up_keys.follow_keys(keys.folder, seen, Turns(steps()), say, restarts.append)
    assert restarts == ["bridge", "web"]
    assert len(said) == 1


def test_a_campus_locks_out_the_lab_that_it_names_no_more(tmp_path):
    keys = Keys.create(tmp_path / "keys", ["campus.example.org"], Login.CERTIFICATE, NOW)

    def known(*labs):
        document = json.loads(keys.router(RULES, "campus", {}, NOW, labs=labs).read_text())
        subjects = document["access_control"]["subjects"]
        return {s["id"]: s["cert_common_names"] for s in subjects if s["id"] != "gateway"}

    first = known("north", "south")
    assert set(first) == {"the lab campus/north", "the lab campus/south"}
    file = keys.lab_file("north").read_text()
    assert known("north") == {"the lab campus/north": first["the lab campus/north"]}
    assert keys.lab_file("north").read_text() == file
    with refused(CAMPUS_WITHOUT_LABS, Misuse, labs=["north"]):
        known()
    again = known("north", "south")
    assert again["the lab campus/south"] != first["the lab campus/south"]
    with refused(BAD_KEY_NAME, BadInput):
        known("../north")


def test_a_lab_s_router_takes_the_campus_for_a_person_of_one_role(tmp_path):
    campus = Keys.create(tmp_path / "campus", ["campus.example.org"], Login.CERTIFICATE, NOW)
    campus.router(RULES, "campus", {}, NOW, labs=["north"])
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, NOW)
    hub = Hub.read(campus.lab_file("north"), Role.STUDENT)
    document = json.loads(keys.router(RULES, "campus/north", {}, NOW, hub=hub).read_text())
    # Not the address of the campus's machine for itself.
    assert document["connect"]["endpoints"] == ["tls/campus.example.org:7447"]
    policies = {p["id"]: p["subjects"] for p in document["access_control"]["policies"]}
    assert policies["student"] == ["the campus"]
    for wrong in (keys.folder / "router.json5", keys.folder / "ca.pem", tmp_path):
        with refused(NO_HUB_FILE, BadInput):
            Hub.read(wrong, Role.DISPLAY)
