"""What files mean: honest ones are accepted, misleading ones are never accepted in silence."""

from collections import Counter
from collections.abc import Iterator

import converter_corpus as corpus
import converter_meanings as meanings
import numpy as np
import pytest
from converter_meanings import HONEST, Case

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome, convert
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.questions import ANSWERS

pytestmark = pytest.mark.slow

COEFFICIENTS = load_coefficients(corpus.ROOT / "config" / "torque_proxy.yaml")
MOST_STEPS = 3
QUESTIONS = ANSWERS | {"unit_conflict", "order_unclear"}


@pytest.fixture(scope="module")
def reader() -> Iterator[WorkspaceReader]:
    with WorkspaceReader() as reader:
        yield reader


def is_right(case: Case, result: ConversionResult) -> bool:
    """Say whether the trajectory is the motion of the file, at its rate."""
    t = result.trajectory
    if t is None or case.q is None or t.positions.shape != case.q.shape:
        return False
    return float(np.abs(t.positions - case.q).max()) < 1e-6 and (
        not case.rate or abs(t.frame_rate - case.rate) < 1e-3 * case.rate
    )


def ending(case: Case, result: ConversionResult) -> str:
    """Return how a file ended: right or wrong, in silence, warned, beside the matter, or asked."""
    if result.outcome is not Outcome.ACCEPTED:
        return "asked"
    assert result.trajectory is not None
    warned = " ".join(str(w).lower() for w in result.trajectory.warnings)
    right = "right" if is_right(case, result) else "wrong"
    if not warned:
        return f"{right} silent"
    told = right == "right" or any(word in warned for word in case.about)
    return f"{right} {'warned' if told else 'beside'}"


def converted(case: Case, reader: WorkspaceReader, options: Options) -> ConversionResult:
    name = case.name + case.suffix
    return convert(
        name,
        lambda: reader.read_bytes(case.data, name),
        options,
        corpus.model(case.robot),
        COEFFICIENTS,
    )


def followed(case: Case, reader: WorkspaceReader, result: ConversionResult) -> str:
    """Return how a refused file ends where its first fix is followed at each step."""
    options, seen = Options(), set[Options]()
    for _ in range(MOST_STEPS):
        fixes = [f for f in result.diagnostics[0].fixes if f.option]
        if result.outcome is Outcome.ACCEPTED or not fixes:
            return ending(case, result)
        options = corpus.applied(options, fixes[0])
        if options in seen:
            return "loop"
        seen.add(options)
        result = converted(case, reader, options)
    return ending(case, result)


def test_files_end_as_they_mean(reader):
    endings: dict[str, Counter[str]] = {"honest": Counter(), "misleading": Counter()}
    fixes: Counter[str] = Counter()
    faults = {}
    for case in meanings.build():
        result = converted(case, reader, Options())
        end = ending(case, result)
        endings[case.kind][end] += 1
        good = (
            {"right silent", "right warned"} if case.kind == HONEST else {"asked", "wrong warned"}
        )
        if end not in good | {"right silent", "right warned"}:
            faults[case.name] = f"{end}: {[str(d)[:160] for d in result.diagnostics[:2]]}"
        if end == "asked":
            after = followed(case, reader, result)
            fixes["asked" if result.diagnostics[0].code in QUESTIONS else after] += 1
            if after in ("wrong silent", "wrong beside", "loop"):
                faults[f"{case.name} followed"] = f"{after}: {result.diagnostics[0]}"
    print(endings, fixes)
    honest = endings["honest"]
    total = honest.total()
    assert not faults, "\n".join(f"{name}: {why}" for name, why in faults.items())
    assert honest["right silent"] + honest["right warned"] >= 0.97 * total
    assert honest["right silent"] >= 0.6 * total
    good = fixes["asked"] + fixes["right silent"] + fixes["right warned"]
    assert good >= 0.95 * fixes.total()
