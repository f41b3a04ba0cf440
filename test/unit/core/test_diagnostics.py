"""The table of findings: its texts, its page."""

import re
from pathlib import Path

import pytest

from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.diagnostics import KINDS, finding

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("code", KINDS)
def test_every_code_is_used_and_says_what_to_do(code):
    kind = KINDS[code]
    assert re.fullmatch(r"[a-z][a-z0-9_]+", code)
    assert kind.meaning.endswith(".")
    if kind.severity is Severity.ERROR:
        assert kind.remedy, "an error tells what to do next"
    sources = [p for p in (ROOT / "mrlab_ros").rglob("*.py") if p.name != "diagnostics.py"]
    assert any(f'"{code}"' in p.read_text() for p in sources), f"nothing says {code}"


def test_values_are_filled_in():
    found = finding("not_real", variable="q")
    assert found.message == "'q' holds complex numbers; joint positions are real."
    assert found.severity is Severity.ERROR
    assert found.variable == "q"
