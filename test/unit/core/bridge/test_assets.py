from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import diagnostics as say
from mrlab_ros.core.bridge.assets import (
    LARGEST_PIECE,
    Described,
    Span,
    asset_key,
    key_of_uri,
    media_type,
    path_of_key,
    read_attachment,
    span,
)

PART = st.text(min_size=1, max_size=12).filter(
    lambda part: not part.startswith(".") and not set(part) & set("/\\\0") and part.isprintable()
)


@given(st.lists(PART, min_size=1, max_size=4))
def test_a_path_survives_its_key(parts):
    path = "/".join(parts)
    # zenoh forbids these in a key that names one thing.
    assert not set(asset_key(path)) & set("#?$*")
    assert path_of_key(asset_key(path)) == path


@pytest.mark.parametrize(
    "key",
    [
        "assets/../robots.json",
        "assets/mrlab_ros/../../etc/passwd",
        "assets//etc/passwd",
        "assets/%2e%2e/x",
        "assets/a%2F..%2Fb",
        "assets/.hidden/x.glb",
        "assets/a\\b",
        "assets/a%00b",
        "assets/",
        "assets/**",
        "assets/*/robots.json",
    ],
)
def test_what_is_no_path_is_refused(key):
    with pytest.raises(BadInput):
        path_of_key(key)


def test_the_key_of_a_uri_is_its_path_below_assets():
    assert key_of_uri("package://mrlab_ros/robots/a b.glb") == "assets/mrlab_ros/robots/a%20b.glb"
    with refused(say.NOT_A_PACKAGE_URI, BadInput, uri="file:///etc/passwd"):
        key_of_uri("file:///etc/passwd")


@given(st.integers(0, 3 * LARGEST_PIECE), st.integers(1, LARGEST_PIECE))
def test_pieces_make_the_whole(size, length):
    at = max(0, size - 50 * length)
    while at < size:
        part = Span(at, length).of(size, "assets/x.glb")
        assert part.start == at
        assert len(part) == min(length, size - at)
        at = part.stop
    assert at == size


def test_a_reply_holds_no_more_than_a_piece():
    assert Span().of(LARGEST_PIECE, "k") == range(LARGEST_PIECE)
    with refused(say.ASSET_IN_PIECES, BadInput, size=LARGEST_PIECE + 1):
        Span().of(LARGEST_PIECE + 1, "k")
    assert Span(5, 0).of(LARGEST_PIECE * 9, "k") == range(5, 5)
    assert Span(5, LARGEST_PIECE * 9).of(10, "k") == range(5, 10)
    with refused(say.ASSET_OFFSET_BEYOND, BadInput, offset=11, size=10):
        Span(11, 1).of(10, "k")


def test_parameters_are_numbers_of_bytes():
    assert span(None, None) == Span()
    assert span("7", "0") == Span(7, 0)
    for wrong in ("", "-1", "1.5", "1e3", "x", "9" * 40):
        with refused(say.BAD_ASSET_PARAMETER, BadInput, parameter="offset", found=wrong):
            span(wrong, None)
        with refused(say.BAD_ASSET_PARAMETER, BadInput, parameter="length", found=wrong):
            span(None, wrong)


def test_an_attachment_describes_the_whole():
    whole = Described(12, "ab" * 32, "model/gltf-binary")
    assert read_attachment(whole.attachment(5)) == (whole, 5)
    for wrong in (b"", b"{}", b"[]", b"\xff", b'{"offset": "x", "size": 1}'):
        with refused(say.BAD_ASSET_ATTACHMENT, BadInput):
            read_attachment(wrong)


def test_only_what_is_drawn_has_a_media_type():
    assert media_type("a/b.GLB") == "model/gltf-binary"
    assert not any(
        media_type(name) for name in ("robot.yaml", "robot.urdf", "x.svg", "x.html", "x")
    )
