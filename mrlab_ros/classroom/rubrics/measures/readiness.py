"""The verdict of the check."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.classroom.rubrics.diagnostics import NOT_READY_FOR_ROBOT, READY_FOR_ROBOT
from mrlab_ros.classroom.rubrics.rubric import Ground, Outcome
from mrlab_ros.classroom.rubrics.sentences import Form
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked


@dataclass(frozen=True)
class Ready:
    """No finding of the check blocks the motion."""

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        blocking = next((f for f in checked.report.findings if f.refuses), None)
        if blocking is None:
            return Outcome(1.0, READY_FOR_ROBOT())
        return Outcome(0.0, NOT_READY_FOR_ROBOT(why=blocking), blocking.time or 0.0)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ()


FAMILY = "verdict"
FORMS = (
    Form("ready", lambda gaps, given: Ready(), "No finding of `mrlab check` blocks the motion."),
)
