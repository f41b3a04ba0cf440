"""Who may connect: people.json, passwords.txt, and what is said when something is wrong."""

from __future__ import annotations

import stat
from datetime import datetime, timedelta, timezone

import pytest
from refusals import refused

from mrlab_ros.adapters.keys.diagnostics import (
    BAD_KEY_NAME,
    HAS_KEY,
    KEY_FILE_UNREADABLE,
    KEYS_DAMAGED,
    NO_KEYS,
)
from mrlab_ros.adapters.keys.folder import Keys
from mrlab_ros.adapters.keys.people import (
    GATEWAY,
    NOBODY,
    Entry,
    People,
    new_password,
    read_passwords,
    write_passwords,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.bridge.access import Login, Person
from mrlab_ros.core.bridge.rules import Role

NOW = datetime(2026, 9, 1, 8, tzinfo=timezone.utc)
DAY = timedelta(days=1)


def people():
    entries = [
        Entry(Person("ben", Role.OPERATOR, "ben.2"), NOW + 2 * DAY),
        Entry(Person("anna", Role.DISPLAY, "anna.1"), NOW + DAY),
    ]
    return People(Login.BOTH, ["lab"], {entry.person.name: entry for entry in entries})


def test_people_are_read_as_they_were_written_and_for_the_owner_only(tmp_path):
    path = tmp_path / "people.json"
    people().write(path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert People.read(path) == people()
    assert [entry.person.name for entry in People.read(path).entries] == ["anna", "ben"]


def test_whose_certificate_expired_is_left_out():
    names = [[p.name for p in people().at(NOW + n * DAY)] for n in range(3)]
    assert names == [["anna", "ben"], ["ben"], []]


def test_a_missing_list_names_the_command_that_makes_one(tmp_path):
    with refused(NO_KEYS, BadInput, folder=str(tmp_path)) as caught:
        People.read(tmp_path / "people.json")
    (fix,) = caught.value.diagnostic.fixes
    assert fix.command == f"mrlab keys init --dir {tmp_path}"


def test_a_name_is_given_once():
    with refused(HAS_KEY, Misuse, name="anna", role="display"):
        people().check_new("anna")
    people().check_new("carl")


def test_passwords_are_read_as_they_were_written(tmp_path):
    passwords = {"anna": new_password(), "ben": "with:colon"}
    write_passwords(tmp_path / "passwords.txt", passwords)
    assert stat.S_IMODE((tmp_path / "passwords.txt").stat().st_mode) == 0o600
    assert read_passwords(tmp_path / "passwords.txt") == passwords
    with refused(KEY_FILE_UNREADABLE, BadInput):
        read_passwords(tmp_path / "other.txt")


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"login": "smile", "hosts": [], "people": []}'])
def test_a_damaged_list_of_people_is_said(keys, text):
    (keys.folder / "people.json").write_text(text)
    with refused(KEYS_DAMAGED, BadInput):
        Keys(keys.folder)


@pytest.mark.parametrize("name", ["", "a b", "-a", "a:b", "ä", "a" * 42, "../a", NOBODY, GATEWAY])
def test_a_name_that_cannot_be_one_is_refused(keys, name):
    with refused(BAD_KEY_NAME, BadInput, name=name):
        keys.add(name, Role.DISPLAY, NOW)


def test_passwords_are_asked_for_even_where_nobody_has_one(keys):
    keys.add("anna", Role.DISPLAY, NOW)
    keys.revoke("anna")
    assert list(read_passwords(keys.folder / "passwords.txt")) == [NOBODY, GATEWAY]
