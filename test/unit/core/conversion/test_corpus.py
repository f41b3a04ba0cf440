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

pytestmark = pytest.mark.slow

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


@pytest.mark.parametrize(
    ("files", "least"), [(corpus.build, 339), (corpus.held_out, 168), (third.build, 45)]
)
def test_every_file_is_judged_right(files, least, reader):
    faults = {}
    made = files()
    assert len(made) >= least
    for file in made:
        name = file.name + file.suffix
        result = convert(
            name,
            lambda file=file, name=name: reader.read_bytes(file.data, name),
            Options(),
            corpus.model(file.robot),
            COEFFICIENTS,
        )
        found = fault(file, result)
        if found:
            faults[file.name] = f"{found}: {result.message}"
        if result.outcome is not Outcome.ACCEPTED:
            assert result.diagnostics[0].fixes, f"{file.name}: nothing to mend it with"
    assert not faults
