"""HTML of the marks by a rubric: a row a test, with a link to the instant of lost points."""

from __future__ import annotations

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.rubrics.marking import Mark, Marks
from mrlab_ros.core.show.motion_body import ICONS

# The class of a result, its icon, and the word beside it.
PASSED = ("completed", "accepted", "passed")
PARTLY = ("stopped", "ambiguous", "partly")
LOST = ("halted", "refused", "not passed")


def marks_body(marks: Marks) -> str:
    """Return the section with all marks."""
    rows = "".join(map(_row, marks.tests))
    hints = "".join(f'<p class="hint">{escape(hint)}</p>' for hint in marks.hints)
    return (
        '<section class="runs marks" aria-label="Marks"><h2>Marks</h2>'
        f'<p class="total"><b>{marks.points:g}</b> of {marks.of:g} points'
        f"{'. ' + escape(str(marks.note)) if marks.note else ''}</p>"
        "<table><thead><tr><th>Result</th><th>Points</th><th>Test</th><th>Time</th>"
        f"<th>Found</th></tr></thead><tbody>{rows}</tbody></table>{hints}</section>"
    )


def _row(mark: Mark) -> str:
    kind, icon, word = PASSED if mark.passed else PARTLY if mark.points else LOST
    hidden = "<small>hidden</small>" if mark.hidden else ""
    hint = f"<small>{escape(mark.hint)}</small>" if mark.hint and not mark.passed else ""
    return (
        f'<tr><td class="result {kind}"><svg viewBox="0 0 24 24" aria-hidden="true">'
        f'<path d="{ICONS[icon]}"/></svg><span>{word}</span></td>'
        f'<td class="figure">{mark.points:g} / {mark.of:g}</td>'
        f'<td class="test">{escape(mark.name)}{hidden}</td>'
        f'<td class="figure">{instant(mark.time)}</td>'
        f"<td>{escape(mark.found.message)}{hint}</td></tr>"
    )


def instant(time: float | None) -> str:
    """Return a link to an instant of the page's timeline, s; empty where there is none."""
    if time is None:
        return ""
    return f'<a href="#t={time:.3f}" data-time="{time:.3f}">{time:.2f} s</a>'
