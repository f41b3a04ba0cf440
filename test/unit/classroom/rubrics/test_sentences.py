"""Sentences of a rubric: forms, gaps, quantities, and what is said of others."""

from __future__ import annotations

import contextlib
import math
import pickle
import re
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.classroom.rubrics import measures
from mrlab_ros.classroom.rubrics.diagnostics import (
    BEYOND_MOST,
    NEGATIVE,
    NO_UNIT,
    NOT_A_NUMBER,
    NOT_A_PLACE,
    OTHER_UNIT,
    TIMES_SWAPPED,
    UNKNOWN_SENTENCE,
)
from mrlab_ros.classroom.rubrics.measures import FORMS
from mrlab_ros.classroom.rubrics.rubric import ANGLE, LENGTH, SHARE, TIME
from mrlab_ros.classroom.rubrics.sentences import GAPS, Given, form_of
from mrlab_ros.core.base.errors import BadInput

GAP = re.compile("|".join(sorted(GAPS, key=len, reverse=True)))
WORDS = {"OBJECT": "cube_1", "THING": "bin_1", "ROBOT": "ur5e_1", "OTHER": "kr6_1",
         "PLACE": "[0.1, 0.2]", "FROM": "2 s", "TO": "4 s"}  # fmt: skip


def read(sentence):
    form, gaps = form_of(sentence, FORMS)
    return form.text, {k: v for k, v in gaps.items() if v is not None}


def sentence_of(form, whole):
    """Return a form's sentence, `whole` with all that it may leave out."""
    text = form.text
    while "[" in text:
        text = re.sub(r"\s?\[([^\[\]]*)\]", r" \1" if whole else "", text)
    text = text.replace(" ,", ",")
    return GAP.sub(lambda m: WORDS.get(m[0]) or GAPS[m[0]][1].example, text)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.text)
@pytest.mark.parametrize("whole", [True, False])
def test_each_form_reads_what_it_says_and_no_other_form_is_taken_for_it(form, whole):
    assert form_of(sentence_of(form, whole), FORMS)[0] is form
    assert form.about.endswith(".")


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.text)
def test_each_measure_reaches_another_process_as_it_is(form):
    gaps = form_of(sentence_of(form, whole=True), FORMS)[1]
    measure = form.build(gaps, Given(poses=((0.1, 0.2),)))
    assert pickle.loads(pickle.dumps(measure)) == measure


@pytest.mark.parametrize(
    ("sentence", "gaps"),
    [
        ("no collision", {}),
        ("No  collision with the floor", {"thing": "floor"}),
        ("passes within 5 mm of poses, in order", {"length": 0.005}),
        ("passes within 5mm and 10° of poses in any order", {"length": 0.005, "angle": 0.17453}),
        ("grasps cube_1 between 2 and 4 s", {"object": "cube_1", "from": 2.0, "to": 4.0}),
        ("grasps cube_1 between 500 and 900 ms", {"object": "cube_1", "from": 0.5, "to": 0.9}),
        ("releases cube_1 within 1 cm of [0.2, -0.4]", {"object": "cube_1", "length": 0.01,
                                                        "place": (0.2, -0.4)}),
        ("cycle < 8 s", {"time": 8.0}),
        ("cycle<=8s", {"time": 8.0}),
        ("cycle of kr6_1 less than 8 s", {"robot": "kr6_1", "time": 8.0}),
        ("within 80% of limits", {"share": 0.8}),
        ("distance to bin_1 at least 10 cm", {"thing": "bin_1", "length": 0.1}),
        ("smoothness > -3", {"number": -3.0}),
        ("joints within 5 deg RMS of the reference", {"angle": 0.087266}),
    ],
)  # fmt: skip
def test_a_sentence_as_teachers_write_it(sentence, gaps):
    found = read(sentence)[1]
    assert found.keys() == gaps.keys()
    for name, value in gaps.items():
        assert found[name] == (value if isinstance(value, str) else pytest.approx(value, rel=1e-4))


@pytest.mark.parametrize(
    ("sentence", "code", "values"),
    [
        ("no colision", UNKNOWN_SENTENCE, {"text": "no colision"}),
        ("grabs cube_1 before 4 s", UNKNOWN_SENTENCE, {}),
        ("torque below 5 Nm", UNKNOWN_SENTENCE, {}),
        ("cycle < 8", NO_UNIT, {"text": "8", "expected": TIME.expected}),
        ("cycle < 8 mm", OTHER_UNIT, {"text": "8 mm", "given": "mm"}),
        ("cycle < -8 s", NEGATIVE, {"text": "-8 s"}),
        ("cycle < 1,5 s", NOT_A_NUMBER, {"better": "1.5"}),
        ("within 80 of limits", NO_UNIT, {"expected": SHARE.expected}),
        ("passes within 900 km of [0, 0, 1]", OTHER_UNIT, {"given": "km"}),
        ("passes within 900 m of [0, 0, 1]", BEYOND_MOST, {"limit": 100.0, "unit": "m"}),
        ("passes within 5 mm of [0, 0, 0, 1]", NOT_A_PLACE, {}),
        ("grasps cube_1 between 4 and 2 s", TIMES_SWAPPED, {"first": 4.0, "last": 2.0}),
    ],
)
def test_what_cannot_be_read_is_said(sentence, code, values):
    with refused(code, **values):
        read(sentence)


@pytest.mark.parametrize(
    ("sentence", "form"),
    [
        ("no colision", "no collision [of ROBOT] [with [the] THING]"),
        ("grabs cube_1 before 4 s", "grasps OBJECT [by ROBOT] before TO"),
    ],
)
def test_the_nearest_form_is_named_first(sentence, form):
    with refused(UNKNOWN_SENTENCE) as error:
        read(sentence)
    assert error.value.diagnostic.values["close"][0] == form


@given(
    st.sampled_from([LENGTH, ANGLE, TIME, SHARE]),
    st.floats(0, 5),
    st.integers(0, 4),
    st.booleans(),
)
def test_a_quantity_reads_what_it_was_written_as(quantity, number, which, spaced):
    unit = list(quantity.units)[which % len(quantity.units)]
    value = quantity.read(f"{number:.6f}{' ' if spaced else ''}{unit}")
    assert math.isclose(value, round(number, 6) * quantity.units[unit], abs_tol=1e-12)


@given(st.text(max_size=60))
def test_any_text_is_read_or_refused(text):
    with contextlib.suppress(BadInput):
        read(text)


ADDED = """
from dataclasses import dataclass

from mrlab_ros.classroom.rubrics.sentences import Form


@dataclass(frozen=True)
class Waves:
    robot: str


FAMILY = "manners"
FORMS = (Form("waves [by ROBOT]", lambda gaps, given: Waves(gaps.get("robot") or ""), "Hello."),)
"""


def test_a_file_in_the_folder_is_a_measure(tmp_path, monkeypatch):
    (tmp_path / "manners.py").write_text(ADDED)
    monkeypatch.setattr(measures, "__path__", [*measures.__path__, str(tmp_path)])
    monkeypatch.delitem(sys.modules, f"{measures.__name__}.manners", raising=False)
    (form,) = measures.families()["manners"]
    found, gaps = form_of("waves by ur5e_1", (*FORMS, form))
    assert (found, gaps["robot"]) == (form, "ur5e_1")
