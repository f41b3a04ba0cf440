"""A graded class as a page: a row a student, a column a test, what is common, and who is alike."""

from __future__ import annotations

from mrlab_ros.core.classroom.gradebook import number
from mrlab_ros.core.classroom.graded import BINS, GradedClass, Statistics
from mrlab_ros.core.classroom.result import MARKED
from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.show.both_languages import german, said
from mrlab_ros.core.show.class_similar import similar_card
from mrlab_ros.core.show.class_table import class_table, icon
from mrlab_ros.core.show.path_thumbnail import Thumbnails

MOST_LEFT_OUT = 200
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
            class_table(graded, thumbnails),
            similar_card(graded, common, thumbnails),
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
        f"{marked} von {count} geprüft; Mittel {german(figures.mean)}, Median "
        f"{german(figures.median)} von {number(rubric.points)} Punkten, {figures.full} mit allen",
    )
    reference = ""
    if graded.reference is not None and graded.reference.points < graded.reference.of:
        got, of = number(graded.reference.points), number(graded.reference.of)
        reference = (
            '<p class="verdict ambiguous">'
            + icon("none")
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
        f"<span>{escape(found.example['message'])}</span></li>"
        for found in figures.findings[:6]
    )
    nothing = said("No check found anything.", "Keine Prüfung hat etwas gefunden.")
    content = f'<ol class="counts messages">{rows}</ol>' if rows else f"<p>{nothing}</p>"
    return _card(
        "The commonest findings, each with one example",
        "Die häufigsten Befunde, je mit einem Beispiel",
        content,
    )


def _left_out(graded: GradedClass) -> str:
    if not graded.left_out:
        return ""
    rows = "".join(
        f"<li><code>{escape(path)}</code> <span>{escape(str(why))}</span></li>"
        for path, why in graded.left_out[:MOST_LEFT_OUT]
    )
    head = said(
        f"Files left out: {len(graded.left_out)}", f"Ausgelassene Dateien: {len(graded.left_out)}"
    )
    return f'<details class="card left-out"><summary>{head}</summary><ul>{rows}</ul></details>'
