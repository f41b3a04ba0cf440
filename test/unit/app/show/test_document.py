"""The document of a motion: what web/src/playback/motion.ts says, from good and refused files."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import orjson
import pytest

from mrlab_ros.app.show import document
from mrlab_ros.app.show.packed import packed, unpacked
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.conversion.candidates import Candidate, Preview
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.robots.model import ShownJoint, ShownRobot
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients, derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

WEB = Path(__file__).parents[4] / "web" / "src"
CONTRACT = WEB / "playback" / "motion.ts"
DIAGNOSTIC = WEB / "words" / "diagnostic.ts"
ROBOT = ShownRobot(
    "two",
    "",
    "<robot name='two'/>",
    (
        ShownJoint("a", "revolute", -1.0, 1.0, 2.0),
        ShownJoint("b", "continuous", None, None, 2.0),
    ),
)
LIMIT = Diagnostic(
    "joint_limit",
    Severity.ERROR,
    "a goes too far.",
    "Keep it below 1.",
    {
        "variable": "q",
        "where": "row 2",
        "first_row": 2,
        "last_row": 3,
        "joint": "a",
        "value": float("nan"),
        "limit": 1.0,
        "unit": "rad",
    },
    (Fix("degrees", "true", "q = deg2rad(q)"),),
)


def trajectory(rows=5, gripper=None):
    positions = np.linspace(0, 1, rows * 2).reshape(rows, 2)
    channels = derive(positions, 50.0, ProxyCoefficients((1.0,), (1.0,), (1.0,), (0.1,), 50.0))
    return Trajectory(
        "pick", "two", None, ("a", "b"), 50.0, positions, gripper, channels,
        Source("pick.mat", "q", "f" * 64), warnings=(LIMIT,),
    )  # fmt: skip


def fields_of(interface, contract=CONTRACT):
    """Return the names of the fields of an interface of the contract."""
    body = re.search(rf"interface {interface} \{{(.*?)\n\}}", contract.read_text(), re.S).group(1)
    return set(re.findall(r"^  readonly (\w+)[?]?:", body, re.M))


def test_the_fields_are_those_of_the_contract():
    found = document.motion(trajectory(), ROBOT, message="taken")
    assert set(found) == fields_of("MotionDocument")
    assert set(found["robot"]) == fields_of("MotionRobot")
    assert set(found["robot"]["joints"][0]) == fields_of("MotionJoint")
    assert set(found["findings"][0]) == fields_of("Diagnostic", DIAGNOSTIC)
    assert set(found["positions"]) == fields_of("PackedArray")
    assert found["schema"] in CONTRACT.read_text()


def test_an_accepted_trajectory_is_shown_whole():
    moved = trajectory(gripper=np.array([False, False, True, True, False]))
    found = orjson.loads(orjson.dumps(document.motion(moved, ROBOT, message="taken")))
    assert found["verdict"] == "accepted"
    assert found["times"] is None
    assert found["rows"] is None
    np.testing.assert_allclose(unpacked(found["positions"]), moved.positions, atol=1e-7)
    np.testing.assert_allclose(unpacked(found["velocities"]), moved.channels.velocities, rtol=1e-6)
    assert unpacked(found["gripper"]).tolist() == [0, 0, 1, 1, 0]
    assert found["source"] == {"file": "pick.mat", "variable": "q", "sha256": "f" * 64}


def test_a_long_trajectory_is_thinned_with_its_times_and_rows():
    moved = trajectory(rows=100)
    found = document.motion(moved, ROBOT, message="taken", most_frames=30)
    rows = unpacked(found["rows"])
    assert rows[0] == 1
    assert rows[-1] == 100
    assert len(rows) <= 31
    np.testing.assert_allclose(unpacked(found["times"]), (rows - 1) / 50)
    np.testing.assert_allclose(
        unpacked(found["positions"]), moved.positions[rows - 1], rtol=1e-6, atol=1e-7
    )


def refused(values, rows=(1, 5, 9), outcome=Outcome.REJECTED):
    shown = Preview("q", np.array(rows, np.uint32), np.array(values, np.float32))
    candidates = ()
    if outcome is Outcome.AMBIGUOUS:
        candidates = (Candidate("q", (9, 2), 0.9, "why", 0.0, 1.0, shown),)
    preview = shown if outcome is Outcome.REJECTED else None
    return ConversionResult("bad.mat", outcome, None, candidates, (LIMIT,), preview)


def test_a_refused_file_is_shown_by_its_preview():
    result = refused([[0, 1, 7], [np.nan, 2, 7], [5, 3, 7]])
    found = orjson.loads(orjson.dumps(document.of_result(replace(result, frame_rate=10.0), ROBOT)))
    assert found["verdict"] == "refused"
    assert unpacked(found["rows"]).tolist() == [1, 5, 9]
    assert unpacked(found["times"]).tolist() == [0, 0.4, 0.8]
    np.testing.assert_array_equal(unpacked(found["positions"]), [[0, 1], [np.nan, 2], [5, 3]])
    (shown,) = found["findings"]
    assert shown["value"] is None
    assert shown["limit"] == 1.0
    assert shown["fixes"][0].items() >= {"option": "degrees", "matlab": "q = deg2rad(q)"}.items()


@pytest.mark.parametrize(("option", "shown"), [("units", np.pi / 2), ("", 90.0)])
def test_a_file_in_degrees_is_drawn_in_degrees(option, shown):
    found = refused([[0, 90], [0, 45]], rows=(1, 2))
    degrees = replace(LIMIT, code="degrees", fixes=(Fix(option, "deg", "q = deg2rad(q);"),))
    made = document.of_result(replace(found, diagnostics=(degrees,)), ROBOT)
    assert unpacked(made["positions"])[0, 1] == pytest.approx(shown)


def test_an_ambiguous_file_is_shown_by_its_likeliest_candidate():
    result = refused([[0, 1], [1, 1], [2, 1]], outcome=Outcome.AMBIGUOUS)
    assert document.of_result(result, ROBOT)["verdict"] == "ambiguous"


@pytest.mark.parametrize(
    ("values", "rows"), [([[0.0], [1.0], [2.0]], (1, 5, 9)), ([[0, 1]], (1,))]
)
def test_a_matrix_that_is_no_motion_has_no_document(values, rows):
    assert document.of_result(refused(values, rows), ROBOT) is None


def test_a_result_without_preview_has_no_document():
    result = ConversionResult("bad.mat", Outcome.REJECTED, None, (), (LIMIT,))
    assert document.of_result(result, ROBOT) is None


@pytest.mark.parametrize("dtype", ["float32", "float64", "uint32", "uint8"])
def test_packed_arrays_come_back(dtype):
    values = np.arange(12).reshape(3, 4)[:, ::2]
    np.testing.assert_array_equal(unpacked(packed(values, dtype)), values)
