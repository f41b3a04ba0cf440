"""zenoh's settings from a keys folder, read back by zenoh itself."""

from __future__ import annotations

import json
import stat
from datetime import datetime, timedelta, timezone
from pathlib import Path

import yaml
import zenoh

from mrlab_ros.adapters.keys.folder import Keys
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.rules import Role

NOW = datetime(2026, 9, 1, 8, tzinfo=timezone.utc)
DAY = timedelta(days=1)
ROOT = Path(__file__).parents[4]
RULES = rules.parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text()))


def test_an_expired_person_has_no_rights_by_password_either(keys):
    keys.add("anna", Role.DISPLAY, NOW, DAY)

    def names(time):
        subjects = keys.settings(RULES, "", time)["access_control"]["subjects"]
        return [subject["id"] for subject in subjects]

    assert names(NOW) == ["anna", "gateway"]
    assert names(NOW + 2 * DAY) == ["gateway"]


def test_an_ipv6_address_is_written_as_zenoh_reads_it(tmp_path):
    keys = Keys.create(tmp_path / "keys", ["fd00::20"], Login.CERTIFICATE, NOW)
    keys.add("anna", Role.DISPLAY, NOW)
    config = zenoh.Config.from_file(str(keys.client_file("anna")))
    assert json.loads(config.get_json("connect/endpoints")) == [
        "tls/[fd00::20]:7447",
        "tls/localhost:7447",
    ]


def test_a_client_s_file_lets_links_heal_soon_even_where_the_folder_of_files_was_removed(keys):
    (keys.folder / "clients").rmdir()
    keys.add("anna", Role.DISPLAY, NOW)
    assert stat.S_IMODE((keys.folder / "clients").stat().st_mode) == 0o700
    for file in (keys.client_file("anna"), *(ROOT / "config" / "zenoh").glob("client_*.json5")):
        config = zenoh.Config.from_file(str(file))
        assert json.loads(config.get_json("transport/link/tx/lease")) == 1500
        assert json.loads(config.get_json("transport/unicast/open_timeout")) == 2000
        retry = json.loads(config.get_json("connect/retry"))
        assert (retry["period_init_ms"], retry["period_max_ms"]) == (250, 500)
