"""A graded class as a page: a row a student, a column a test, what is common, and who is alike.

Sentences stand in English, with the German ones beside them for the page's script to choose.
"""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any
from urllib.parse import quote

from mrlab_ros.core.classroom.gradebook import number
from mrlab_ros.core.classroom.graded import BINS, REFERENCE, GradedClass, Statistics, Student
from mrlab_ros.core.classroom.result import MARKED, Result
from mrlab_ros.core.classroom.similarity import Similar
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
MOST_GROUPS, MOST_LEFT_OUT = 60, 200
HISTOGRAM = (480.0, 150.0)  # width, height


def class_body(graded: GradedClass) -> str:
    """Return the HTML of a graded class."""
    figures, common = graded.statistics(), graded.similar()
    paths = {s.key: s.result.path for s in graded.students if s.result.path}
    reference = graded.reference.path if graded.reference else ()
    thumbnails = Thumbnails(paths, reference)
    return "\n".join(
        (
            _head(graded, figures),
            '<main class="class">',
            '<section class="cards">',
            _distribution(graded, figures),
            _lost(graded, figures),
            _findings(graded, figures),
            "</section>",
            _table(graded, thumbnails),
            _similar(graded, common, thumbnails),
            _left_out(graded),
            "</main>",
            '<footer class="foot">'
            + said(
                "Marks are what a model shows; see each motion before you decide.",
                "Punkte sagen, was ein Modell zeigt; sehen Sie jede Bewegung an, bevor Sie "
                "entscheiden.",
            )
            + " · made by MR-Lab</footer>",
        )
    )


def said(english: str, german: str) -> str:
    """Return a sentence in both languages."""
    return f'<span data-de="{escape(german)}">{escape(english)}</span>'


def _head(graded: GradedClass, figures: Statistics) -> str:
    rubric, count = graded.rubric, len(graded.students)
    form = (
        said("read from a folder", "aus einem Ordner gelesen")
        if graded.form == "folder"
        else said(f"read as an export of {graded.form}", f"als Export von {graded.form} gelesen")
    )
    where = " · ".join(escape(part) for part in (rubric.robot, rubric.scene) if part)
    marked = sum(s.result.outcome == MARKED for s in graded.students)
    summary = said(
        f"{marked} of {count} checked; mean {figures.mean:.3g}, median {figures.median:.3g} of "
        f"{number(rubric.points)} points, {figures.full} with all of them",
        f"{marked} von {count} geprüft; Mittel {_german(figures.mean)}, Median "
        f"{_german(figures.median)} von {number(rubric.points)} Punkten, {figures.full} mit allen",
    )
    reference = ""
    if graded.reference is not None and graded.reference.points < graded.reference.of:
        got, of = number(graded.reference.points), number(graded.reference.of)
        reference = (
            '<p class="verdict ambiguous">'
            + _icon("none")
            + said(
                f"The reference solution itself gets {got} of {of} points.",
                f"Die Musterlösung selbst bekommt {got} von {of} Punkten.",
            )
            + "</p>"
        )
    return (
        f'<header class="head"><h1>{escape(rubric.name)}</h1><p class="facts">{where}</p>'
        f'<p class="summary">{summary} · {form}</p>{reference}</header>'
    )


def _german(value: float) -> str:
    return f"{value:.3g}".replace(".", ",")


def _card(english: str, german: str, content: str) -> str:
    return f'<section class="card"><h2>{said(english, german)}</h2>{content}</section>'


def _distribution(graded: GradedClass, figures: Statistics) -> str:
    width, height = HISTOGRAM
    base, most = height - 22.0, max(figures.bins) or 1
    step = width / BINS
    bars = []
    for place, count in enumerate(figures.bins):
        tall = (base - 20.0) * count / most
        left = place * step + 3.0
        first = graded.rubric.points * place / BINS
        bars.append(
            f'<rect x="{left:.1f}" y="{base - tall:.1f}" width="{step - 6:.1f}" '
            f'height="{tall:.1f}" rx="2"/>'
        )
        if count:
            middle = left + step / 2 - 3
            bars.append(f'<text x="{middle:.1f}" y="{base - tall - 5:.1f}">{count}</text>')
        bars.append(
            f'<text class="tick" x="{place * step:.1f}" y="{height - 6:.1f}">'
            f"{number(first)}</text>"
        )
    last = number(graded.rubric.points)
    bars.append(f'<text class="tick end" x="{width:.1f}" y="{height - 6:.1f}">{last}</text>')
    words = ", ".join(str(count) for count in figures.bins)
    svg = (
        f'<svg class="histogram" viewBox="0 0 {width:g} {height:g}" role="img" '
        f'aria-label="Students by tenths of the points: {words}">'
        f'<line x1="0" x2="{width:g}" y1="{base:g}" y2="{base:g}"/>{"".join(bars)}</svg>'
    )
    return _card("Points", "Punkte", svg)


def _lost(graded: GradedClass, figures: Statistics) -> str:
    count = len(graded.students)
    rows = "".join(
        f'<li><meter min="0" max="{count}" value="{test.students}"></meter>'
        f"<b>{test.students}</b><span>{escape(test.name)}</span></li>"
        for test in figures.tests[:8]
    )
    nothing = said("Nobody lost a point.", "Niemand hat einen Punkt verloren.")
    content = f'<ol class="counts">{rows}</ol>' if rows else f"<p>{nothing}</p>"
    return _card("Where points were lost", "Wo Punkte verloren gingen", content)


def _findings(graded: GradedClass, figures: Statistics) -> str:
    rows = "".join(
        f'<li class="{found.severity}"><b>{found.students}</b>'
        f"<span>{escape(found.message)}</span></li>"
        for found in figures.findings[:6]
    )
    nothing = said("No check found anything.", "Keine Prüfung hat etwas gefunden.")
    content = f'<ol class="counts messages">{rows}</ol>' if rows else f"<p>{nothing}</p>"
    return _card(
        "The commonest findings, each with one example",
        "Die häufigsten Befunde, je mit einem Beispiel",
        content,
    )


def _table(graded: GradedClass, thumbnails: Thumbnails) -> str:
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
    notes = (*one.notes, *result.notes)
    if result.outcome != MARKED or not (result.path or result.has_page):
        notes = (result.words, *notes)
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
    content = f"{_icon(state)}<b>{number(mark['points'])}</b>{said(english, german)}"
    words = mark["words"]
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


def _icon(state: str) -> str:
    return f'<svg viewBox="0 0 24 24" aria-hidden="true"><path d="{STATES[state][0]}"/></svg>'


def _similar(graded: GradedClass, common: Similar, thumbnails: Thumbnails) -> str:
    by_key = {s.key: s for s in graded.students}
    groups = []
    for group in common.groups[:MOST_GROUPS]:
        members = "".join(_member(by_key[key], thumbnails) for key in group.keys[:12])
        if len(group.keys) > 12:
            more = len(group.keys) - 12
            members += f"<li>{said(f'and {more} more', f'und {more} weitere')}</li>"
        how = (
            said("the same file", "dieselbe Datei")
            if group.equal
            else said(
                f"{group.apart:.2f} deg apart at most",
                f"höchstens {_german(group.apart)}° entfernt",
            )
        )
        groups.append(f"<li><p>{how}</p><ul>{members}</ul></li>")
    if len(common.groups) > MOST_GROUPS:
        more = len(common.groups) - MOST_GROUPS
        groups.append(f"<li>{said(f'and {more} more groups', f'und {more} weitere Gruppen')}</li>")
    near = len(common.as_reference)
    notes = []
    if near:
        notes.append(
            said(
                f"{near} are as the reference solution, and not shown as alike.",
                f"{near} sind wie die Musterlösung und werden nicht als ähnlich gezeigt.",
            )
        )
    usual = "" if common.usual is None else f"{common.usual:.2g}"
    apart = usual.replace(".", ",")
    about = said(
        "Joint angles at equal shares of the way, however a motion is timed; near is below "
        f"{common.threshold:.2g} deg RMS"
        + (f", where two of this class are usually {usual} deg apart. " if usual else ". ")
        + "That two motions are alike says nothing of how it came about.",
        "Gelenkwinkel bei gleichen Anteilen des Weges, gleich wie schnell; nah ist unter "
        f"{_german(common.threshold)}° RMS"
        + (f", wo zwei dieser Klasse meist {apart}° entfernt sind. " if usual else ". ")
        + "Dass zwei Bewegungen ähnlich sind, sagt nicht, wie es dazu kam.",
    )  # fmt: skip
    content = f'<ol class="groups">{"".join(groups)}</ol>' if groups else ""
    nothing = said("No two are nearly the same.", "Keine zwei sind fast gleich.")
    return (
        f'<section class="card alike"><h2>{said("Nearly the same", "Fast gleich")}</h2>'
        f'{content or f"<p>{nothing}</p>"}<p class="about">{about} {" ".join(notes)}</p></section>'
    )


def _member(student: Student, thumbnails: Thumbnails) -> str:
    name, result = f"<bdi>{escape(student.submission.name)}</bdi>", student.result
    svg = thumbnails.svg(result.path) if result.path else ""
    content = f"{svg}<span>{name}</span>"
    if result.has_page:
        content = f'<a href="pages/{quote(student.key)}.html">{content}</a>'
    return f'<li data-alike="{student.key}">{content}</li>'


def _left_out(graded: GradedClass) -> str:
    if not graded.left_out:
        return ""
    rows = "".join(
        f"<li><code>{escape(path)}</code> <span>{escape(why)}</span></li>"
        for path, why in graded.left_out[:MOST_LEFT_OUT]
    )
    head = said(
        f"Files left out: {len(graded.left_out)}", f"Ausgelassene Dateien: {len(graded.left_out)}"
    )
    return f'<details class="card left-out"><summary>{head}</summary><ul>{rows}</ul></details>'
