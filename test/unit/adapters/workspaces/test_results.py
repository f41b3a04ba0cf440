"""The document of a conversion carries everything but the frames, and nothing else."""

from __future__ import annotations

import errno
import io
import json
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import results
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.trajectory.diagnostics import BAD_TRAJECTORY_NAME

SOURCES = Path(__file__).parents[4]
ROBOT = RobotLibrary(SOURCES / "robots").model("ur5e")
COEFFICIENTS = load_coefficients(SOURCES / "config" / "torque_proxy.yaml")
Q = (1 - np.cos(np.linspace(0, 3, 200)))[:, None] * np.linspace(0.1, 0.4, 6)


def run(name="", **matrices):
    found = tuple(Variable(path, "double", q.shape, q) for path, q in matrices.items())
    task = results.Task("f.mat", Options(), ROBOT, COEFFICIENTS, None, name, 5, 100.0)
    file = io.BytesIO()
    data = results.run(task, lambda: Workspace("v7", found, 0, "0" * 64), 1 << 30, file)
    return data, file.getvalue()


def test_an_accepted_file_has_its_head_and_its_trajectory(tmp_path):
    data, stored = run(q=Q)
    converted = results.parse(data)
    assert converted.result.outcome is Outcome.ACCEPTED
    assert converted.result.trajectory is None
    said = converted.said.values
    assert (converted.said.code, said["variable"], said["frames"]) == (
        "trajectory_taken",
        "q",
        200,
    )
    (tmp_path / "f.npz").write_bytes(stored)
    trajectory = npz_file.read(tmp_path / "f.npz")
    assert converted.head["id"] == trajectory.id == "f"
    np.testing.assert_array_equal(trajectory.positions, Q)


def test_candidates_previews_and_findings_come_back_as_they_were():
    data, stored = run(q1=Q, q2=Q / 2)
    converted = results.parse(data)
    assert (converted.head, stored) == (None, b"")
    assert converted.result.outcome is Outcome.AMBIGUOUS
    assert [c.path for c in converted.result.candidates] == ["q1", "q2"]
    first = converted.result.candidates[0]
    assert first.shape == (200, 6)
    assert first.preview.values.dtype == np.float32
    np.testing.assert_allclose(first.preview.values[-1], Q[-1], rtol=1e-6)
    assert first.sparkline()
    assert converted.said == converted.result.diagnostics[0]


def test_a_name_that_cannot_be_used_is_said_as_bad_input():
    data, _ = run(name="../evil", q=Q)
    with refused(BAD_TRAJECTORY_NAME, BadInput, name="../evil"):
        results.parse(data)


@pytest.mark.parametrize("change", [{"record": "Path"}, {"enum": "State"}, {"array": "AAA"}])
def test_a_document_of_something_else_is_an_error(change):
    document = json.loads(run(q=Q)[0])
    document["result"] = change
    with pytest.raises((LookupError, TypeError, ValueError)):
        results.parse(json.dumps(document).encode())


def test_a_fault_of_the_converter_refuses_the_one_file(monkeypatch):
    def fails(*_, **__):
        raise OverflowError("cannot convert float infinity to integer")

    monkeypatch.setattr(results, "convert", fails)
    data, stored = run(q=Q)
    assert stored == b""
    found = results.parse(data).result.diagnostics[0]
    assert found.code == "converter_failed"
    assert found.values["error"].startswith("OverflowError")


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (errno.ENOSPC, "no_room_for_trajectory"),
        (errno.EDQUOT, "no_room_for_trajectory"),
        (errno.EMFILE, "lab_failed_on_file"),
    ],
)
def test_a_failure_of_the_machine_is_no_fault_of_the_file(number, code):
    class Full(io.BytesIO):
        def write(self, _):
            raise OSError(number, "no")

    found = Workspace("v7", (Variable("q", "double", Q.shape, Q),), 0, "0" * 64)
    task = results.Task("f.mat", Options(), ROBOT, COEFFICIENTS, None, "", 5, 100.0)
    data = results.run(task, lambda: found, 1 << 30, Full())
    with pytest.raises(BadInput) as caught:
        results.parse(data)
    assert caught.value.diagnostic.code == code


def test_a_disk_that_is_full_at_the_last_byte_is_no_fault_of_the_file():
    found = Workspace("v7", (Variable("q", "double", Q.shape, Q),), 0, "0" * 64)
    task = results.Task("f.mat", Options(), ROBOT, COEFFICIENTS, None, "", 5, 100.0)
    # what is small waits in the buffer, and is refused when that is emptied
    with open("/dev/full", "wb", buffering=1 << 20) as file:
        data = results.run(task, lambda: found, 1 << 30, file)
    with pytest.raises(BadInput) as caught:
        results.parse(data)
    assert caught.value.diagnostic.code == "no_room_for_trajectory"
