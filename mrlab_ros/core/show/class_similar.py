"""The students of a graded class whose motions are nearly the same."""

from __future__ import annotations

from urllib.parse import quote

from mrlab_ros.core.classroom.graded import GradedClass, Student
from mrlab_ros.core.classroom.similarity import Similar
from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.show.both_languages import german, said
from mrlab_ros.core.show.path_thumbnail import Thumbnails

MOST_GROUPS, MOST_MEMBERS = 60, 12


def similar_card(graded: GradedClass, common: Similar, thumbnails: Thumbnails) -> str:
    """Return the HTML of the groups, and of how they were found."""
    by_key = {s.key: s for s in graded.students}
    groups = []
    for group in common.groups[:MOST_GROUPS]:
        members = "".join(_member(by_key[key], thumbnails) for key in group.keys[:MOST_MEMBERS])
        if len(group.keys) > MOST_MEMBERS:
            more = len(group.keys) - MOST_MEMBERS
            members += f"<li>{said(f'and {more} more', f'und {more} weitere')}</li>"
        how = (
            said("the same file", "dieselbe Datei")
            if group.equal
            else said(
                f"{group.apart:.2f} deg apart at most",
                f"höchstens {german(group.apart)}° entfernt",
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
        f"{german(common.threshold)}° RMS"
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
