"""The record of what a person is told: declared once, with values, as JSON and back."""

from __future__ import annotations

import json
import math

import pytest

from mrlab_ros.core.base.diagnostic import (
    WARNING,
    Code,
    Diagnostic,
    Fix,
    Severity,
    from_plain,
    plain,
    to_texts,
)
from mrlab_ros.core.base.errors import BadInput

FAR = Code(
    "far",
    "{joint} is at {value:measure} in {rows:rows}.",
    "Plan inside {limit:measure}[, {hint}].",
    fixes=(("columns", "{column}", "{name:matlab}(:, {column})"),),
    data=("column",),
)


def test_a_code_becomes_a_text_with_its_values():
    found = FAR(joint="elbow", value=math.pi, limit=1.0, unit="rad", rows=(3, 4), column=2)
    assert found.message == "elbow is at 180.0° in rows 3 to 4."
    assert found.remedy == "Plan inside 57.3°."
    assert (found.joint, found.value, found.limit, found.unit) == ("elbow", math.pi, 1.0, "rad")
    assert found.severity is Severity.ERROR
    assert found.refuses


@pytest.mark.parametrize("values", [{}, {"joint": "a", "value": 1, "rows": (1, 1), "more": 2}])
def test_missing_and_unknown_values_are_refused(values):
    with pytest.raises(TypeError, match="far: the values"):
        FAR(**values)


@pytest.mark.parametrize(("name", "line"), [("a.b(2)", "a.b(2)(:, 1)"), ("q; !rm", "q(:, 1)")])
def test_a_fix_names_a_variable_only_where_matlab_takes_it(name, line):
    code = Code("x", "{variable}", fixes=FAR.fixes, data=("column",))
    assert code(variable=name, column=1).fixes == (Fix("columns", "1", line),)


def test_severity_and_fixes_can_be_given():
    found = Code("x", "y")(severity=WARNING, fixes=(Fix("a", "b"),))
    assert found.severity is Severity.WARNING
    assert found.fixes == (Fix("a", "b"),)


def test_a_diagnostic_survives_json_and_an_error_is_one_too():
    inner = Code("inner", "no {file}")(file="a.mat")
    found = Code("outer", "it failed: {why:problem}")(why=BadInput(inner), time=2.0)
    kept = json.loads(json.dumps(plain(found)))
    assert kept["values"]["why"]["code"] == "inner"
    assert kept["time"] == 2.0
    assert from_plain(kept).message == "it failed: no a.mat"
    assert from_plain(kept).values["why"]["values"] == {"file": "a.mat"}


def test_values_are_texts_on_the_wire():
    assert to_texts({"a": "x", "b": 1.5, "c": (1, 2), "d": math.nan}) == {
        "a": "x",
        "b": "1.5",
        "c": "[1, 2]",
        "d": "null",
    }


def test_an_error_of_a_library_has_no_code():
    assert BadInput("no good").diagnostic == Diagnostic("", Severity.ERROR, "no good")


def test_the_remedy_of_an_inner_diagnostic_follows_the_sentence():
    wrong = Code("wrong", "It is wrong.", "Mend it.")
    outer = Code("outer", "Left out: {why:problem}, so it is smaller.", "Look at it.")
    assert (
        str(outer(why=wrong())) == "Left out: It is wrong, so it is smaller. Mend it. Look at it."
    )
    several = Code("several", "Not so: {all:reasons}.")
    both = several(all=[BadInput(wrong()), wrong(), "no rights"])
    assert str(both) == "Not so: It is wrong; It is wrong; no rights. Mend it."
