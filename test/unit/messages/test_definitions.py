"""Message definitions as bags carry them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_share_directory
from refusals import refused
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.core.base.diagnostics import TYPE_NOT_INSTALLED
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.messages.definitions import SEPARATOR, definition

SHARE = Path(get_package_share_directory("mrlab_msgs")) / "msg"
KINDS = sorted(f"mrlab_msgs/msg/{path.stem}" for path in SHARE.glob("*.msg"))


def test_every_type_within_follows_once() -> None:
    own, *inner = definition("mrlab_msgs/msg/PlaybackState").split(SEPARATOR + "\n")
    # The comments stay: they give the units.
    assert own == (SHARE / "PlaybackState.msg").read_text()
    heads = [part.splitlines()[0] for part in inner]
    assert heads == [
        "MSG: std_msgs/Header",
        "MSG: diagnostic_msgs/KeyValue",
        "MSG: mrlab_msgs/PlaybackClock",
        "MSG: builtin_interfaces/Time",
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_another_reader_finds_the_generators_type_in_it(kind: str) -> None:
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(definition(kind), kind))
    generated = json.loads((SHARE / f"{kind.rpartition('/')[2]}.json").read_text())
    expected = {one["type_name"]: one["hash_string"] for one in generated["type_hashes"]}
    assert store.hash_rihs01(kind) == expected[kind]


@pytest.mark.parametrize("kind", ["none_msgs/msg/String", "std_msgs/msg/Nothing"])
def test_a_type_that_is_not_installed_is_refused(kind: str) -> None:
    with refused(TYPE_NOT_INSTALLED, BadInput, type=kind):
        definition(kind)
