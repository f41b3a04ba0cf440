"""Text from outside acts nowhere: not on a terminal, a page, a table or a shell."""

from __future__ import annotations

import csv
import html
import io
import json
import subprocess
import unicodedata

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mrlab_ros.core.base import foreign_text
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import NEVER_FILLED

ANY = st.text(st.characters(codec="utf-8"))


def acts(character: str) -> bool:
    """Return whether Unicode takes a character for a control, or an override of direction."""
    kind = unicodedata.category(character)
    overrides = ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")
    return kind in ("Cc", "Zl", "Zp", "Cs") or unicodedata.bidirectional(character) in overrides


@given(ANY)
@example("\x1b]52;c;ZXZpbA==\x07")
@example("\x9b2J\u202e\u2066\u2028")
def test_nothing_acts_on_a_terminal(text: str) -> None:
    assert not any(map(acts, foreign_text.visible(text)))
    assert {c for c in foreign_text.visible_lines(text) if acts(c)} <= {"\n", "\t"}


@given(st.dictionaries(ANY, ANY))
def test_json_stays_the_same_json(document: dict[str, str]) -> None:
    text = json.dumps(document, ensure_ascii=False)
    assert json.loads(foreign_text.visible_lines(text)) == document


@pytest.mark.parametrize(
    "text", ["Änne Groß", "سارا\u200cنوری", "q_Δ", "👩\u200d🔬", "a [b] 'c' $d"]
)
def test_names_of_people_and_things_stay(text: str) -> None:
    assert foreign_text.visible(text) == text


@given(ANY)
def test_a_page_shows_it_as_text(text: str) -> None:
    shown = foreign_text.for_html(text)
    assert not set("<>\"'").intersection(shown)
    assert html.unescape(shown) == foreign_text.visible_lines(text)


@given(st.text("=+-@;\t\n\r \"'a,\uff1d"))
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_no_table_program_computes_it(delimiter: str, text: str) -> None:
    written = io.StringIO()
    csv.writer(written).writerow([foreign_text.for_table(text), "b"])
    read = csv.reader(io.StringIO(written.getvalue(), newline=""), delimiter=delimiter)
    cells = [cell.lstrip() for row in read for cell in row]
    assert not [cell for cell in cells if cell.startswith(tuple("=+-@\uff1d"))]


@given(st.lists(st.text(st.characters(codec="utf-8", exclude_characters="\0")), max_size=4))
@example(["q; touch made", "$(touch made)", "`touch made`", "a'b\\", "\x1b[2J", "-x", "\u202e"])
def test_a_shell_takes_it_as_words(words: list[str]) -> None:
    line = foreign_text.for_shell(words)
    assert not any(map(acts, line))
    command = ["bash", "-c", f"printf '%s\\0' {line}" if words else ":"]
    got = subprocess.run(
        command, capture_output=True, check=True, env={"LC_ALL": "C.UTF-8"}
    ).stdout
    assert got.split(b"\0")[: len(words)] == [word.encode() for word in words]


def test_findings_and_errors_hold_nothing_that_acts() -> None:
    name = "\x1b[2Jq\nmrlab: accepted"
    said = NEVER_FILLED(variable=name, size="2x2")
    assert not any(map(acts, said.message))
    assert said.variable == name, "as the file has it, for programs"
    assert not {c for c in str(BadInput(name)) if acts(c)} - {"\n"}


@pytest.mark.parametrize(
    "name", ["q; system('x')", "system('x')", "a=b", "q'", "ü", "q\n!x", "!x"]
)
def test_no_line_of_matlab_holds_what_is_no_name(name: str) -> None:
    found = NEVER_FILLED(variable=name, size="2x2")
    assert [fix.matlab for fix in found.fixes] == ["any(q(:))"]
    for taken in ("q", "out.q", "c{2}.q(1, :)", "s(3).q_d"):
        (fix,) = NEVER_FILLED(variable=taken, size="2x2").fixes
        assert fix.matlab == f"any({taken}(:))"


@given(ANY)
def test_a_cell_acts_on_no_terminal(text: str) -> None:
    shown = foreign_text.for_table(text)
    assert not any(acts(sign) for sign in shown if sign not in "\n\t")
