"""Checked fields: what is accepted, and the sentence for what is not."""

import math
import re
from dataclasses import dataclass
from enum import Enum

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core import records
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.naming import did_you_mean
from mrlab_ros.core.records import (
    FILLED_TEXT,
    FLAG,
    NAME,
    TEXT,
    TEXTS,
    Integer,
    Matrix,
    Number,
    Numbers,
    Range,
    Record,
    above,
    at_least,
    between,
)

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=10,
)


class Colour(Enum):
    RED = "r"
    GREEN = "g"


CHECKS = [
    Number(),
    Number(between(0, 1), "m"),
    Integer(above(0)),
    FLAG,
    TEXT,
    NAME,
    FILLED_TEXT,
    TEXTS,
    records.Texts(single=True),
    Numbers(),
    Numbers(3, between(-5, 5)),
    Matrix(3),
    Matrix(3, whole=True),
    records.enum_values(Colour),
]


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        (Range(), ""),
        (between(60, 2000), "from 60 to 2000"),
        (above(0), "above 0"),
        (above(0, 1), "above 0 and at most 1"),
        (at_least(0), "of at least 0"),
        (Range(high=3), "of at most 3"),
        (Range(0, 3600, high_open=True), "of at least 0 and below 3600"),
        (Range(-1, 1, low_open=True, high_open=True), "above -1 and below 1"),
        (at_least(1_000_000), "of at least 1000000"),
    ],
)
def test_a_range_says_its_ends(limits, words):
    assert str(limits) == words


@given(st.floats(), st.floats(), st.floats(), st.booleans(), st.booleans())
def test_a_range_holds_what_lies_between_its_ends(low, high, value, low_open, high_open):
    inside = value in Range(low, high, low_open, high_open)
    assert inside == (
        low <= value <= high
        and not (low_open and value == low)
        and not (high_open and value == high)
    )
    assert math.nan not in Range(low, high)


@given(st.sampled_from(CHECKS), JSON)
def test_any_value_is_read_or_refused_in_words(check, value):
    text = ""
    try:
        result = records.checked("x", value, check)
    except BadInput as error:
        text = str(error)
    if text:
        assert text.startswith("x is ")
        assert check.expected in text
        assert len(text) < 700
    elif isinstance(result, float | int) or isinstance(check, Numbers):
        # As float64: numpy cannot ask integers beyond 64 bits.
        assert np.isfinite(np.asarray(result, dtype=float)).all()


@pytest.mark.parametrize(
    ("check", "value", "result"),
    [
        (Number(), 1, 1.0),
        (Integer(), 5.0, 5),
        (Integer(), 2**60 + 1, 2**60 + 1),
        (NAME, "cube_1", "cube_1"),
        (records.Texts(single=True), "a", ("a",)),
        (Numbers(2), [1, 2.5], (1.0, 2.5)),
        (records.enum_values(Colour), "g", Colour.GREEN),
        (records.Choice({0: "zero", 1: "one"}), 1, "one"),
    ],
)
def test_a_value_has_the_type_of_its_check(check, value, result):
    read = check.read(value)
    assert read == result
    assert type(read) is type(result)


@pytest.mark.parametrize(
    ("check", "value", "sentence"),
    [
        (Number(above(0), "Hz"), 0, "x is 0; expected a number above 0 (Hz)"),
        (Number(), True, "x is true; expected a number"),
        (Number(), math.nan, "x is nan; expected a number"),
        (Number(), math.inf, "x is inf; expected a number"),
        (Number(), 10**400, "expected a number"),
        (Number(), "1e3", "x is '1e3'; expected a number; write 1000.0, without quotes"),
        (
            Integer(),
            "1024",
            "x is '1024'; expected a whole number; write 1024, without quotes",
        ),
        (Number(), "nan", "x is 'nan'; expected a number"),
        (Integer(between(1, 7)), 2.5, "x is 2.5; expected a whole number from 1 to 7"),
        (FLAG, "yes", "x is 'yes'; expected true or false"),
        (TEXT, 7447, 'x is 7447; expected a text; write "7447", in quotes'),
        (FILLED_TEXT, "", "x is ''; expected a text that is not empty"),
        (NAME, "Cube", "expected a name of lower-case letters"),
        (Numbers(3, unit="m"), [1, 2], "x is [1, 2]; expected 3 numbers (m)"),
        (Numbers(), [], "x is []; expected a list of numbers"),
        (Numbers(2), "12", "x is '12'; expected 2 numbers"),
        (Matrix(3), [[1, 2]], "expected a list of rows of 3 numbers each"),
        (Matrix(3), [[1, 2, math.nan]], "expected a list of rows"),
        (Matrix(3, whole=True), [[0, 1, 2.5]], "rows of 3 whole numbers each"),
        (Matrix(3, whole=True), [[0, 1, 2**40]], "rows of 3 whole numbers each"),
        (records.Choice({0: 0, 1: 1, 2: 2}), True, "x is true; expected 0, 1 or 2"),
    ],
)
def test_a_mistake_is_a_sentence(check, value, sentence):
    with pytest.raises(BadInput, match=re.escape(sentence)):
        records.checked("x", value, check)


def test_a_matrix_has_the_right_kind_even_where_it_is_empty():
    assert Matrix(3).read([]).shape == (0, 3)
    assert Matrix(3).read([[1, 2, 3]]).dtype == np.float64
    assert Matrix(3, whole=True).read([[1, 2, 3]]).dtype == np.int32


FIELDS = ("size", "at", "mass", "parts", "pose")


def read_object(value):
    entry = Record(value, "object 'can'", ("size", "at", "weight", "parts", "pose"))
    entry.required("size", Numbers(2))
    for part in entry.records("parts", ("size",), "part"):
        part.required("size", Number())
    entry.record("pose", ("x",))


def test_a_record_reads_its_fields():
    entry = Record({"size": [1, 2], "mass": 3, "at": None}, "object 'can'", FIELDS)
    assert entry.required("size", Numbers(2)) == (1.0, 2.0)
    assert entry.value("at", Numbers(3), (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)
    assert entry.optional("at", Numbers(3)) is None
    assert "mass" in entry
    assert "at" not in entry
    assert entry.record("pose", ("x",)) is None
    assert entry.records("parts", ("size",), "part") == []


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ([1], "object 'can' is [1]; expected a mapping with the fields size, at,"),
        (
            {"wight": 1},
            "object 'can': 'wight' is unknown; expected size, at, weight",
        ),
        ({"wight": 1}, "did you mean 'weight'?"),
        ({True: 1, "tea": 2}, "object 'can' has 2 mistakes:\n  object 'can': 'True' is unknown"),
        ({}, "object 'can': size is missing; expected 2 numbers"),
        ({"size": 4}, "object 'can': size is 4; expected 2 numbers"),
        ({"size": [1, 2], "parts": 5}, "object 'can': parts is 5; expected a list"),
        ({"size": [1, 2], "parts": [5]}, "object 'can', part 1 is 5; expected a mapping"),
        (
            {"size": [1, 2], "parts": [{"size": 1}, {"size": "x"}]},
            "object 'can', part 2: size is 'x'; expected a number",
        ),
        ({"size": [1, 2], "pose": {"y": 1}}, "object 'can', pose: 'y' is unknown; expected x"),
    ],
)
def test_a_mistake_in_a_record_names_its_place(value, sentence):
    with pytest.raises(BadInput, match=re.escape(sentence)):
        read_object(value)


def test_every_names_the_mistakes_of_all():
    def half(value):
        if value % 2:
            raise BadInput(f"{value} is odd")
        return value // 2

    assert records.every(half, (2, 4), "the list") == [1, 2]
    with pytest.raises(BadInput, match=r"^3 is odd$"):
        records.every(half, (2, 3), "the list")
    with pytest.raises(BadInput, match=r"^the list has 2 mistakes:\n  3 is odd\n  5 is odd$"):
        records.every(half, (3, 4, 5), "the list")


@dataclass(frozen=True)
class Figures:
    step_rate: float = records.field(Number(between(60, 2000), "Hz"), "Rate.")
    count: int = records.field(Integer(above(0)), "Most.", 3)
    share: float = records.field(Number(), "Share.", 0.5, name="staging.share")


def test_a_dataclass_is_read_from_a_mapping():
    made = records.read(Figures, {"step_rate": 240, "staging.share": 1}, "the file")
    assert made == Figures(240.0, 3, 1.0)
    assert type(made.step_rate) is float
    records.check_fields(made, "the file")


def test_all_mistakes_of_a_dataclass_are_named_at_once():
    with pytest.raises(BadInput) as caught:
        records.read(Figures, {"count": 0, "staging.share": "x", "stepp_rate": 1}, "the file")
    assert str(caught.value).splitlines() == [
        "the file has 4 mistakes:",
        "  the file: 'stepp_rate' is unknown; expected step_rate, count, staging.share; did you "
        "mean 'step_rate'?",
        "  the file: step_rate is missing; expected a number from 60 to 2000 (Hz)",
        "  the file: count is 0; expected a whole number above 0",
        "  the file: staging.share is 'x'; expected a number",
    ]
    with pytest.raises(BadInput, match="expected a mapping with the fields step_rate"):
        records.read(Figures, [], "the file")
    with pytest.raises(BadInput, match="count is -1"):
        records.check_fields(Figures(240.0, -1), "the figures")


def test_a_close_name_is_offered():
    assert did_you_mean("Ur5", ("ur5e", "kuka_kr3_r540")) == "; did you mean 'ur5e'?"
    assert did_you_mean("table", ("ur5e",)) == ""
    assert did_you_mean("KR6", ("ur5e", "kuka_kr6_r900")) == "; did you mean 'kuka_kr6_r900'?"
    assert did_you_mean("Pick-and-place", ("pick_and_place",)) == (
        "; did you mean 'pick_and_place'?"
    )
    assert did_you_mean("", ("ur5e",)) == ""


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("ur5", "ur5e"),
        ("ur5f", "ur5e"),
        ("ur6", "ur5e"),
        ("kr6", "kuka_kr6_r900_sixx"),
        ("paralel_gripper", "parallel_gripper"),
        ("quintik", "quintic"),
        ("tabel", "table"),
        ("lightsaber", ""),
        ("nothere", ""),
    ],
)
def test_only_a_similar_name_is_suggested(name: str, meant: str) -> None:
    known = ("ur5e", "kuka_kr6_r900_sixx", "parallel_gripper", "quintic", "table", "three")
    assert did_you_mean(name, known) == (f"; did you mean '{meant}'?" if meant else "")
