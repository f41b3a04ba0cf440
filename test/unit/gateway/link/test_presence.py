from __future__ import annotations

from typing import Any

import pytest
from refusals import refused

from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed
from mrlab_ros.gateway.lab.definitions import installed_definitions
from mrlab_ros.gateway.link import presence
from mrlab_ros.gateway.link.diagnostics import BAD_DISPLAY_ID, DISPLAY_TAKEN, DISPLAY_TOO_FAR
from mrlab_ros.gateway.link.presence import Displays, Measurers, display
from mrlab_ros.gateway.people.person import Person

pytestmark = pytest.mark.fast
DEFINITIONS = installed_definitions()
ANNA, BEN = Person("anna", Role.OPERATOR), Person("ben", Role.INSTRUCTOR)


def said(**fields: Any) -> bytes:
    return DEFINITIONS.encode(presence.TYPE, fields)


def read(payload: bytes | None) -> Any:
    assert payload is not None
    return DEFINITIONS.decode(presence.TYPE, payload)


def test_name_and_role_are_those_of_the_sign_in():
    displays = Displays(DEFINITIONS)
    forged = said(id="quest", name="the teacher", part=2, head={"position": {"x": 1.5}})
    found = read(displays.admit("a", ANNA, forged, 0.0))
    assert (found.id, found.name, found.part) == ("quest", "anna", presence.DRIVES)
    assert (found.head.position.x, found.header.frame_id) == (1.5, "world")
    # Who is in another place, or aligned with somebody else, says so by the frame.
    alone = said(id="quest", header={"frame_id": "quest"})
    assert read(displays.admit("a", ANNA, alone, 1.0)).header.frame_id == "quest"
    parts = [presence.part_of(role) for role in Role]
    assert parts == [presence.WATCHES, presence.WATCHES, presence.DRIVES, presence.TEACHES]


def test_the_display_of_another_client_is_refused_until_it_has_left():
    displays = Displays(DEFINITIONS)
    assert displays.admit("a", ANNA, said(id="quest"), 0.0)
    with refused(DISPLAY_TAKEN, NotAllowed, id="quest"):
        displays.admit("b", BEN, said(id="quest"), 1.0)
    with pytest.raises(NotAllowed):
        displays.admit("b", BEN, said(id="quest", away=True), 1.0)
    gone = read(displays.leave("a", ANNA))
    assert (gone.id, gone.name, gone.away) == ("quest", "anna", True)
    assert displays.leave("a", ANNA) is None
    assert displays.admit("b", BEN, said(id="quest"), 1.0)


def test_a_display_is_there_twenty_times_a_second_at_most_and_goes_at_once():
    displays = Displays(DEFINITIONS)
    times = [i * 0.01 for i in range(100)]
    taken = [displays.admit("a", ANNA, said(id="quest"), time) for time in times]
    assert 20 <= sum(payload is not None for payload in taken) <= 25
    assert read(displays.admit("a", ANNA, said(id="quest", away=True), 0.991)).away
    assert displays.leave("a", ANNA) is None


@pytest.mark.parametrize(
    ("fields", "code", "values"),
    [
        ({"id": ""}, BAD_DISPLAY_ID, {"id": "", "most": 64}),
        ({"id": "x" * 65}, BAD_DISPLAY_ID, {"id": "x" * 65}),
        ({"id": "a\nb"}, BAD_DISPLAY_ID, {"id": "a\nb"}),
        ({"id": "q", "head": {"position": {"x": float("nan")}}}, DISPLAY_TOO_FAR, {"at": None}),
        ({"id": "q", "left": {"position": {"z": 1e6}}}, DISPLAY_TOO_FAR, {"at": 1e6}),
    ],
)
def test_what_is_no_presence_is_refused(
    fields: dict[str, Any], code: Code, values: dict[str, Any]
):
    with refused(code, BadInput, **values):
        Displays(DEFINITIONS).admit("a", ANNA, said(**fields), 0.0)


def test_the_display_is_read_from_the_message_itself():
    for name in ("", "q", "quest_7", "Zoé"):
        for frame in ("", "world", "w" * 7):
            assert display(said(id=name, header={"frame_id": frame})) == name
    payload = said(id="quest_7")
    for length in range(16):
        assert display(payload[:length]) == ""


def test_the_surfaces_of_a_page_that_is_gone_leave_with_it():
    def measured(source: str, count: int) -> bytes:
        surfaces = [{"name": f"table_{i}"} for i in range(count)]
        return DEFINITIONS.encode(presence.SURFACES, {"source": source, "surfaces": surfaces})

    measurers = Measurers(DEFINITIONS)
    measurers.note("a", measured("quest", 2))
    measurers.note("a", measured("phone", 1))
    measurers.note("a", measured("phone", 0))
    measurers.note("b", measured("pico", 1))
    (call,) = measurers.leave("a")
    request = DEFINITIONS.decode(presence.SURFACES, call)
    assert (request.source, list(request.surfaces)) == ("quest", [])
    assert measurers.leave("a") == []
    # Who forgot the surfaces of all took those of the others, too.
    measurers.note("a", measured("", 0))
    assert measurers.leave("b") == []
