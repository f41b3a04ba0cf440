"""How far an object falls when it is let go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import FALLS
from mrlab_ros.classroom.rubrics.measures.contacts import recording
from mrlab_ros.classroom.rubrics.measures.grasps import let_go
from mrlab_ros.classroom.rubrics.rubric import LENGTH, Ground, Outcome, Threshold
from mrlab_ros.classroom.rubrics.sentences import Form
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked


@dataclass(frozen=True)
class Drop:
    """The height by which an object is lower at rest than at its last release."""

    thing: str
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        found = let_go(checked, self.thing)
        if isinstance(found, Outcome):
            return found
        time, rests = found
        course = recording(checked).objects[self.thing]
        height = float(np.interp(time, course.times, [values[2] for values in course.values]))
        fallen = max(height - rests.values[2], 0.0)
        return self.threshold.outcome(FALLS, fallen, time, object=self.thing)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.graspable_flaws(self.thing)
        yield from self.threshold.flaws()


FAMILY = "grasps"
FORMS = (
    Form(
        "drop of OBJECT < LENGTH",
        lambda gaps, given: Drop(gaps["object"], Threshold(LENGTH, gaps["length"], given.until)),
        "How far it falls after its last release, until it is at rest.",
        until=LENGTH,
    ),
)
