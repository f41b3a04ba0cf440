"""Tries the fixes of a refusal: only those are offered that end at a motion without new doubts.

A fix has its own evidence where it is made; a run can only veto it, as scaling down passes every
limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.questions import ANSWERS

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
    if errors[0].code == worst.code or steps <= 1:
        return False
    following = vetted(after, changed, attempt, steps - 1)
    return any(f.option for f in following[0].fixes)
