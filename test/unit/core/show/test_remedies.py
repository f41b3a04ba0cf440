"""A page says how to mend a file without words of the command line."""

from __future__ import annotations

import re
from string import Formatter

import pytest

from mrlab_ros.core.diagnostics import KINDS, _Said
from mrlab_ros.core.show.remedies import for_page

# What is filled into the remedies, with a part of a matrix as the hardest.
WORDS = {"fix": "q(1:200, :)", "join": "q1..q6", "code": "q = [a b];", "variable": "arm.q"}


class Filled(Formatter):
    """Fills in a word for whatever a text names."""

    def get_value(self, key, args, kwargs):
        return _Said(WORDS[key]) if key in WORDS else 6


# What the table says of robots is read at a terminal.
@pytest.mark.parametrize("code", list(KINDS))
def test_no_remedy_names_an_option_of_the_command_line(code):
    shown = for_page(Filled().format(KINDS[code].remedy))
    assert "--" not in shown
    assert "with the option" not in shown
    assert not re.search(r"[ ,:(]$| [.,;](?: |$)|\(\)", shown), shown
    assert "--" not in KINDS[code].message


@pytest.mark.parametrize(
    ("remedy", "shown"),
    [
        ("In MATLAB q = unwrap(q), or convert with the option unwrap (--unwrap).",
         "In MATLAB q = unwrap(q)."),
        ("Convert them, in MATLAB q = deg2rad(q); Only if all are degrees: --units deg.",
         "Convert them, in MATLAB q = deg2rad(q);"),
        ("Take one of them (--variable 'q(1:200, :)').", "Take one of them."),
        ("Save one column a joint, or pick columns: --columns '1:3, 5'.",
         "Save one column a joint, or pick columns."),
        ("If it is right, save it as fs, or use --rate 62.5; else say the rate: --rate 100.",
         "If it is right, save it as fs."),
        ("Write -- or nothing.", "Write -- or nothing."),
    ],
)  # fmt: skip
def test_what_is_left_is_a_sentence(remedy, shown):
    assert for_page(remedy) == shown
