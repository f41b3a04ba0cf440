"""Keys: any Unicode in a name, no two names in one segment, nothing leaves its user's prefix."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.diagnostics import EMPTY_STORE_NAME, NO_UPLOAD_KEY
from mrlab_ros.core.base.errors import BadInput

NAMES = st.text(min_size=1, max_size=300)


@given(NAMES)
def test_a_segment_is_one_safe_part_of_a_path(name):
    part = keys.segment(name)
    assert set(part.encode()) <= keys.PLAIN | {ord("=")}
    assert not part.startswith(".")
    assert "/" not in part
    assert len(part) <= 200
    if "=h" not in part:
        assert keys.name_of(part) == name
    else:
        assert keys.name_of(part).endswith("…")


@given(NAMES, NAMES)
def test_two_names_never_share_a_segment(one, other):
    assert (keys.segment(one) == keys.segment(other)) == (one == other)


@pytest.mark.parametrize(("one", "other"), [
    ("ä", "a\u0308"), ("Anna", "anna"), ("=lab", "lab"), ("a=41", "aA"), ("a b", "a_b"),
    ("ä" * 200, "ä" * 199 + "b"), ("../anna", "anna"), ("..", "."), ("a/b", "a=2Fb"),
    ("x" * 250, "x" * 251),
])  # fmt: skip
def test_names_that_look_alike_have_segments_of_their_own(one, other):
    assert keys.segment(one) != keys.segment(other)


def test_nobody_can_take_the_labs_own_place():
    assert keys.record("", "wave") == "trajectories/records/=lab/wave.json"
    assert keys.record("=lab", "wave") == "trajectories/records/=3Dlab/wave.json"


def test_an_upload_lies_below_its_user():
    number = keys.unique()
    key = keys.upload("anna", number, "Übung 1/../pick.mat")
    assert key.startswith(f"users/anna/uploads/{number}/")
    assert keys.owner_of(key, keys.UPLOAD) == "anna"
    assert keys.name_of(key.rsplit("/", 1)[1]) == "Übung 1/../pick.mat"
    assert keys.owner_of(keys.draft("anna", number), keys.DRAFT) == "anna"


@pytest.mark.parametrize("key", [
    "", "users/anna/uploads/x/pick.mat", "trajectories/records/=lab/wave.json",
    "users/../uploads/" + "0" * 32 + "/x", "users/anna/uploads/" + "0" * 32 + "/a/b",
    "users/anna/drafts/" + "0" * 32 + ".npz",
])  # fmt: skip
def test_what_is_no_upload_is_named(key):
    with refused(NO_UPLOAD_KEY, BadInput, what="upload"):
        keys.owner_of(key, keys.UPLOAD)


@pytest.mark.parametrize("number", ["../x", "", "0" * 31, "A" * 32])
def test_a_number_of_another_form_names_nothing(number):
    with pytest.raises(BadInput):
        keys.draft("anna", number)


def test_an_empty_name_is_refused():
    with refused(EMPTY_STORE_NAME, BadInput):
        keys.segment("")
