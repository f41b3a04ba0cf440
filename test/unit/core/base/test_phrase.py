"""Templates with typed values; web/test/words/phrase.test.ts fills the same in German."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mrlab_ros.core.base.phrase import ended, phrase

CASES = json.loads(Path(__file__).with_name("phrases.json").read_text())


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["template"])
def test_a_template_is_filled_in(case):
    assert phrase(case["template"]).fill(case["values"]) == case["en"]


def test_values_that_may_be_missing_are_told_apart():
    parsed = phrase("{a} [{b:angle} [{c}] ]")
    assert [part.name for part in parsed.placeholders(optional=False)] == ["a"]
    assert [part.name for part in parsed.placeholders()] == ["a", "b", "c"]


@pytest.mark.parametrize("template", ["{a:colour}", "a]", "[a"])
def test_what_is_no_template_is_refused(template):
    with pytest.raises(ValueError, match="there is no quantity|without"):
        phrase(template)


def test_nothing_in_a_value_acts_on_a_terminal():
    assert phrase("{a}").fill({"a": "x\x1b[31m"}) == "x\\u001b[31m"


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_that_is_none_is_shown(value):
    assert phrase("{a:length}").fill({"a": value}).startswith(f"{value:g}")


@pytest.mark.parametrize("text", ["", "It is.", "Is it?", "as follows:"])
def test_a_whole_sentence_stays(text):
    assert ended(text) == text


def test_a_line_of_a_list_becomes_a_sentence():
    assert ended("disk: 3 GB free") == "disk: 3 GB free."
