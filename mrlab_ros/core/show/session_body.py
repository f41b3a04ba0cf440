"""What a page about a recorded session says without a script: runs, events, plots, figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.recording.report import SessionReport
from mrlab_ros.core.recording.report_text import lasting
from mrlab_ros.core.show.runs_body import run_plots, runs_table
from mrlab_ros.core.show.technical_body import technical
from mrlab_ros.core.show.timeline_body import timeline

MOST_EVENTS = 200


def session_body(
    title: str, document: Mapping[str, Any], report: SessionReport, began: str
) -> str:
    """Return the HTML of a SessionDocument.

    began: as `2026-01-01 08:00:00`, empty where nothing was recorded.
    """
    events, drawn = document["events"], bool(document["robots"])
    when = f"<time>{began}</time> · " if began else ""
    troubles = "".join(
        f'<p class="trouble said">{escape(str(trouble))}</p>' for trouble in report.troubles
    )
    return "\n".join(
        (
            '<header class="head">',
            f'<h1>{escape(title)}</h1><p class="facts">{when}'
            f'<span class="said">{escape(str(report.summary))}</span></p>{troubles}',
            "</header>",
            f'<main class="{"with" if events and drawn else "without"}-findings">',
            runs_table(report, began),
            '<section id="view" aria-label="3D view"></section>' if drawn else "",
            _events(events),
            '<section class="plots" aria-label="Timeline">',
            timeline(report),
            run_plots(report),
            technical(report),
            "</section>",
            "</main>",
            '<footer class="foot">made by MR-Lab</footer>',
        )
    )


def _events(events: Sequence[Mapping[str, Any]]) -> str:
    if not events:
        return ""
    items = [
        f'<li class="{one["severity"]}"><button type="button" data-time="{one["time"]:.3f}">'
        f'<span class="number" aria-hidden="true">{number}</span>'
        f"<span><b>{lasting(one['time'])}</b> {escape(one['robot'])} "
        f'<span class="said">{escape(one["text"])}</span></span></button></li>'
        for number, one in enumerate(events[:MOST_EVENTS], 1)
    ]
    more = len(events) - MOST_EVENTS
    rest = f'<p class="said">{more} more events are in the table of runs.</p>' if more > 0 else ""
    return (
        '<section class="findings" aria-label="Events"><h2>Events</h2>'
        f"<ol>{''.join(items)}</ol>{rest}</section>"
    )
