"""Finds the joint positions in a workspace among all that could be them."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.candidates import contents, saving
from mrlab_ros.core.conversion.diagnostics import (
    AMBIGUOUS,
    COPIES,
    DOUBTFUL_NAME,
    DOUBTFUL_VALUES,
    NEUTRAL_NAME,
    OBJECT_IGNORED,
    OTHER_CANDIDATES,
    TOOL_PATH_DIFFERS,
    TWIN,
    UNKNOWN_VARIABLE,
)
from mrlab_ros.core.conversion.evidence import joining
from mrlab_ros.core.conversion.evidence.assessment import FEW_ROWS, Assessment
from mrlab_ros.core.conversion.evidence.names import Hint
from mrlab_ros.core.conversion.evidence.survey import Survey
from mrlab_ros.core.conversion.explain import described, holds_samples, object_finding, refusal
from mrlab_ros.core.conversion.workspace import Variable, Workspace

# A score from which a matrix is taken or offered, and below which it is not even offered.
PLAUSIBLE, CONCEIVABLE = 0.55, 0.25
# The likeliest is taken over other plausible ones from this lead on.
CLEAR_LEAD = 0.25
MOST_OFFERED = 12


def choose(
    survey: Survey, file: str
) -> tuple[Assessment | None, list[Assessment], list[Diagnostic]]:
    """Choose the trajectory where nobody named it.

    Returns the choice, or None and those to choose from (empty: none), with findings; where
    nothing was chosen the last one is the reason.
    """
    ranked = survey.ranked()
    plausible = [a for a in ranked if a.score >= PLAUSIBLE]
    conceivable = [a for a in ranked if a.score >= CONCEIVABLE]
    objects = [v for v in survey.workspace.variables if v.is_object]
    named = [v for v in objects if survey.name(v).hint.of_joints]
    hidden = [v for v in named if holds_samples(v, Hint.POSITIONS)]
    notes: list[Diagnostic] = []
    best = _best(plausible, conceivable, survey, bool(hidden))
    asked = best is None and survey.columns_asked and len(ranked) == 1 == len(conceivable)
    if asked:
        # columns that only one matrix has say which one is meant
        best = conceivable[0]
    if best is not None:
        same = [a.path for a in plausible if a.path in best.copies]
        if same:
            notes.append(COPIES(variable=best.path, others=same[:5]))
        others = [a for a in plausible if a is not best and a.path not in same]
        if others:
            code = TWIN if best.twin in {a.path for a in others} else OTHER_CANDIDATES
            names = [a.path for a in others[:5]]
            notes.append(code(variable=best.path, others=names, fixes=_choices(others[:5])))
        # functions hold no samples, so nothing is lost with them
        ignored = hidden or [v for v in objects if v.kind != "function_handle"]
        if ignored:
            notes.append(object_finding(OBJECT_IGNORED, ignored, file))
        notes += doubts(best, asked=asked)
        return best, [], notes
    if conceivable and not (hidden and not plausible):
        conceivable = conceivable[:MOST_OFFERED]
        notes.append(_ambiguous(conceivable, survey, file))
        return None, conceivable, notes
    return None, [], [refusal(survey, file)]


def _best(
    plausible: list[Assessment], conceivable: list[Assessment], survey: Survey, hidden: bool
) -> Assessment | None:
    """Return the matrix that is clearly the likeliest, or None."""
    if not plausible:
        return None
    best, others = plausible[0], plausible[1:]
    twins = {best.path, best.twin, *best.copies} - {""}
    others = [a for a in others if a.path not in twins and a.twin not in twins]
    if others and best.points - others[0].points < CLEAR_LEAD:
        return None
    if best.name.hint.of_joints or best.confirmed:
        return best
    rivals = any(_rival(v, best, survey) for v in survey.workspace.variables)
    remaining = [a for a in conceivable if a.path not in twins]
    return None if hidden or rivals or remaining else best


def _rival(variable: Variable, best: Assessment, survey: Survey) -> bool:
    """Say whether another matrix is laid out as samples by joints in some other way."""
    joints = len(survey.robot.joints)
    return (
        variable.path != best.path
        and variable.values is not None
        and len(variable.shape) == 2
        and variable.shape[0] in (joints, joints + 1)
        and variable.shape[1] >= FEW_ROWS
        and survey.name(variable).hint not in (Hint.NEUTRAL, Hint.AGAINST)
    )


def _ambiguous(offered: list[Assessment], survey: Survey, file: str) -> Diagnostic:
    fixes = _choices(offered)
    paths = {a.path for a in offered}
    for found in joining.series(survey.workspace, len(survey.robot.joints)):
        whole = not survey.workspace.omitted
        if whole and not found.beside and len(found.paths) > 1 and set(found.paths) <= paths:
            line = f"q = [{'; '.join(found.paths[:8])}]; save('traj.mat', 'q', '-v7')"
            fixes = (*fixes, Fix("join", found.text, line))
            break
    if len(offered) == 1:
        only = offered[0]
        why = only.objections or (only.name.why, *only.doubts)
        return AMBIGUOUS(
            file=file,
            variable=only.path,
            only=only.path,
            size=only.variable.size,
            why=list(why),
            seen=list(only.reasons[1:]),
            fixes=fixes,
        )
    return AMBIGUOUS(
        file=file,
        variable=offered[0].path,
        count=len(offered),
        candidates=[described(a, a.candidate().reasons) for a in offered[:5]],
        among=[a.path for a in offered[:5]],
        fixes=fixes,
    )


def _choices(offered: list[Assessment]) -> tuple[Fix, ...]:
    return tuple(Fix("variable", a.path, saving(a.path)) for a in offered)


def doubts(chosen: Assessment, *, asked: bool) -> list[Diagnostic]:
    """Return the warnings that go with a matrix. asked: a person named it."""
    if chosen.variable.is_message:
        return []
    path, name = chosen.path, chosen.name
    notes = []
    reasons = list(chosen.doubts)
    if asked:
        reasons = [*chosen.objections, *reasons]
        if name.hint in (Hint.AGAINST, Hint.DOUBTFUL) and not chosen.objections:
            notes.append(DOUBTFUL_NAME(variable=path, why=name.why))
        elif not (name.hint is Hint.POSITIONS or reasons) and chosen.score < PLAUSIBLE:
            # it would have been asked about: the doubt stays although it was answered
            reasons = [name.why, *chosen.reasons[1:]]
    elif name.hint is not Hint.POSITIONS and not chosen.confirmed:
        fixes = (Fix("variable", path, saving(path)),)
        seen = chosen.reasons[1:]
        notes.append(NEUTRAL_NAME(variable=path, why=name.why, seen=seen, fixes=fixes))
    if reasons:
        notes.append(DOUBTFUL_VALUES(variable=path, why=reasons))
    if chosen.other_tool_path is not None:
        other, match = chosen.other_tool_path
        notes.append(
            TOOL_PATH_DIFFERS(
                variable=path,
                other=other,
                value=match.error,
                limit=match.extent,
                unit="m",
            )
        )
    return notes


def named(workspace: Workspace, path: str, file: str) -> Variable:
    """Return the variable that was asked for; raise BadInput with the names there are."""
    found = workspace.find(path)
    if found is None:
        fixes = tuple(Fix("variable", name) for name in _similar(workspace, path))
        held = contents(workspace)
        raise BadInput(UNKNOWN_VARIABLE(file=file, variable=path, fixes=fixes, **held))
    return found


def _similar(workspace: Workspace, path: str) -> list[str]:
    """Return paths of matrices, those first that are spelled almost like `path`."""
    wanted = path.lower().rpartition(".")[2]
    matrices = [v.path for v in workspace.variables if v.values is not None and v.values.size > 1]
    messages = tuple(f"{v.path}." for v in workspace.variables if v.is_message)
    matrices = [p for p in matrices if not p.startswith(messages)]
    same = [p for p in matrices if p.lower().rpartition(".")[2] == wanted]
    return (same + [p for p in matrices if p not in same])[:5]
