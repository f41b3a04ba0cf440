"""A device cookie is good for one name in one lab, and cannot be made by a browser."""

from __future__ import annotations

import pytest

from mrlab_ros.gateway.people.known_browsers import KnownBrowsers


def test_a_cookie_is_for_one_name_whatever_its_case() -> None:
    known = KnownBrowsers(b"secret")
    cookie = known.new("Anna")
    assert known.number("anna", cookie) == cookie.partition(".")[0] != ""
    assert known.number("ben", cookie) == ""
    assert known.number("anna", known.new("anna")) != known.number("anna", cookie)


@pytest.mark.parametrize("cookie", ["", ".", "1.", "1.2", "\ud800.\ud800", "ä.ö", "x" * 5000])
def test_a_made_up_cookie_is_unknown(cookie: str) -> None:
    assert KnownBrowsers(b"secret").number("anna", cookie) == ""


def test_a_cookie_of_another_lab_is_unknown() -> None:
    assert KnownBrowsers(b"one").number("anna", KnownBrowsers(b"other").new("anna")) == ""
