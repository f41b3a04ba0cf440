"""Versions, sharing, trash and undo of one trajectory, without a store."""

import pytest
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import catalogue as records
from mrlab_ros.core.trajectory.catalogue import Record, TrajectoryName, Version, checked_id, parse
from mrlab_ros.core.trajectory.diagnostics import (
    BAD_TRAJECTORY_ID,
    BAD_TRAJECTORY_NAME,
    DELETED_ALREADY,
    NAME_OF_ANOTHER_MODEL,
    NEWEST_ALREADY,
    NO_SUCH_VERSION,
    NOT_DELETED,
    SEEN_BY_ALL,
)

NAME = TrajectoryName("anna", "pick")


def version(key="k", size=10, at=0, draft="", model="ur5e"):
    head = {"id": "pick", "frame_count": 2, "robot_model": model}
    return Version(0, key, size, head, at, draft)


def made(*keys, kept=10, **more):
    record = None
    for i, key in enumerate(keys):
        record = records.published(
            record, NAME, version(key, at=i), shared=more.get("shared", False), kept=kept
        )
    return record


def numbers(record):
    return [v.number for v in record.versions]


def test_a_file_for_another_robot_gets_a_name_of_its_own():
    def of(model, name, owner="", deleted_ns=0):
        head = {"robot_model": model}
        return Record(owner, name, False, (Version(1, "k", 1, head, 0),), deleted_ns)

    found = [of("ur5e", "pick"), of("kr6", "pick_kr6"), of("kr6", "gone", deleted_ns=1)]
    found += [of("kr6", "pick", "anna"), of("kr6", "x" * 128)]
    assert records.free_name("pick", "", "ur5e", found) == "pick"
    assert records.free_name("pick", "", "kr6", found) == "pick_kr6"
    assert records.free_name("pick", "anna", "kr6", found) == "pick"
    assert records.free_name("gone", "", "ur5e", found) == "gone"
    assert records.free_name("new", "", "ur5e", found) == "new"
    long = records.free_name("x" * 128, "", "ur5e", found)
    assert checked_id(long).endswith("x_ur5e")


@pytest.mark.parametrize(("text", "owner", "name", "number"), [
    ("pick", "", "pick", 0), ("pick@3", "", "pick", 3), ("anna/pick", "anna", "pick", 0),
    ("a b@c.de/pick.v2@12", "a b@c.de", "pick.v2", 12), ("a/b/pick", "a/b", "pick", 0),
    ("Übung/x", "Übung", "x", 0),
])  # fmt: skip
def test_an_id_names_owner_name_and_version(text, owner, name, number):
    parsed = parse(text)
    assert parsed == TrajectoryName(owner, name, number)
    assert str(parsed) == text


@pytest.mark.parametrize("text", ["", "/pick", "anna/", "pick@0", "pick@", "pick@x", "漢", ".",
                                  "a@1@2", "pick@-1", "x" * 129])  # fmt: skip
def test_what_is_no_id_is_named(text):
    with refused(BAD_TRAJECTORY_ID):
        parse(text)


@pytest.mark.parametrize("name", ["", "a/b", "a@2", "-", "x" * 129])
def test_what_is_no_name_is_named(name):
    with refused(BAD_TRAJECTORY_NAME):
        checked_id(name)


@pytest.mark.parametrize(("written", "name"), [
    ("Übung 3", "Uebung_3"), ("U\u0308bung 3", "Uebung_3"), ("Größe (neu)", "Groesse_neu"),
    ("café_1.v2", "cafe_1.v2"), (" a ", "a"),
])  # fmt: skip
def test_a_name_is_spelled_by_one_rule(written, name):
    assert checked_id(written) == name
    assert parse(f"Jürgen/{written}@2") == TrajectoryName("Jürgen", name, 2)


def test_versions_are_counted_and_the_oldest_go():
    record = made("a", "b", "c", "d", kept=3)
    assert numbers(record) == [2, 3, 4]
    assert record.newest.key == record.version(0).key == "d"
    assert record.version(3).key == "c"
    with refused(NO_SUCH_VERSION, version=1, kept=[2, 3, 4]):
        record.version(1)


def test_a_motion_of_another_robot_takes_the_place_of_none_that_is_there():
    record = made("a")
    other = version("b", model="kr6")
    with refused(NAME_OF_ANOTHER_MODEL, id="anna/pick", there="ur5e", robot_model="kr6"):
        records.published(record, NAME, other, shared=False, kept=10)
    gone = records.deleted(record, 1)
    assert records.published(gone, NAME, other, shared=False, kept=10).newest.key == "b"


def test_who_sees_what():
    mine = made("a")
    assert mine.visible_to("anna")
    assert not mine.visible_to("ben")
    assert not mine.visible_to("")
    assert records.shared(mine, True).visible_to("")
    assert Record("", "pick", True, mine.versions).visible_to("")


def test_the_labs_own_is_always_shared():
    record = records.published(None, TrajectoryName("", "x"), version(), shared=False, kept=2)
    assert record.shared
    with refused(SEEN_BY_ALL):
        records.shared(record, False)


def test_what_was_deleted_comes_back():
    record = made("a", "b")
    gone = records.deleted(record, 7)
    assert gone.deleted_ns == 7
    with refused(DELETED_ALREADY):
        records.deleted(gone, 8)
    assert records.restored(gone, 0, 9, 10) == record
    with refused(NOT_DELETED):
        records.restored(record, 0, 9, 10)


def test_publishing_over_a_deleted_one_counts_on():
    gone = records.deleted(made("a"), 7)
    record = records.published(gone, NAME, version("b"), shared=False, kept=10)
    assert (numbers(record), record.deleted_ns) == ([1, 2], 0)


def test_an_older_version_becomes_the_next_one():
    record = records.restored(made("a", "b"), 1, 99, 10)
    assert [(v.number, v.key) for v in record.versions] == [(1, "a"), (2, "b"), (3, "a")]
    assert record.newest.published_ns == 99
    assert record.size == 20
    with refused(NEWEST_ALREADY):
        records.restored(record, 3, 9, 10)
    assert records.restored(records.deleted(made("a"), 1), 1, 9, 10).deleted_ns == 0


def test_a_damaged_file_takes_its_versions_along():
    record = records.restored(made("a", "b"), 1, 99, 10)
    assert numbers(records.without(record, "a")) == [2]
    assert records.without(made("a"), "a") is None


def test_a_record_comes_back_from_its_document():
    record = made("a", "b")
    assert records.from_document(records.to_document(record)) == record


@pytest.mark.parametrize("change", [
    {"format": 2}, {"versions": []}, {"versions": None}, {"name": 3}, {"versions": [{}]},
])  # fmt: skip
def test_another_document_is_refused(change):
    with pytest.raises(BadInput):
        records.from_document(records.to_document(made("a")) | change)
    with pytest.raises(BadInput):
        records.from_document({})


def test_the_newest_are_chosen_and_stay_in_order():
    found = [
        Record("", f"r{i}", True, (version(at=at),)) for i, at in enumerate([5, 1, 9, 7, 7, 2])
    ]
    assert [r.name for r in records.newest(found, 3)] == ["r2", "r3", "r4"]
    assert records.newest(found, 10) == found
