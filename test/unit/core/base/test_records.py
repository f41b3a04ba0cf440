"""Checked fields: what is accepted, and what is said of the rest."""

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base import diagnostics as codes
from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import (
    FILLED_TEXT,
    FLAG,
    NAME,
    TEXT,
    TEXTS,
    Choice,
    Integer,
    Matrix,
    Number,
    Numbers,
    Range,
    Texts,
    above,
    at_least,
    between,
    checked,
    enum_values,
    shown,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.base.records import Record

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
    Texts(single=True),
    Numbers(),
    Numbers(3, between(-5, 5)),
    Matrix(3),
    Matrix(3, whole=True),
    enum_values(Colour),
]


@pytest.mark.parametrize(
    ("limits", "said"),
    [
        (Range(), None),
        (between(60, 2000), codes.LIMITS_BETWEEN(low=60, high=2000)),
        (above(0), codes.LIMITS_ABOVE(low=0, high=None, below=None)),
        (above(0, 1), codes.LIMITS_ABOVE(low=0, high=1, below=None)),
        (at_least(0), codes.LIMITS_FROM(low=0, below=None)),
        (Range(high=3), codes.LIMITS_TO(high=3)),
        (Range(high=3, high_open=True), codes.LIMITS_BELOW(below=3)),
        (Range(0, 3600, high_open=True), codes.LIMITS_FROM(low=0, below=3600)),
        (
            Range(-1, 1, low_open=True, high_open=True),
            codes.LIMITS_ABOVE(low=-1, high=None, below=1),
        ),
    ],
)
def test_a_range_says_its_ends(limits, said):
    assert limits.words == said
    assert said is None or str(said)


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
        result = checked("x", value, check)
    except BadInput as error:
        text = str(error)
    if text:
        assert text.startswith("x is ")
        assert str(check.expected) in text
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
        (Texts(single=True), "a", ("a",)),
        (Numbers(2), [1, 2.5], (1.0, 2.5)),
        (enum_values(Colour), "g", Colour.GREEN),
        (Choice({0: "zero", 1: "one"}), 1, "one"),
    ],
)
def test_a_value_has_the_type_of_its_check(check, value, result):
    read = check.read(value)
    assert read == result
    assert type(read) is type(result)


@pytest.mark.parametrize(
    ("check", "value", "expected", "hint"),
    [
        (Number(above(0), "Hz"), 0, codes.A_NUMBER, None),
        (Number(), True, codes.A_NUMBER, None),
        (Number(), math.nan, codes.A_NUMBER, codes.FINITE_NUMBERS),
        (Number(), math.inf, codes.A_NUMBER, codes.FINITE_NUMBERS),
        (Number(), 10**400, codes.A_NUMBER, None),
        (Number(), "1e3", codes.A_NUMBER, codes.WITHOUT_QUOTES),
        (Number(), "nan", codes.A_NUMBER, None),
        # What a hint would lead to is refused, too.
        (Number(between(0, 100)), "5000", codes.A_NUMBER, None),
        (Number(above(0, 4), mirrored=True), "-5", codes.A_NUMBER, None),
        (Integer(between(1, 7)), "8", codes.AN_INTEGER, None),
        (NAME, 7, codes.A_NAME, None),
        (Integer(), "1024", codes.AN_INTEGER, codes.WITHOUT_QUOTES),
        (Integer(between(1, 7)), 2.5, codes.AN_INTEGER, None),
        (FLAG, "yes", codes.TRUE_OR_FALSE, None),
        (TEXT, 7447, codes.A_TEXT, codes.IN_QUOTES),
        (FILLED_TEXT, "", codes.A_FILLED_TEXT, None),
        (NAME, "Cube", codes.A_NAME, None),
        (TEXTS, "a", codes.SOME_TEXTS, codes.IN_BRACKETS),
        (Texts(single=True), 5, codes.TEXT_OR_TEXTS, None),
        (Numbers(3, unit="m"), [1, 2], codes.COUNTED_NUMBERS, None),
        (Numbers(), [], codes.SOME_NUMBERS, None),
        (Numbers(2), "12", codes.COUNTED_NUMBERS, None),
        (Matrix(3), [[1, 2]], codes.ROWS_OF_NUMBERS, None),
        (Matrix(3), [[1, 2, math.nan]], codes.ROWS_OF_NUMBERS, None),
        (Matrix(3, whole=True), [[0, 1, 2.5]], codes.ROWS_OF_NUMBERS, None),
        (Matrix(3, whole=True), [[0, 1, 2**40]], codes.ROWS_OF_NUMBERS, None),
        (Choice({0: 0, 1: 1, 2: 2}), True, codes.ONE_OF, None),
    ],
)
def test_a_mistake_says_what_was_expected(check, value, expected, hint):
    with refused(codes.BAD_VALUE, BadInput, what="x", found=shown(value)) as caught:
        checked("x", value, check)
    values = caught.value.diagnostic.values
    assert values["expected"].code == expected.code
    assert (values["hint"].code if "hint" in values else None) == (hint and hint.code)


def test_what_is_expected_has_values():
    assert Number(above(0), "Hz").expected.values["unit"] == "Hz"
    assert Number(between(0.1, 4), mirrored=True).expected.values["sign"] == "either"
    assert Numbers(3).expected.values["count"] == 3
    assert Matrix(3, whole=True).expected.values == {"columns": 3, "numbers": "whole"}
    assert enum_values(Colour).expected.values == {"choices": ["r", "g"]}
    with refused(codes.WITHOUT_QUOTES, number=1024):
        checked("x", "1024", Integer())


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
    ("value", "code", "values"),
    [
        ([1], codes.BAD_VALUE, {"what": "object 'can'", "found": "[1]"}),
        (None, codes.EMPTY_VALUE, {"what": "object 'can'"}),
        ([1], codes.A_MAPPING, {"fields": ["size", "at", "weight", "parts", "pose"]}),
        ({"wight": 1}, codes.UNKNOWN_FIELD, {"key": "wight", "close": "weight"}),
        ({True: 1, "tea": 2}, codes.MISTAKES, {"count": 2}),
        ({True: 1, "tea": 2}, codes.UNKNOWN_FIELD, {"place": "object 'can'", "key": "True"}),
        ({}, codes.MISSING_FIELD, {}),
        ({}, codes.FIELD, {"place": "object 'can'", "key": "size"}),
        ({"size": 4}, codes.COUNTED_NUMBERS, {"count": 2}),
        ({"size": [1, 2], "parts": 5}, codes.A_LIST, {}),
        ({"size": [1, 2], "parts": [5]}, codes.ENTRY, {"one": "part", "number": 1}),
        (
            {"size": [1, 2], "parts": [{"size": 1}, {"size": "x"}]},
            codes.ENTRY,
            {"place": "object 'can'", "one": "part", "number": 2},
        ),
        ({"size": [1, 2], "pose": {"y": 1}}, codes.FIELD_BELOW, {"key": "pose"}),
    ],
)
def test_a_mistake_in_a_record_names_its_place(value, code, values):
    with refused(code, BadInput, **values):
        read_object(value)


def test_every_names_the_mistakes_of_all():
    def half(value):
        if value % 2:
            raise BadInput(codes.IN_PLACE(place=str(value), why="odd"))
        return value // 2

    assert records.every(half, (2, 4), "the list") == [1, 2]
    with pytest.raises(BadInput) as caught:
        records.every(half, (2, 3), "the list")
    assert caught.value.diagnostic == codes.IN_PLACE(place="3", why="odd")
    with refused(codes.MISTAKES, what="the list", count=2) as caught:
        records.every(half, (3, 4, 5), "the list")
    found = caught.value.diagnostic.values["all"]
    assert [each.values["place"] for each in found] == ["3", "5"]


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
    found = caught.value.diagnostic
    assert (found.code, found.values["count"]) == (codes.MISTAKES.code, 4)
    assert [each.code for each in found.values["all"]] == [
        codes.UNKNOWN_FIELD.code,
        codes.MISSING_FIELD.code,
        codes.BAD_VALUE.code,
        codes.BAD_VALUE.code,
    ]
    assert str(caught.value).count("\n  the file: ") == 4
    with refused(codes.A_MAPPING, fields=["step_rate", "count", "staging.share"]):
        records.read(Figures, [], "the file")
    with refused(codes.BAD_VALUE, found="-1"):
        records.check_fields(Figures(240.0, -1), "the figures")


def test_a_close_name_is_offered():
    assert close_to("Ur5", ("ur5e", "kuka_kr3_r540")) == "ur5e"
    assert close_to("table", ("ur5e",)) is None
    assert close_to("KR6", ("ur5e", "kuka_kr6_r900")) == "kuka_kr6_r900"
    assert close_to("Pick-and-place", ("pick_and_place",)) == "pick_and_place"
    assert close_to("", ("ur5e",)) is None


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
        ("lightsaber", None),
        ("nothere", None),
    ],
)
def test_only_a_similar_name_is_suggested(name: str, meant: str | None) -> None:
    known = ("ur5e", "kuka_kr6_r900_sixx", "parallel_gripper", "quintic", "table", "three")
    assert close_to(name, known) == meant
