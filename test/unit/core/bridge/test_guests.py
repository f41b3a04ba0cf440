"""The share of each person in sessions and bytes."""

import pytest

from mrlab_ros.core.bridge.access import Person
from mrlab_ros.core.bridge.guests import OUT_S, QUIET_S, SPARE, Guests, Link, Share
from mrlab_ros.core.bridge.rules import Role

ANNA = Person("anna", Role.DISPLAY, "anna.01")
BEN = Person("ben", Role.OPERATOR, "ben.02")
TEACHER = Person("teacher", Role.INSTRUCTOR, "teacher.03")
SHARE = Share(sessions=3, rate=1000.0, burst=5000.0)


@pytest.fixture
def guests():
    return Guests([ANNA, BEN, TEACHER], SHARE, by_certificate=True)


def link(number, name):
    return Link("tls/10.0.0.1:7447", f"tls/10.0.0.9:{number}", name)


def test_one_person_cannot_take_the_sessions_of_others(guests):
    assert [guests.opened(link(i, "anna.01"), 0.0) for i in range(3)] == [None] * 3
    cut = guests.opened(link(3, "anna.01"), 0.0)
    assert cut.links == (link(3, "anna.01"),)
    assert "anna has 3 sessions" in cut.words
    assert guests.opened(link(9, "teacher.03"), 0.0) is None
    assert guests.room == 3 * 3 + SPARE


def test_a_session_that_ends_makes_room(guests):
    for i in range(3):
        guests.opened(link(i, "anna.01"), 0.0)
    guests.closed(link(1, "anna.01"))
    assert guests.opened(link(3, "anna.01"), 0.0) is None


def test_a_link_that_was_refused_makes_no_room_when_it_ends(guests):
    for i in range(4):
        guests.opened(link(i, "anna.01"), 0.0)
    guests.closed(link(3, "anna.01"))
    assert guests.opened(link(4, "anna.01"), 0.0) is not None


def test_the_same_refusal_is_logged_once_a_minute(guests):
    words = [guests.opened(link(i, "anna.01"), 0.0) for i in range(100)]
    assert sum(bool(cut and cut.words) for cut in words) == 1
    assert guests.opened(link(101, "anna.01"), QUIET_S).words


def test_refusals_of_two_kinds_are_both_logged(guests):
    for i in range(4):
        guests.opened(link(i, "anna.01"), 0.0)
    (cut,) = guests.received({link(0, "anna.01"): 9000}, 1.0)
    assert "disconnected for" in cut.words


def test_a_certificate_of_nobody_is_disconnected(guests):
    assert "no longer" in guests.opened(link(1, "revoked.04"), 0.0).words
    assert guests.opened(link(2, ""), 0.0).links == (link(2, ""),)


def test_all_sessions_of_a_person_share_their_bytes(guests):
    one, two = link(1, "anna.01"), link(2, "anna.01")
    guests.opened(one, 0.0)
    guests.opened(two, 0.0)
    assert guests.received({one: 2000, two: 2900}, 0.0) == []
    (cut,) = guests.received({one: 2100, two: 3000}, 0.0)
    assert set(cut.links) == {one, two}
    assert "anna" in cut.words
    assert "1 kB a second" in cut.words


def test_who_sent_too_much_stays_out_for_a_while(guests):
    guests.opened(link(1, "anna.01"), 0.0)
    guests.received({link(1, "anna.01"): 9000}, 0.0)
    assert guests.opened(link(2, "anna.01"), OUT_S - 1).links == (link(2, "anna.01"),)
    assert guests.opened(link(3, "anna.01"), OUT_S) is None
    assert guests.opened(link(4, "ben.02"), 1.0) is None


def test_a_steady_stream_below_the_rate_may_go_on(guests):
    guests.opened(link(1, "ben.02"), 0.0)
    for second in range(100):
        assert guests.received({link(1, "ben.02"): 900 * second}, float(second)) == []


def test_an_instructor_may_send_files(guests):
    guests.opened(link(1, "teacher.03"), 0.0)
    assert guests.links == []
    assert guests.received({link(1, "teacher.03"): 10**9}, 0.0) == []


def test_without_certificates_addresses_share_sessions():
    guests = Guests([ANNA], SHARE, by_certificate=False)
    assert [guests.opened(link(i, ""), 0.0) for i in range(3)] == [None] * 3
    assert "10.0.0.9 has 3 sessions" in guests.opened(link(3, ""), 0.0).words
    assert guests.opened(Link("tls/a:1", "tls/10.0.0.8:5", ""), 0.0) is None
    for i in range(3):
        guests.closed(link(i, ""))
    assert guests.opened(link(4, ""), 0.0) is None
