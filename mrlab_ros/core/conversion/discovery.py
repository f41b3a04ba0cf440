"""Finds the joint positions in a workspace among all that could be them."""

from __future__ import annotations

from mrlab_ros.core.conversion.candidates import (
    FEW_ROWS,
    Candidate,
    columns_of_time,
    fits,
    score,
)
from mrlab_ros.core.conversion.explain import (
    contents,
    holds_samples,
    object_finding,
    refusal,
)
from mrlab_ros.core.conversion.frame_rate import time_beside
from mrlab_ros.core.conversion.variable_names import Hint, hint
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Diagnostic, Refused, finding
from mrlab_ros.core.robots.model import RobotModel

# A score from which a matrix is taken or offered, and below which it is not even offered.
PLAUSIBLE, CONCEIVABLE = 0.55, 0.25
# The likeliest is taken over other plausible ones from this lead on.
CLEAR_LEAD = 0.25


def candidates(workspace: Workspace, robot: RobotModel) -> list[Candidate]:
    """Return the matrices that fit the robot, likeliest first."""
    found = [
        score(v, robot, has_time=time_beside(workspace, v.path) is not None)
        for v in workspace.variables
        if fits(v, robot) and not columns_of_time(v, robot)
    ]
    return sorted(found, key=lambda c: -c.score)


def choose(
    workspace: Workspace, robot: RobotModel, file: str, ranked: list[Candidate]
) -> tuple[Candidate | None, list[Candidate], list[Diagnostic]]:
    """Choose the trajectory without being told which it is.

    Returns the choice, or None and the candidates to choose from (empty: none), with findings;
    where nothing was chosen the last one is the reason.
    """
    plausible = [c for c in ranked if c.score >= PLAUSIBLE]
    conceivable = [c for c in ranked if c.score >= CONCEIVABLE]
    objects = [v for v in workspace.variables if v.is_object]
    hidden = [v for v in objects if hint(v.path) is Hint.POSITIONS and holds_samples(v)]
    notes: list[Diagnostic] = []
    if plausible:
        best, others = plausible[0], plausible[1:]
        clear = not others or best.score - others[0].score >= CLEAR_LEAD
        named = hint(best.path) is Hint.POSITIONS
        rivals = [v for v in workspace.variables if _rival(v, best, robot)]
        if clear and (named or not (hidden or rivals or conceivable[1:])):
            if others:
                names = ", ".join(f"'{c.path}'" for c in others[:5])
                notes.append(finding("other_candidates", variable=best.path, found=names))
            if hidden or objects:
                notes.append(object_finding("object_ignored", hidden or objects, file))
            return best, [], notes
    if conceivable and not (hidden and not plausible):
        listed = "; ".join(f"'{c.path}' ({c.size}, {c.why})" for c in conceivable[:5])
        count = f"{len(conceivable)} matrices" if len(conceivable) > 1 else "One matrix"
        notes.append(finding("ambiguous", file=file, count=count, found=listed))
        return None, conceivable, notes
    return None, [], [refusal(workspace, robot, file)]


def _rival(variable: Variable, best: Candidate, robot: RobotModel) -> bool:
    """Say whether another matrix is laid out as samples by joints in some other way."""
    return (
        variable.path != best.path
        and variable.values is not None
        and variable.shape[0] in (len(robot.joints), len(robot.joints) + 1)
        and variable.shape[1] >= FEW_ROWS
        and hint(variable.path) is not Hint.NEUTRAL
    )


def named(workspace: Workspace, path: str, file: str) -> Variable:
    """Return the variable that was asked for; raise Refused with the names there are."""
    found = workspace.find(path)
    if found is None:
        found_text = contents(workspace)
        raise Refused(finding("unknown_variable", file=file, variable=path, found=found_text))
    return found
