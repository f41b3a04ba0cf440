"""Real files of many habits: no wrong motion in silence, no good file refused."""

from collections.abc import Iterator

import converter_corpus as corpus
import converter_corpus_third as third
import numpy as np
import pytest
from converter_corpus import ACCEPT, NOT_SILENT, REFUSE, WARN, File

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome, convert
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import Workspace

pytestmark = pytest.mark.slow

MOST_STEPS = 6
COEFFICIENTS = load_coefficients(corpus.ROOT / "config" / "torque_proxy.yaml")


@pytest.fixture(scope="module")
def reader() -> Iterator[WorkspaceReader]:
    with WorkspaceReader() as reader:
        yield reader


def fault(file: File, result: ConversionResult) -> str:
    """Return what is wrong with the result, empty where it is right."""
    accepted = result.outcome is Outcome.ACCEPTED
    warned = accepted and bool(result.trajectory.warnings)
    if file.truth == ACCEPT and not accepted:
        return "a good file was refused"
    if file.truth == WARN and result.outcome is Outcome.REJECTED:
        return "a file that could be meant was refused"
    if file.truth == REFUSE and accepted:
        return "a wrong file was accepted"
    if file.truth in (WARN, NOT_SILENT) and accepted and not warned:
        return "a doubtful file was accepted in silence"
    if not accepted:
        return ""
    t = result.trajectory
    if file.rate and abs(t.frame_rate - file.rate) > 1e-3 * file.rate:
        return f"it plays at {t.frame_rate:g} Hz"
    if file.positions is not None and (
        t.positions.shape != file.positions.shape
        or float(np.abs(t.positions - file.positions).max()) > 1e-6
    ):
        return "it plays other numbers"
    return ""


def chain(file: File, workspace: Workspace, result: ConversionResult) -> tuple[str, bool]:
    """Apply the first fix of each refusal; return what stops it short of MATLAB, and the success.

    A chain ends accepted, or at what MATLAB alone mends, not in a circle.
    """
    options, seen = Options(), set()
    for _ in range(MOST_STEPS):
        if result.outcome is Outcome.ACCEPTED:
            return "", True
        worst = result.diagnostics[0]
        fix = next((f for f in worst.fixes if f.option), None)
        if fix is None:
            by_hand = any(f.matlab for f in worst.fixes)
            return "" if by_hand else f"{worst.code} carries no fix", False
        if (worst.code, fix) in seen:
            return f"{fix} does not mend {worst.code}", False
        seen.add((worst.code, fix))
        options = corpus.applied(options, fix)
        result = convert(
            file.name, lambda: workspace, options, corpus.model(file.robot), COEFFICIENTS
        )
    return "more than six problems", False


@pytest.mark.parametrize(
    ("files", "least", "least_mended"),
    [(corpus.build, 339, 24), (corpus.held_out, 168, 20), (third.build, 45, 5)],
)
def test_every_file_is_judged_right_and_its_fixes_lead_on(files, least, least_mended, reader):
    faults, mended = {}, 0
    made = files()
    assert len(made) >= least
    for file in made:
        name = file.name + file.suffix
        read: list[Workspace] = []

        def workspace(file=file, name=name, read=read) -> Workspace:
            read.append(reader.read_bytes(file.data, name))
            return read[0]

        result = convert(name, workspace, Options(), corpus.model(file.robot), COEFFICIENTS)
        found = fault(file, result)
        if found:
            faults[file.name] = f"{found}: {result.message}"
        if result.outcome is not Outcome.ACCEPTED:
            assert result.diagnostics[0].fixes, f"{file.name}: nothing to mend it with"
            stuck, accepted = chain(file, read[0], result) if read else ("", False)
            mended += accepted
            if stuck:
                faults[file.name] = stuck
    assert not faults
    assert mended >= least_mended, mended
