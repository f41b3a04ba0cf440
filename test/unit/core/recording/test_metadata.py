"""What is recorded, how a bag describes itself, and the timeline of a replay."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import BAD_POSITION
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.diagnostics import (
    BAD_REPLAY_RATE,
    BAD_SPLIT_DURATION,
    BAD_SPLIT_SIZE,
    BAD_TOPIC_PATTERN,
    METADATA_TOO_NEW,
    METADATA_WITHOUT_FILES,
    NO_METADATA,
    OTHER_STORAGE,
)
from mrlab_ros.core.recording.metadata import (
    NEVER_NS,
    ROOT,
    BagFacts,
    FileInformation,
    QosProfile,
    Topic,
    paths_in,
    quality_from,
)
from mrlab_ros.core.recording.recorder import RATE_RANGE, ReplayTimeline, is_state
from mrlab_ros.core.recording.topics import (
    LAB_TOPICS,
    OF_THE_PRESENT,
    Split,
    Topics,
)

SECOND = 1_000_000_000


@pytest.mark.parametrize(
    ("name", "taken"),
    [
        ("/robots", True),
        ("/ur5e_1/joint_states", True),
        ("/a/ur5e_1/joint_states", False),
        ("/recorder/state", False),
        ("/parameter_events", False),
        ("/tf_static", True),
    ],
)
def test_the_lab_s_topics_are_recorded_and_no_others(name, taken):
    assert (name in Topics(LAB_TOPICS)) is taken


def test_the_shipped_parameters_name_the_same_topics():
    file = Path(__file__).parents[4] / "config" / "lab.yaml"
    parameters = yaml.safe_load(file.read_text())["recorder"]["ros__parameters"]
    assert parameters["topics"] == list(LAB_TOPICS)


def test_two_stars_stand_for_any_parts():
    assert "/a/b/c" in Topics(["/a/**"])
    assert "/a" not in Topics(["/a/**"])
    assert "/recorder/state" in Topics(OF_THE_PRESENT)


@pytest.mark.parametrize("pattern", ["robots", "/a b", "/a*", ""])
def test_a_pattern_that_names_no_topic_is_refused(pattern):
    with refused(BAD_TOPIC_PATTERN, BadInput, pattern=pattern):
        Topics([pattern])


@pytest.mark.parametrize(
    ("split", "age", "size", "due"),
    [
        (Split(), 1e6, 10**12, False),
        (Split(duration=10), 9.9, 0, False),
        (Split(duration=10), 10, 0, True),
        (Split(size=100), 0, 99, False),
        (Split(size=100), 0, 100, True),
    ],
)
def test_a_file_is_full_by_age_or_size(split, age, size, due):
    assert split.due(5, 5 + round(age * SECOND), size) is due


@pytest.mark.parametrize(
    ("wrong", "code"),
    [
        ({"duration": 0.5}, BAD_SPLIT_DURATION),
        ({"duration": float("nan")}, BAD_SPLIT_DURATION),
        ({"size": -1}, BAD_SPLIT_SIZE),
    ],
)
def test_a_split_that_makes_no_sense_is_refused(wrong, code):
    with refused(code, BadInput, **wrong):
        Split(**wrong)


def test_a_quality_survives_its_document():
    quality = QosProfile("keep_last", 7, "best_effort", "transient_local", 5 * SECOND + 3)
    assert quality_from(quality.document()) == quality
    assert QosProfile().document()["deadline"] == {"sec": 9223372036, "nsec": 854775807}


def test_numbers_of_older_bags_are_read():
    numbers = {"history": 3, "reliability": 1, "durability": 1, "liveliness": 99}
    quality = quality_from(numbers)
    assert (quality.history, quality.reliability, quality.durability, quality.liveliness) == (
        "unknown", "reliable", "transient_local", "unknown",
    )  # fmt: skip


def test_the_metadata_adds_up_over_the_files():
    first, second = FileInformation("x_0.mcap"), FileInformation("x_1.mcap")
    for time_ns in (5, 9):
        first.count(time_ns)
    second.count(12)
    facts = BagFacts([Topic("/a", "a/msg/A", (QosProfile(),), "RIHS01_0", 3)], [first, second])
    document = facts.document()[ROOT]
    assert document["message_count"] == 3
    assert document["duration"] == {"nanoseconds": 7}
    assert document["starting_time"] == {"nanoseconds_since_epoch": 5}
    assert paths_in(facts.document(), "m") == ["x_0.mcap", "x_1.mcap"]
    assert BagFacts(parts=[FileInformation("x")]).document()[ROOT]["starting_time"] == {
        "nanoseconds_since_epoch": NEVER_NS
    }


@pytest.mark.parametrize(
    ("change", "code", "values", "fix"),
    [
        ({"version": 10}, METADATA_TOO_NEW, {"version": "10", "known": 9}, ""),
        ({"version": "x"}, METADATA_TOO_NEW, {"version": "x"}, ""),
        (
            {"storage_identifier": "sqlite3"},
            OTHER_STORAGE,
            {"storage": "sqlite3"},
            "mrlab bag import /bags/class NEW_FOLDER",
        ),
        (
            {"compression_format": "zstd"},
            OTHER_STORAGE,
            {"compression": "zstd"},
            "mrlab bag import /bags/class NEW_FOLDER",
        ),
        (
            {"relative_file_paths": None},
            METADATA_WITHOUT_FILES,
            {},
            "mrlab bag repair /bags/class",
        ),
    ],
)
def test_metadata_that_cannot_be_used_is_refused(change, code, values, fix):
    document = BagFacts(parts=[FileInformation("x")]).document()
    document[ROOT].update(change)
    with refused(code, BadInput, **values) as caught:
        paths_in(document, "/bags/class/metadata.yaml")
    assert [each.command for each in caught.value.diagnostic.fixes] == list(filter(None, [fix]))


def test_what_is_no_metadata_is_refused():
    with refused(NO_METADATA, BadInput):
        paths_in(["x"], "m")


def latched(durability="transient_local", kind="std_msgs/msg/String"):
    return Topic("/a", kind, (QosProfile(durability=durability),))


def test_latched_topics_and_poses_say_how_things_are():
    assert is_state(latched())
    assert is_state(latched("volatile", "sensor_msgs/msg/JointState"))
    assert not is_state(latched("volatile"))


def test_a_topic_is_latched_where_all_its_publishers_latch():
    assert latched().latched
    assert not Topic("/a", "x", (QosProfile(), QosProfile(durability="transient_local"))).latched
    assert not Topic("/a", "x").latched


def test_the_timeline_stands_until_it_plays():
    timeline = ReplayTimeline(10.0, 2.0, 1.0, False)
    assert timeline.position(5 * SECOND) == 1.0
    timeline.play(5 * SECOND)
    assert timeline.position(6 * SECOND) == 3.0
    assert timeline.due_ns(7.0) == 8 * SECOND
    assert timeline.position(99 * SECOND) == 10.0


def test_pause_seek_and_rate_move_the_timeline():
    timeline = ReplayTimeline(10.0, 1.0, 0.0, False)
    timeline.play(0)
    timeline.pause(2 * SECOND)
    assert timeline.standing
    timeline.seek(3 * SECOND, 5.0)
    assert timeline.standing
    assert timeline.position(9 * SECOND) == 5.0
    timeline.set_rate(9 * SECOND, 4.0)
    assert timeline.standing
    timeline.play(10 * SECOND)
    assert timeline.position(11 * SECOND) == 9.0
    timeline.seek(11 * SECOND, 0.0)
    timeline.set_rate(12 * SECOND, 0.5)
    assert timeline.position(14 * SECOND) == 5.0


@given(st.floats(*RATE_RANGE), st.lists(st.floats(0, 10), min_size=1, max_size=20))
def test_what_is_due_is_where_the_timeline_is(rate, positions):
    timeline = ReplayTimeline(10.0, rate, 0.0, False)
    timeline.play(7)
    for position in positions:
        assert timeline.position(timeline.due_ns(position)) == pytest.approx(position, abs=1e-7)


@pytest.mark.parametrize("rate", [0.0, 0.09, 10.1, float("nan")])
def test_a_rate_out_of_range_is_refused(rate):
    with refused(BAD_REPLAY_RATE, BadInput, low=0.1, high=10.0):
        ReplayTimeline(10.0, rate, 0.0, False)


@pytest.mark.parametrize("start", [-1.0, 10.1, float("inf")])
def test_a_place_outside_is_refused(start):
    with refused(BAD_POSITION, BadInput, duration=10.0):
        ReplayTimeline(10.0, 1.0, start, False)
