"""The table of a graded class: a row a student, a column a test."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from urllib.parse import quote

from mrlab_ros.core.classroom.gradebook import number, text
from mrlab_ros.core.classroom.graded import REFERENCE, GradedClass, Student
from mrlab_ros.core.classroom.result import MARKED, Result
from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.show.both_languages import said
from mrlab_ros.core.show.motion_body import ICONS
from mrlab_ros.core.show.path_thumbnail import Thumbnails

# A half-filled circle: a part of the points.
PARTLY = "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 2.2v13.6a6.8 6.8 0 0 1 0-13.6z"
STATES = {
    "passed": (ICONS["accepted"], "passed", "erfüllt"),
    "partly": (PARTLY, "partly", "zum Teil"),
    "lost": (ICONS["refused"], "lost", "verfehlt"),
    "none": (ICONS["ambiguous"], "not checked", "nicht geprüft"),
}


def class_table(graded: GradedClass, thumbnails: Thumbnails) -> str:
    """Return the HTML of the table, with its search and its filter."""
    tests, of = graded.rubric.tests, number(graded.rubric.points)
    heads = [
        _column("name", "Student", "Studierende"),
        '<th scope="col" class="motion">' + said("Motion", "Bewegung") + "</th>",
        _column("points", f"Points of {of}", f"Punkte von {of}"),
        *(
            _column(f"test-{n}", test.name, test.name, hidden=test.hidden, of=test.points)
            for n, test in enumerate(tests)
        ),
    ]  # fmt: skip
    rows = "".join(_row(student, thumbnails) for student in graded.students)
    reference = ""
    if graded.reference is not None:
        reference = _reference_row(graded.reference, thumbnails)
    return (
        '<section class="students" aria-label="Students"><div class="tools">'
        f'<label>{said("Search", "Suchen")} <input type="search" id="search"></label>'
        f'<label>{said("Show", "Zeigen")} <select id="filter">'
        '<option value="" data-de="alle">all</option>'
        '<option value="lost" data-de="mit verlorenen Punkten">with lost points</option>'
        '<option value="unchecked" data-de="nicht geprüft">not checked</option>'
        '<option value="late" data-de="verspätet">late</option>'
        '<option value="alike" data-de="einander ähnlich">nearly the same</option>'
        '</select></label><output id="shown" aria-live="polite"></output></div>'
        f'<div class="scroll"><table><thead><tr>{"".join(heads)}</tr></thead>'
        f"<tbody>{rows}</tbody>{reference}</table></div></section>"
    )


def _column(
    key: str, english: str, german: str, *, hidden: bool = False, of: float | None = None
) -> str:
    more = f"<small>{number(of)}</small>" if of is not None else ""
    if hidden:
        more += "<small>" + said("hidden", "verdeckt") + "</small>"
    return (
        f'<th scope="col" aria-sort="none" class="{"test" if of is not None else key}">'
        f'<button type="button" data-sort="{key}">{said(english, german)}</button>{more}</th>'
    )


def _row(student: Student, thumbnails: Thumbnails) -> str:
    one, result = student.submission, student.result
    name = f"<bdi>{escape(one.name)}</bdi>"
    page = f"pages/{quote(student.key)}.html" if result.has_page else ""
    linked = f'<a href="{page}">{name}</a>' if page else f"<span>{name}</span>"
    details = [f"<small>{escape(one.identifier)}</small>"] if one.identifier else []
    if one.late:
        details.append('<small class="late">' + said("late", "verspätet") + "</small>")
    if result.file:
        details.append(f"<small><bdi>{escape(result.file)}</bdi></small>")
    notes = tuple(map(str, one.notes))
    if result.outcome != MARKED or not (result.path or result.has_page):
        notes = (text(result.found), *notes)
    details += [f'<small class="note">{escape(note)}</small>' for note in notes]
    cells = "".join(
        _mark(mark, number_, result, page) for number_, mark in enumerate(result.marks["tests"])
    )
    share = result.points / result.of if result.of else 0.0
    return (
        f'<tr data-key="{student.key}" data-name="{escape(one.name.casefold())}" '
        f'data-points="{result.points:g}" data-outcome="{result.outcome}"'
        f"{' data-late' if one.late else ''}>"
        f'<th scope="row">{linked}{"".join(details)}</th>'
        f'<td class="motion">{_picture(student.key, result, page, thumbnails)}</td>'
        f'<td class="points"><b>{number(result.points)}</b>'
        f'<meter min="0" max="1" value="{share:.3f}"></meter></td>{cells}</tr>'
    )


def _reference_row(result: Result, thumbnails: Thumbnails) -> str:
    page = f"pages/{REFERENCE}.html" if result.has_page else ""
    name = said("Reference solution", "Musterlösung")
    linked = f'<a href="{page}">{name}</a>' if page else name
    cells = "".join(_mark(m, n, result, page) for n, m in enumerate(result.marks["tests"]))
    return (
        f'<tfoot><tr><th scope="row">{linked}</th>'
        f'<td class="motion">{_picture(REFERENCE, result, page, thumbnails)}</td>'
        f'<td class="points"><b>{number(result.points)}</b></td>{cells}</tr></tfoot>'
    )


def _picture(key: str, result: Result, page: str, thumbnails: Thumbnails) -> str:
    length = result.duration or 0.0
    times = [m["time"] for m in result.marks["tests"] if m["time"] is not None]
    lost = [time / length for time in times if length > 0]
    svg = thumbnails.svg(result.path, lost) if result.path else ""
    if not svg:
        return f'<span class="none">{said("no motion", "keine Bewegung")}</span>'
    return f'<a href="{page}" tabindex="-1">{svg}</a>' if page else svg


def state_of(mark: Mapping[str, Any], result: Result) -> str:
    """Return which of STATES a mark is in."""
    if result.outcome != MARKED:
        return "none"
    if mark["passed"]:
        return "passed"
    return "partly" if mark["points"] > 0 else "lost"


def _mark(mark: Mapping[str, Any], place: int, result: Result, page: str) -> str:
    state = state_of(mark, result)
    _, english, german = STATES[state]
    content = f"{icon(state)}<b>{number(mark['points'])}</b>{said(english, german)}"
    words = text(mark["found"])
    if mark["time"] is not None:
        words = f"{mark['time']:.2f} s: {words}"
    if page:
        at = f"#t={mark['time']:.2f}" if mark["time"] is not None else ""
        content = f'<a href="{page}{at}">{content}</a>'
    else:
        content = f'<span class="verdict-of">{content}</span>'
    return (
        f'<td class="mark {state}" data-test-{place}="{mark["points"]:g}" '
        f'title="{escape(words)}">{content}</td>'
    )


def icon(state: str) -> str:
    """Return the sign of one of STATES."""
    return f'<svg viewBox="0 0 24 24" aria-hidden="true"><path d="{STATES[state][0]}"/></svg>'
