"""Mark motions that are made from the reference solution and do less than it, or another thing.

They show the marks that a rubric gives without work.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.app.check.file import CheckedFile, Setting
from mrlab_ros.classroom.mark import mark_file
from mrlab_ros.classroom.rubrics.marking import Marks, mark
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.trajectory.trajectory import Channels, Trajectory

NOTHING, REVERSED, REFERENCE = "nothing at all", "reversed", "reference"
A_DAY_LATE = "reference, a day late"
SHARES = (0.25, 0.5, 0.75)


@dataclass(frozen=True, eq=False)
class Trial:
    """A made motion and its marks."""

    name: str
    marks: Marks


def made(reference: Trajectory) -> Iterator[tuple[str, Trajectory]]:
    """Yield a motion that stands still, the reversed one, and those that end too early."""
    count = reference.frame_count
    yield NOTHING, taken(reference, np.zeros(count, dtype=np.intp))
    yield REVERSED, taken(reference, np.arange(count)[::-1])
    for share in SHARES:
        yield f"cut at {share:.0%}", taken(reference, np.arange(max(2, int(count * share))))


def taken(reference: Trajectory, rows: np.typing.NDArray[np.intp]) -> Trajectory:
    """Return some rows of a motion in another order, at its frame rate."""
    positions = reference.positions[rows]
    velocities = np.gradient(positions, axis=0) * reference.frame_rate
    gripper = None if reference.gripper is None else reference.gripper[rows]
    channels = Channels(velocities, reference.channels.effort_proxy[rows])
    return replace(reference, positions=positions, gripper=gripper, channels=channels)


def trials(
    rubric: Rubric, setting: Setting, reference: CheckedFile, of_reference: Marks
) -> Sequence[Trial]:
    """Return the marks of all made motions and of the reference; none where it is a cell."""
    motion = reference.checked.trajectory
    if motion is None or len(reference.checked.motions) != 1:
        return ()
    found = []
    with tempfile.TemporaryDirectory(prefix="mrlab-trials-") as folder:
        for name, trajectory in made(motion):
            file = Path(folder) / f"{name.replace(' ', '-')}.json"
            formats.write(trajectory, file)
            found.append(Trial(name, mark_file(file, rubric, setting, reference)[1]))
    found.append(Trial(REFERENCE, of_reference))
    if rubric.late is not None:
        late = mark(rubric, reference.checked, reference.checked, late=1)
        found.append(Trial(A_DAY_LATE, late))
    return found
