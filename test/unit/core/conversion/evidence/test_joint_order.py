"""What a file states beside a matrix: units, labels, names of joints."""

from pathlib import Path

import numpy as np
import pytest
from fakes import make_model

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.tables.text import parsed
from mrlab_ros.core.conversion import convert as conversion_convert
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import Variable, Workspace

COEFFICIENTS = load_coefficients(Path(__file__).parents[5] / "config" / "torque_proxy.yaml")
ARM = make_model(6)
U = np.linspace(0, 1, 300)[:, None]
Q = (10 * U**3 - 15 * U**4 + 6 * U**5) * np.linspace(0.2, 1.0, 6) - 0.3


def var(path, values, **more):
    return Variable(path, "double", values.shape, values, **more)


def text(path, words):
    return Variable(path, "char", (1, len(words)), text=words)


def convert(*variables, file_format="fake", **options):
    workspace = Workspace(file_format, variables, 0, "0" * 64)
    return conversion_convert.convert(
        "traj.mat", lambda: workspace, Options(**options), ARM, COEFFICIENTS, created_ns=1
    )


def accepted(*variables, **options):
    result = convert(*variables, **options)
    assert result.trajectory is not None, result.message
    return result.trajectory


def table(*headings, values=Q):
    return convert(var("q", values, columns=tuple(headings)), file_format="CSV")


def codes(result):
    return {d.code for d in result.diagnostics}


@pytest.mark.parametrize(
    "heading",
    [
        "q{} [rad/s]",
        "J{} (rad/s^2)",
        "J{} [deg/s]",
        "Joint{} (Nm)",
        "J{} (A)",
        "J{} [V]",
        "J{} [degC]",
        "A{} [1/min]",
        "J{} [rpm]",
        "J{} [U]",
        "Achse{} [Grad/s]",
        "Achse{} [mm]",
        "Achse{} Strom [A]",
        "J{} [rad/s²]",
    ],
)
def test_a_unit_in_the_headings_that_joints_do_not_have_is_refused(heading):
    result = table(*(heading.format(i + 1) for i in range(6)))
    assert result.outcome is Outcome.REJECTED


@pytest.mark.parametrize("heading", ["q{} [rad]", "A{} [°]", "J{} (2)", "Achse{} [Grad]", "q{}"])
def test_a_unit_in_the_headings_that_joints_have_is_not(heading):
    values = Q if "rad]" in heading or "[" not in heading else np.degrees(Q)
    if "(2)" in heading:
        values = Q
    result = table(*(heading.format(i + 1) for i in range(6)), values=values)
    assert "no_trajectory" not in codes(result)


@pytest.mark.parametrize("path", ["traj.units", "traj.unit", "traj.Einheit", "traj.Einheiten"])
@pytest.mark.parametrize("unit", ["degrees", "deg", "Grad", "°"])
def test_degrees_stated_beside_a_matrix_are_converted(path, unit):
    trajectory = accepted(var("traj.q", np.degrees(Q)), text(path, unit))
    np.testing.assert_allclose(trajectory.positions, Q, atol=1e-9)


def test_small_degrees_stated_beside_a_matrix_are_converted_with_a_warning():
    trajectory = accepted(var("traj.q", 2 * Q), text("traj.units", "degrees"))
    np.testing.assert_allclose(trajectory.positions, np.radians(2 * Q), atol=1e-9)
    assert "doubtful_values" in {w.code for w in trajectory.warnings}


def test_the_unit_of_another_struct_says_nothing():
    trajectory = accepted(var("traj.q", Q), text("cam.units", "deg"), text("traj.units", "rad"))
    np.testing.assert_array_equal(trajectory.positions, Q)


@pytest.mark.parametrize("label", ["joint velocity", "qd", "tau", "dq"])
def test_the_label_of_a_simulink_structure_counts(label):
    q = var("simout.signals.values", Q)
    assert convert(q, text("simout.signals.label", label)).outcome is not Outcome.ACCEPTED


def test_the_block_of_a_simulink_structure_counts():
    q = var("simout.signals.values", Q)
    spoken = text("simout.blockName", "model/Joint Velocity")
    assert convert(q, spoken).outcome is Outcome.REJECTED
    assert accepted(q, text("simout.blockName", "model/To Workspace")).frame_count == len(Q)


def signals(*labels):
    made = []
    for i, label in enumerate(labels):
        path = f"sc.signals({i + 1})"
        made += [var(f"{path}.values", Q[:, i : i + 1]), text(f"{path}.label", label)]
    return made


JOIN = "sc.signals(1).values..sc.signals(6).values"


def test_labels_of_joined_signals_count():
    trajectory = accepted(*signals(*(f"dq{i + 1}" for i in range(6))), join=JOIN)
    assert "doubtful_name" in {w.code for w in trajectory.warnings}


def test_joined_signals_are_put_in_the_order_of_their_labels():
    trajectory = accepted(*signals("q1", "q3", "q2", "q4", "q5", "q6"), join=JOIN)
    np.testing.assert_array_equal(trajectory.positions, Q[:, [0, 2, 1, 3, 4, 5]])


@pytest.mark.parametrize("form", ["q{}", "Achse {}", "J{} [rad]", "q_{}_ist"])
@pytest.mark.parametrize("order", [(1, 3, 2, 4, 5, 6), (6, 5, 4, 3, 2, 1)])
def test_headings_with_numbers_out_of_order_are_put_in_order(form, order):
    result = table(*(form.format(n) for n in order))
    assert result.trajectory is not None, result.message
    inverse = [order.index(n + 1) for n in range(6)]
    np.testing.assert_array_equal(result.trajectory.positions, Q[:, inverse])
    assert "joints_matched" in codes(result)


@pytest.mark.parametrize("form", ["position.{}", "{}_position", "/joint_states/{}/position"])
def test_joints_with_something_around_them_are_matched_by_name(form):
    order = (3, 1, 2, 4, 5, 6)
    result = table(*(form.format(f"joint_{n}") for n in order))
    assert result.trajectory is not None, result.message
    np.testing.assert_array_equal(result.trajectory.positions, Q[:, [1, 2, 0, 3, 4, 5]])


@pytest.mark.parametrize("form", ["velocity.{}", "{}_vel", "effort_{}"])
def test_other_quantities_of_joints_are_not_positions(form):
    for order in ((3, 1, 2, 4, 5, 6), (1, 2, 3, 4, 5, 6)):
        result = table(*(form.format(f"joint_{n}") for n in order))
        assert codes(result) == {"no_trajectory"}


def test_degrees_in_headings_out_of_order_are_converted():
    order = (2, 1, 3, 4, 5, 6)
    result = table(*(f"q{n} [deg]" for n in order), values=np.degrees(Q))
    assert result.trajectory is not None, result.message
    np.testing.assert_allclose(result.trajectory.positions, Q[:, [1, 0, 2, 3, 4, 5]], atol=1e-9)


def test_names_in_a_struct_beside_the_positions_put_them_in_order():
    names = [text(f"js.name{{{i + 1}}}", f"joint_{n}") for i, n in enumerate((3, 1, 2, 4, 5, 6))]
    trajectory = accepted(var("js.position", Q), *names)
    np.testing.assert_array_equal(trajectory.positions, Q[:, [1, 2, 0, 3, 4, 5]])


def test_columns_that_are_the_velocities_of_others_are_doubted():
    stack = np.hstack([Q, np.gradient(Q, 0.01, axis=0)])
    taken = accepted(var("q", stack), variable="q", columns="7:12")
    assert "doubtful_values" in {w.code for w in taken.warnings}
    taken = accepted(var("q", stack), variable="q", columns="1:6")
    assert "doubtful_values" not in {w.code for w in taken.warnings}


def test_columns_of_poses_are_doubted():
    turns = np.hstack([np.cos(U), np.sin(U), 0 * U, 0 * U])
    stack = np.hstack([Q[:, :3], turns])
    taken = accepted(var("traj", stack), variable="traj", columns="1:6")
    assert "doubtful_values" in {w.code for w in taken.warnings}


UNITS = ["rad", "rad", "rad", "deg", "deg", "deg"]


def test_each_column_is_taken_in_the_unit_of_its_heading():
    small = Q / 10
    mixed = np.column_stack([small[:, :3], np.degrees(small[:, 3:])])
    found = table(*(f"q{n + 1} [{unit}]" for n, unit in enumerate(UNITS)), values=mixed)
    assert found.trajectory is not None
    assert "units_differ" in codes(found)
    assert np.allclose(found.trajectory.positions, small)


def test_units_stay_with_their_columns_where_names_change_the_order():
    small = Q / 10
    mixed = np.column_stack([small[:, :3], np.degrees(small[:, 3:])])[:, ::-1]
    headings = [f"q{n} [{unit}]" for n, unit in zip(range(1, 7), UNITS, strict=True)]
    found = table(*headings[::-1], values=mixed)
    assert found.trajectory is not None
    assert "units_differ" in codes(found)
    assert np.allclose(found.trajectory.positions, small)


def test_columns_without_a_unit_beside_different_ones_are_asked_about():
    found = table("q1 [rad]", "q2 [deg]", "q3", "q4", "q5", "q6")
    assert codes(found) == {"unit_conflict"}


def test_a_unit_below_a_table_is_obeyed():
    body = "".join(",".join(f"{x:.6f}" for x in row) + "\n" for row in np.degrees(Q))
    read = parsed(("j1,j2,j3,j4,j5,j6\n" + body + "# unit: deg\n").encode())
    assert read.values.shape == Q.shape
    assert read.comments == ["unit: deg"]


@pytest.mark.parametrize("names", [("sec", "nanosec"), ("log.t_secs", "log.t_nsecs")])
def test_seconds_and_nanoseconds_are_one_time(names):
    ns = 20_000_000 * np.arange(len(Q))
    first, second = (n.reshape(-1, 1).astype(float) for n in np.divmod(ns, 1_000_000_000))
    path = "log.q" if "." in names[0] else "q"
    found = accepted(var(path, Q), var(names[0], first + 1.7e9), var(names[1], second))
    assert found.frame_rate == 50


def test_the_rate_of_a_camera_is_not_that_of_the_joints():
    found = convert(var("q", Q), var("camera_fps", np.array([[60.0]])))
    assert found.trajectory is not None
    assert found.trajectory.frame_rate == 100
    assert "rate_unclear" in codes(found)


@pytest.mark.parametrize("path", ["features.q.names", "meta.data.q.names"])
def test_names_in_a_struct_called_as_the_matrix_are_its_columns(path):
    names = [text(f"{path}{{{n}}}", f"j{7 - n}") for n in range(1, 7)]
    found = accepted(var("q", Q[:, ::-1]), *names)
    assert np.allclose(found.positions, Q)


@pytest.mark.parametrize(
    "headings",
    [
        ["q1", "q2", "q3", "q4", "q5", "temp"],
        ["q1", "q2", "q3", "q4", "q5", "q7"],
        ["q1", "q2", "q3", "q4", "q5", "q5"],
        ["q2", "q3", "q4", "q5", "q6", "q7"],
        ["q1", "q2", "q3", "dq1", "dq2", "dq3"],
    ],
)
def test_headings_that_number_other_joints_are_asked_about(headings):
    found = table(*headings)
    assert found.outcome is Outcome.AMBIGUOUS
    assert "names_other" in codes(found)
    assert accepted(var("q", Q, columns=tuple(headings)), variable="q").positions.shape == Q.shape


@pytest.mark.parametrize(
    "headings",
    [
        ["elbow", "shoulder", "base", "wrist_1", "wrist_2", "wrist_3"],
        ["Coude", "Épaule", "Base", "Poignet1", "Poignet2", "Poignet3"],
        ["codo", "hombro", "base", "muñeca 1", "muñeca 2", "muñeca 3"],
        ["Ellbogen", "Schulter", "Basis", "Handgelenk1", "Handgelenk2", "Handgelenk3"],
    ],
)
def test_places_in_the_arm_are_its_joints_in_several_languages(headings):
    found = table(*headings, values=Q[:, [2, 1, 0, 3, 4, 5]])
    assert found.trajectory is not None
    assert codes(found) == {"joints_matched", "rate_default"}
    assert np.allclose(found.trajectory.positions, Q)


@pytest.mark.parametrize("name", ["open", "ouvert", "gripper_cmd_raw"])
def test_states_of_a_gripper_that_say_open_are_named(name):
    found = convert(var("q", Q), var(name, (U > 0.5).astype(float)))
    assert found.trajectory.gripper is None
    assert "gripper_beside" in codes(found)
