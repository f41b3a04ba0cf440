"""Questions about the chosen matrix, warnings of what no claim explains, and tried fixes.

Only those fixes of a refusal are offered that end at a motion without new doubts. A fix has its
own evidence where it is made; a run can only veto it, as scaling down passes every limit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.conversion import rate_findings
from mrlab_ros.core.conversion.candidates import saving
from mrlab_ros.core.conversion.diagnostics import (
    LAYOUT_READ,
    MOTOR_SIDE,
    NAMES_OTHER,
    ORDER_STATED,
    ORDER_UNCLEAR,
    ROBOT_STATED,
    ROWS_NOT_FILLED,
    TEXT_UNREAD,
    UNUSED_BESIDE,
)
from mrlab_ros.core.conversion.evidence import headings, joining, joint_order, ledger, statements
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.ledger import About, Claim, End, Ledger, Standing
from mrlab_ros.core.conversion.evidence.names import Hint, Name, hint
from mrlab_ros.core.conversion.evidence.statements import Statement
from mrlab_ros.core.conversion.evidence.survey import Survey
from mrlab_ros.core.conversion.options import Options, columns_text
from mrlab_ros.core.conversion.workspace import Variable, Workspace, shortened
from mrlab_ros.core.robots.model import RobotModel

MOST_CLAIMS = 3
CLAIMED_BY = {
    "order_stated": About.ORDER, "order_unclear": About.ORDER, "names_other": About.ORDER,
    "robot_stated": About.ROBOT, "motor_side": About.MOTOR, "unit_unread": About.UNIT,
}  # fmt: skip
# a rate that is doubted already
RATE_WARNED = frozenset((
    "rate_unclear", "rate_unused", "rate_conflict", "time_length", "time_counts_rows",
))  # fmt: skip
# the questions whose fixes are answers of a person: what is asked about is taken all the same
ANSWERS = frozenset(("question", "ambiguous", "names_other", "robot_stated", "motor_side"))


def asked(
    workspace: Workspace,
    variable: Variable,
    name: Name,
    robot: RobotModel,
    options: Options,
    file: str,
) -> list[Diagnostic]:
    """Return what has to be asked about a matrix of a file before it is laid out.

    A person who named the matrix has answered: then nothing of it is an error.
    """
    if variable.values is None or len(variable.shape) != 2:
        return []
    said = statements.about(workspace, first_path(variable.path))
    joints = len(robot.joints)
    robots = _robots(workspace, variable, robot)
    if not robots and not options.variable:
        robots = _robots_of_names(variable, robot, file)
    found = [*robots, *_motors(said, variable, name, joints)]
    if not options.columns:
        found += _orders(said, variable, robot)
    if options.variable:
        return [_answered(d) for d in found]
    return found


def unread(
    survey: Survey, variable: Variable, rate: float, options: Options, notes: list[Diagnostic]
) -> list[Diagnostic]:
    """Return the warnings of what stands in the file and no claim explains.

    rate: Hz, that was taken. notes: what is said already.
    """
    if variable.values is None or len(variable.shape) != 2:
        return []
    claims = claimed(survey, variable, rate, options, notes)
    told = {text for note in notes for text in _texts(note)}
    told.update(joining.sources(variable.path, options.join))
    if variable.is_message:
        own = f"{variable.path}."
        told.update(v.path for v in survey.workspace.variables if v.path.startswith(own))
    robot = survey.robot
    size = (variable.shape[0], len(robot.joints))
    names = f"{robot.id} {robot.product} {robot.manufacturer}"
    found = ledger.read(survey.workspace, variable.path, size, claims, told, names)
    return [*_times(found, claims, options, notes), *_beside(found, variable.path)]


def claimed(
    survey: Survey, variable: Variable, rate: float, options: Options, notes: list[Diagnostic]
) -> list[Claim]:
    """Return the claims that a reading of a matrix rests on, with where the file makes them."""
    name = survey.name(variable)
    stated = Standing.STATED if name.hint.of_joints else Standing.INFERRED
    found = [Claim(About.QUANTITY, "positions", stated, variable.path)]
    said = statements.about(survey.workspace, first_path(variable.path))
    units = statements.unit_claims(said, first_path(variable.path))
    found += [Claim(About.UNIT, c.unit.name, Standing.STATED, c.source) for c in units]
    codes = {n.code: n for n in notes}
    by = codes.get("rate_found") or codes.get("rate_assumed") or codes.get("rate_of_velocity")
    standing = Standing.ASSUMED if "rate_default" in codes else Standing.STATED
    found.append(Claim(About.RATE, repr(rate), standing, by.variable if by else ""))
    for code, about in CLAIMED_BY.items():
        if code in codes:
            found.append(Claim(about, code, Standing.STATED, str(codes[code].values["source"])))
    return found


def _texts(note: Diagnostic) -> Iterator[str]:
    for value in note.values.values():
        if isinstance(value, str):
            yield value
        elif isinstance(value, (list, tuple)):
            yield from (v for v in value if isinstance(v, str))


def _times(
    found: Ledger, claims: list[Claim], options: Options, notes: list[Diagnostic]
) -> list[Diagnostic]:
    """Return what is said of times that nothing explains, or that contradict the rate."""
    times = found.unread(End.TIME)
    if not times or options.frame_rate or any(n.code in RATE_WARNED for n in notes):
        return []
    rate = next(c for c in claims if c.about is About.RATE)
    if rate.standing is Standing.ASSUMED:
        return [rate_findings.unclear([(e.path, e.rate) for e in times], float(rate.value))]
    others = [e for e in times if e.rate]
    return [
        rate_findings.conflict(rate.source, float(rate.value), e.path, e.rate) for e in others[:1]
    ]


def _beside(found: Ledger, path: str) -> list[Diagnostic]:
    """Return what is said of numbers and texts beside a matrix that nothing explains."""
    notes = []
    for end in (End.PER_JOINT, End.FACTOR):
        entries = found.unread(end)
        if not entries:
            continue
        count = "one" if len(entries) == 1 else "more"
        unread = dict.fromkeys(w for e in entries for w in e.words)
        notes.append(
            UNUSED_BESIDE(
                variable=path,
                found=shortened([e.path for e in entries]),
                count="factor" if end is End.FACTOR else count,
                unread=shortened([f"'{word}'" for word in unread]),
            )
        )
    for e in found.unread(End.TEXT)[:MOST_CLAIMS]:
        words = e.variable.text.strip()[:80] or _number(e.variable)
        listed = shortened([f"'{word}'" for word in e.words])
        notes.append(TEXT_UNREAD(variable=path, source=e.path, words=words, unread=listed))
    return notes


def _number(v: Variable) -> str:
    return "" if v.values is None else f"{float(v.values.reshape(-1)[0]):g}"


def _answered(found: Diagnostic) -> Diagnostic:
    if found.severity is not Severity.ERROR or found.code not in ANSWERS:
        return found
    fixes = tuple(Fix(matlab=fix.matlab) for fix in found.fixes if fix.matlab)
    return replace(found, severity=Severity.WARNING, fixes=fixes)


def _yes(variable: Variable) -> tuple[Fix, ...]:
    return (Fix("variable", variable.path, saving(variable.path)),)


def _robots(workspace: Workspace, variable: Variable, robot: RobotModel) -> list[Diagnostic]:
    found = []
    for claim in statements.robot_claims(workspace, robot)[:1]:
        severity = Severity.ERROR if claim.other_maker else Severity.WARNING
        found.append(
            ROBOT_STATED(
                severity=severity,
                variable=variable.path,
                source=claim.source,
                words=claim.text[:80],
                model=robot.id,
                fixes=_yes(variable)
                if claim.other_maker
                else (Fix(matlab=saving(variable.path)),),
            )
        )
    return found


def _robots_of_names(variable: Variable, robot: RobotModel, file: str) -> list[Diagnostic]:
    """Return a warning where the name of the matrix or of its file means another robot."""
    named = ((name, statements.robot_named(name, robot)) for name in (variable.path, file))
    return [
        ROBOT_STATED(
            severity=Severity.WARNING,
            variable=variable.path,
            source=name,
            words=words[:80],
            model=robot.id,
            fixes=_yes(variable),
        )
        for name, words in named
        if words
    ][:1]


def _motors(
    said: list[Statement], variable: Variable, name: Name, joints: int
) -> list[Diagnostic]:
    gear = statements.gears(said, joints)
    if gear is None and not name.motor:
        return []
    source = variable.path if gear is None else gear.path
    finding = MOTOR_SIDE(variable=variable.path, source=source)
    if not name.motor:
        return [finding]
    fixes = (*_yes(variable), *finding.fixes)
    return [
        MOTOR_SIDE(severity=Severity.ERROR, variable=variable.path, source=source, fixes=fixes)
    ]


def _orders(said: list[Statement], variable: Variable, robot: RobotModel) -> list[Diagnostic]:
    """Return what is said of the orders and names that the file states for the columns."""
    path, joints = variable.path, len(robot.joints)
    for claim in joint_order.order_vectors(said, joints)[:MOST_CLAIMS]:
        words: dict[str, Any] = {"variable": path, "source": claim.source, "words": claim.text}
        if claim.is_identity:
            continue
        if claim.is_clear:
            kept = (Fix("columns", f"1:{joints}", saving(path)),)
            return [ORDER_STATED(model=robot.id, fixes=kept, **words)]
        columns = [claim.joints.index(j) for j in range(joints)]
        fixes = tuple(
            Fix(
                "columns",
                text,
                f"q = {path}(:, {text}); {saving('q')}",
            )
            for text in map(columns_text, (columns, list(claim.joints)))
        )
        return [ORDER_UNCLEAR(joints=joints, fixes=fixes, **words)]
    if variable.columns:
        return _headings(variable, robot)
    for names in joint_order.names_claims(said, variable.shape[1])[:MOST_CLAIMS]:
        meant = names.names[:joints]
        if joint_order.order_of_names(meant, robot) is None and not _numbers_alone(meant):
            return [
                NAMES_OTHER(
                    variable=path,
                    source=names.source,
                    words=" ".join(shortened(list(names.names))),
                    model=robot.id,
                    joints=list(robot.joint_names),
                    fixes=_yes(variable),
                )
            ]
    return []


def _headings(variable: Variable, robot: RobotModel) -> list[Diagnostic]:
    """Return the question of headings that number other joints than the robot has."""
    joints = len(robot.joints)
    names = [headings.plain(h)[0] for h in variable.columns[:joints]]
    if headings.names_joints(variable, robot) or not joint_order.counts_otherwise(names, robot):
        return []
    return [
        NAMES_OTHER(
            variable=variable.path,
            source=variable.path,
            words=" ".join(shortened(list(variable.columns))),
            model=robot.id,
            joints=list(robot.joint_names),
            fixes=_yes(variable),
        )
    ]


def _numbers_alone(names: tuple[str, ...]) -> bool:
    return all(name.strip().isdigit() for name in names)


# how numbers lie is seen by the numbers themselves: such a fix is taken where nothing speaks
# against it
LAYOUTS = frozenset(("transposed", "time_column", "inside_container", "wrong_shape"))
APPLIED = frozenset(("transpose_applied", "columns_applied"))


def layout(found: Sequence[Diagnostic], options: Options) -> Options | None:
    """Return options with the only layout that a refusal leaves, None where a person has to say.

    found: the findings of the refusal, worst first. Only a person says how to read the pieces of
    what is not named as joints.
    """
    worst = found[0]
    fixes = [f for f in worst.fixes if f.option]
    if worst.code not in LAYOUTS or len(fixes) != 1 or getattr(options, fixes[0].option):
        return None
    beside = worst.values.get("beside")
    if worst.code == "wrong_shape" and not (beside and beside <= worst.values["more"]):
        return None
    joined = fixes[0].value if fixes[0].option == "join" else ""
    of_joints = hint(joined) is Hint.POSITIONS and worst.values.get("pieces") == "joints"
    if joined and not of_joints:
        return None
    return applied(options, fixes[0])


def read_so(found: Sequence[Diagnostic], why: Diagnostic) -> list[Diagnostic] | None:
    """Return the findings of a conversion with a layout that nobody asked for, or None.

    None where they doubt it. why: the finding that it mends; a column that is not the first and
    may be a joint as well is a warning.
    """
    if any(d.severity is Severity.ERROR or d.code in DOUBTS for d in found):
        return None
    rises = getattr(why.values.get("why"), "values", {}).get("rises")
    unsure = rises in ("round", "irregular") and why.values["column"] != 1
    said = LAYOUT_READ(
        severity=Severity.WARNING if unsure else Severity.INFO,
        variable=why.variable,
        why=replace(why, remedy="", fixes=()),
        fixes=why.fixes,
    )
    return [*(d for d in found if d.code not in APPLIED), said]


# what corrects an option, and what a person answers: nothing is tried for these
NOT_TRIED = ANSWERS | {
    "bad_option", "bad_rate", "bad_columns", "bad_part", "unknown_variable", "order_unclear",
    "unit_conflict", "no_trajectory", "looks_like", "no_times", "too_long",
}  # fmt: skip
DOUBTS = frozenset(("doubtful_values", "velocity_limit", "rate_conflict"))
MOST_TRIED = 4
MOST_STEPS = 2
# numbers of a file whose fixes are tried; a conversion of more takes too long to repeat
MOST_VALUES = 4_000_000

Attempt = Callable[[Options], Sequence[Diagnostic]]


def applied(options: Options, fix: Fix) -> Options:
    """Return options with a fix, whose value is a text."""
    now = getattr(options, fix.option)
    value: Any = fix.value
    if isinstance(now, bool):
        value = fix.value == "true"
    elif isinstance(now, float):
        value = float(fix.value or 0)
    return replace(options, **{fix.option: value})


def vetted(
    found: Sequence[Diagnostic], options: Options, attempt: Attempt, steps: int = MOST_STEPS
) -> tuple[Diagnostic, ...]:
    """Return the findings, worst first, with those fixes of the worst that lead to a motion.

    attempt: returns the findings, worst first, of a conversion with other options. A fix that
    fails keeps its line of MATLAB.
    """
    worst = found[0]
    if not any(f.option for f in worst.fixes):
        return tuple(found)
    if worst.code in NOT_TRIED or worst.severity is not Severity.ERROR:
        return tuple(found)
    before = {d.code for d in found}
    tried = [f for f in worst.fixes if f.option][:MOST_TRIED]
    good = [f for f in tried if _leads_on(f, worst, before, options, attempt, steps)]
    others = [replace(f, option="", value="") for f in worst.fixes if f not in good and f.matlab]
    others = list(dict.fromkeys(others)) or ([] if good else [Fix(matlab="whos")])
    return (replace(worst, fixes=(*good, *others)), *found[1:])


def _leads_on(
    fix: Fix, worst: Diagnostic, before: set[str], options: Options, attempt: Attempt, steps: int
) -> bool:
    """Say whether a fix removes a finding and leads to a motion, or to one more fix that does."""
    changed = applied(options, fix)
    if changed == options:
        return False
    after = attempt(changed)
    errors = [d for d in after if d.severity is Severity.ERROR]
    if not errors:
        codes = {d.code for d in after if d.severity is Severity.WARNING}
        allowed = {"velocity_limit"} if any(d.code == "rate_default" for d in after) else set()
        return not (codes & DOUBTS) - before - allowed
    if errors[0].code in ANSWERS:
        return True
    repeats = errors[0].code == worst.code and worst.code != ROWS_NOT_FILLED.code
    if repeats or steps <= 1:
        return False
    following = vetted(after, changed, attempt, steps - 1)
    return any(f.option for f in following[0].fixes)
