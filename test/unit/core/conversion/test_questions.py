"""Every refusal carries what mends it: applied, the file is accepted or has another problem."""

from dataclasses import replace

import converter_corpus as corpus
import numpy as np
import pytest
from fakes import make_model
from refusals import said_in

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import convert as conversion_convert
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import Variable, Workspace

COEFFICIENTS = load_coefficients(corpus.ROOT / "config" / "torque_proxy.yaml")
ARM = make_model(6)  # 6 joints, -3 to 3 rad, 2 rad/s


def var(path, values):
    values = np.asarray(values, dtype=float)
    values = values[:, None] if values.ndim == 1 else np.atleast_2d(values)
    return Variable(path, "double", values.shape, values)


def motion(rows=300, joints=6, reach=1.0):
    return reach * corpus.law(rows)[:, None] * np.linspace(0.2, 1.0, joints) - 0.3


def convert(*variables, robot=ARM, file="traj.mat", **options):
    workspace = Workspace("fake", variables, 0, "0" * 64)
    return conversion_convert.convert(
        file, lambda: workspace, Options(**options), robot, COEFFICIENTS, created_ns=1
    )


def codes(result):
    return [d.code for d in result.diagnostics]


Q = motion()
T = np.arange(300) / 50.0


@pytest.mark.parametrize(
    "variables",
    [
        [var("q", Q.T)],
        [var("q", np.column_stack([T, Q]))],
        [var("q", np.column_stack([Q[:, :2], T, Q[:, 2:]]))],
        [var("q", np.vstack([T, Q.T]))],
        [var(f"q{i + 1}", Q[:, i]) for i in range(6)],
        [var(f"s(1).j{i + 1}", Q[:, i]) for i in range(6)],
    ],
)
def test_joints_are_read_as_they_lie(variables):
    result = convert(*variables)
    assert result.outcome is Outcome.ACCEPTED, result.message
    assert "layout_read" in [d.code for d in result.diagnostics]
    np.testing.assert_allclose(result.trajectory.positions, Q, atol=1e-12)


@pytest.mark.parametrize(
    "variables",
    [
        # a gripper that closes evenly, or time; velocities; pieces of something else
        [var("q", np.column_stack([Q, np.linspace(0, 1, len(Q))]))],
        [var("velocities", Q.T)],
        [var(f"m{i + 1}", Q[:, i]) for i in range(6)],
    ],
)
def test_no_layout_is_taken_that_a_person_may_mean_otherwise(variables):
    assert convert(*variables).trajectory is None


@pytest.mark.parametrize(
    ("variables", "options", "fix"),
    [
        ([var("q", np.degrees(Q))], {}, ("units", "deg")),
        ([var("q", np.degrees(Q) * 100)], {}, ("units", "counts:36000")),
        ([var("q", np.vstack([Q, np.zeros((9, 6))]))], {}, ("variable", "q(1:300, :)")),
        ([var("q", np.vstack([Q, np.full((9, 6), np.nan)]))], {}, ("variable", "q(1:300, :)")),
        ([var("qd", Q)], {}, ("variable", "qd")),
        ([var("A", np.full((300, 6), np.nan)), var("B", Q)], {}, ("variable", "B")),
        ([var("q1", Q), var("q2", Q + 0.5)], {}, ("variable", "q1")),
        ([var("q", Q)], {"frame_rate": 1e-9}, ("frame_rate", "0")),
        ([var("q", Q)], {"columns": "2:7"}, ("columns", "")),
        ([var("q", Q)], {"units": "ells"}, ("units", "")),
        ([var("q", Q)], {"join": "q1..q6"}, None),
        ([var("Q", Q)], {"variable": "q"}, ("variable", "Q")),
    ],
)
def test_the_first_fix_is_data(variables, options, fix):
    result = convert(*variables, **options)
    assert result.trajectory is None
    worst = result.diagnostics[0]
    if fix is None:
        assert worst.code == "unknown_variable"
        return
    assert (worst.fixes[0].option, worst.fixes[0].value) == fix
    mended = convert(*variables, **vars(corpus.applied(Options(**options), worst.fixes[0])))
    assert mended.outcome is Outcome.ACCEPTED, mended.message
    np.testing.assert_allclose(mended.trajectory.positions, Q, atol=2e-4)


def test_a_full_turn_is_named_before_the_limit_it_breaks():
    q = motion(reach=1.5)
    q[150:, 2] -= 2 * np.pi
    result = convert(var("q", q))
    assert codes(result)[:2] == ["jump_2pi", "joint_limit"]
    worst = result.diagnostics[0]
    assert (worst.first_row, worst.last_row, worst.joint) == (150, 151, "joint_3")
    assert worst.fixes[0].option == "unwrap"


def test_a_limit_is_data():
    found = convert(var("q", motion(reach=3.5))).diagnostics[0]
    assert (found.code, found.joint, found.limit, found.unit) == (
        "joint_limit",
        "joint_6",
        3.0,
        "rad",
    )
    assert found.value == pytest.approx(3.2)
    assert 1 < found.first_row < found.last_row == 300


def test_a_jump_offers_the_longer_part():
    q = motion()
    q[100:] += 0.9
    worst = convert(var("q", q)).diagnostics[0]
    assert worst.code == "discontinuity"
    assert worst.fixes[0].value == "q(101:300, :)"
    part = convert(var("q", q), variable="q(101:300, :)")
    np.testing.assert_array_equal(part.trajectory.positions, q[100:])


@pytest.mark.parametrize("across", [False, True])
def test_rows_that_stray_are_left_out_and_nothing_else(across):
    q = motion()
    q[89:92, 2] += 0.9
    q[200] -= 2.0
    stored = var("q", q.T if across else q)
    refused = convert(stored, transpose=across)
    assert {d.code for d in refused.diagnostics if d.severity is Severity.ERROR} == {"stray_rows"}
    elbow = next(d for d in refused.diagnostics if d.joint == ARM.joints[2].name)
    assert (elbow.first_row, elbow.last_row) == (201, 201)
    path = elbow.fixes[0].value
    assert path == ("q(:, [1:89 93:200 202:300])" if across else "q([1:89 93:200 202:300], :)")
    part = convert(stored, variable=path, transpose=across)
    rows = [*range(89, 92), 200]
    np.testing.assert_array_equal(part.trajectory.positions, np.delete(motion(), rows, axis=0))


def test_a_jump_that_another_one_does_not_end_is_no_stray_row():
    q = motion()
    q[89] += 0.9
    q[90:] += 1.8
    assert codes(convert(var("q", q)))[0] == "discontinuity"


def test_a_jump_of_a_joint_that_stands_still_says_so():
    q = np.zeros((200, 6)) + 0.1
    q[100:, 1] += 0.9
    worst = convert(var("q", q)).diagnostics[0]
    assert worst.code == "discontinuity"
    assert worst.values["usual"] == 0.0


def test_uneven_times_are_made_even_on_request():
    rng = np.random.default_rng(4)
    t = np.cumsum(rng.uniform(0.01, 0.03, 300))
    q = np.sin(t)[:, None] * np.linspace(0.2, 1, 6)
    plain = convert(var("q", q), var("t", t))
    found = next(d for d in plain.diagnostics if d.code == "time_uneven")
    assert found.severity is Severity.WARNING
    assert (found.variable, found.unit, found.fixes[0].option) == ("t", "s", "resample")
    even = convert(var("q", q), var("t", t), resample=True).trajectory
    at = t[0] + np.arange(even.frame_count - 1) / even.frame_rate
    truth = np.sin(at)[:, None] * np.linspace(0.2, 1, 6)
    assert np.abs(even.positions[:-1] - truth).max() < 2e-4
    faster = convert(var("q", q), var("t", t), resample=True, frame_rate=200.0).trajectory
    assert faster.frame_rate == 200.0
    assert faster.duration == pytest.approx(t[-1] - t[0], abs=0.005)


def test_times_that_repeat_or_go_back_are_named_with_their_row():
    t = np.arange(300) / 50.0
    twice = t.copy()
    twice[99] = twice[98]
    found = next(
        d for d in convert(var("q", Q), var("t", twice)).diagnostics if d.code == "time_repeated"
    )
    assert found.first_row == 100
    assert convert(var("q", Q), var("t", twice), resample=True).outcome is Outcome.ACCEPTED
    back = t.copy()
    back[200:] -= 1
    found = next(
        d for d in convert(var("q", Q), var("t", back)).diagnostics if d.code == "time_backward"
    )
    assert found.first_row == 201
    refused = convert(var("q", Q), var("t", back), resample=True)
    assert (refused.outcome, codes(refused)[0]) == (Outcome.REJECTED, "time_backward")


def test_without_times_nothing_is_resampled():
    assert codes(convert(var("q", Q), resample=True))[0] == "no_times"


CLOSED = (np.arange(300) > 100) & (np.arange(300) < 200)


@pytest.mark.parametrize(
    ("variables", "options"),
    [
        ([var("q", np.column_stack([Q, CLOSED]))], {}),
        ([var("q", np.column_stack([CLOSED, Q]))], {"gripper": "1"}),
        ([var("q", np.column_stack([Q, CLOSED]))], {"gripper": "end"}),
        ([var("q", np.column_stack([T, Q, CLOSED]))], {"columns": "2:7", "gripper": "8"}),
        ([var("q", Q), var("hand", CLOSED)], {"gripper": "hand"}),
        ([var("q", np.column_stack([Q, 0.085 * ~CLOSED]))], {"invert": True}),
        ([var("q", np.column_stack([Q, 255.0 * CLOSED]))], {}),
    ],
)
def test_the_gripper_is_where_an_option_says(variables, options):
    t = convert(*variables, **options).trajectory
    np.testing.assert_array_equal(t.positions, Q)
    np.testing.assert_array_equal(t.gripper, CLOSED)


def test_a_gripper_can_be_left_out():
    t = convert(var("q", np.column_stack([Q, CLOSED])), gripper="none").trajectory
    assert t.gripper is None


def test_an_opening_width_is_named_and_its_fix_inverts_it():
    result = convert(var("q", np.column_stack([Q, 0.085 * ~CLOSED])))
    found = next(d for d in result.diagnostics if d.code == "gripper_range")
    assert found.values["meaning"] == "width_m"
    assert (found.fixes[0].option, found.fixes[0].value) == ("invert", "true")


def test_states_that_are_named_as_those_of_the_gripper_are_taken():
    result = convert(var("q", Q), var("Greifer", CLOSED))
    np.testing.assert_array_equal(result.trajectory.gripper, CLOSED == 1)
    assert not result.trajectory.warnings


def test_a_width_of_the_gripper_beside_is_mentioned():
    result = convert(var("q", Q), var("Greifer", 85 * CLOSED))
    found = next(d for d in result.diagnostics if d.code == "gripper_beside")
    assert (found.fixes[0].option, found.fixes[0].value) == ("gripper", "Greifer")


@pytest.mark.parametrize("text", ["q1..q6", "q1..6", "q1,q2,q3,q4,q5,q6", "[q1 q2 q3 q4 q5 q6]"])
def test_joints_are_joined_side_by_side(text):
    pieces = [var(f"q{i + 1}", Q[:, i]) for i in range(6)]
    result = convert(*pieces, var("t", T), join=text)
    np.testing.assert_array_equal(result.trajectory.positions, Q)
    assert result.trajectory.frame_rate == 50.0
    assert result.trajectory.source.variable == text


def test_segments_are_joined_below_one_another():
    pieces = [var(f"c{{{i + 1}}}", Q[100 * i : 100 * (i + 1)]) for i in range(3)]
    result = convert(*pieces)
    join = [f for f in result.diagnostics[0].fixes if f.option == "join"]
    assert [f.value for f in join] == ["c{1}..c{3}"]
    np.testing.assert_array_equal(convert(*pieces, join="c{1}..c{3}").trajectory.positions, Q)


@pytest.mark.parametrize("text", ["q1", "q6..q1", "q1..x", "q1..q9999999"])
def test_what_cannot_be_joined_is_refused(text):
    pieces = [var(f"q{i + 1}", Q[:, i]) for i in range(6)]
    assert convert(*pieces, join=text).outcome is Outcome.REJECTED


@pytest.mark.parametrize("units", ["deg", "counts:4096", "rad"])
def test_units_are_taken_as_they_are_named(units):
    scale = {"deg": 180 / np.pi, "counts:4096": 4096 / (2 * np.pi), "rad": 1.0}[units]
    result = convert(var("q", Q * scale), units=units)
    np.testing.assert_allclose(result.trajectory.positions, Q, atol=1e-12)


@pytest.mark.parametrize("options", [{"units": "counts:"}, {"units": "counts:0"}, {"units": "mm"}])
def test_units_that_cannot_be_are_refused(options):
    assert codes(convert(var("q", Q), **options))[0] == "bad_option"


def test_columns_that_are_not_there_are_the_reason_given():
    found = convert(var("q", Q), columns="2:7").diagnostics[0]
    assert found.code == "bad_columns"
    assert said_in(found)["index_out_of_range"] == {"axis": "column", "count": 6}


@pytest.mark.parametrize("name", ["\n", "../run", "a\nb@2"])
def test_a_name_that_cannot_be_spelled_is_refused(name):
    with pytest.raises(BadInput):
        conversion_convert.convert(
            "q.mat", lambda: None, Options(), ARM, COEFFICIENTS, trajectory_id=name
        )


@pytest.mark.parametrize(
    "words",
    [
        "columns are joint 6 down to joint 1",
        "Reihenfolge der Spalten: Achse 6 bis Achse 1",
        "Spalten: A6 bis A1",
        "ordre des colonnes : axe 6 à axe 1",
        "顺序: 6 5 4 3 2 1",
    ],
)
def test_an_order_in_words_is_obeyed_and_said(words):
    result = convert(var("q", Q[:, ::-1]), Variable("note", "char", text=words))
    assert "order_stated" in [d.code for d in result.diagnostics]
    np.testing.assert_array_equal(result.trajectory.positions, Q)


@pytest.mark.parametrize("words", ["angles en tours", "unit: rev", "手首から基部", "a1 <-> a6"])
def test_units_and_orders_in_a_text_are_never_passed_over(words):
    result = convert(var("q", Q / (2 * np.pi)), Variable("memo", "char", text=words))
    assert {"converted_unit", "text_unread"} & {d.code for d in result.diagnostics}


@pytest.mark.parametrize("words", ["robot with 6 joints, experiment 1", "joint 1 to joint 6"])
def test_other_numbers_of_joints_are_no_order(words):
    result = convert(var("q", Q), Variable("note", "char", text=words))
    np.testing.assert_array_equal(result.trajectory.positions, Q)


@pytest.mark.parametrize(
    ("numbers", "rate", "sure"),
    [
        ({"T_A": 0.02}, 50, True),
        ({"f_A": 50}, 50, True),
        ({"Abtastrate_kHz": 0.05}, 50, True),
        ({"samples_per_minute": 3000}, 50, True),
        ({"duree_totale": 299 / 50}, 50, False),
        ({"timestep": 0.002, "frame_skip": 10}, 50, False),
        ({"fs_original": 500, "downsample_factor": 10}, 50, False),
        ({"fs": 50, "downsample_factor": 10}, 50, False),
    ],
)
def test_numbers_beside_a_motion_say_its_rate(numbers, rate, sure):
    result = convert(var("q", Q), *(var(name, [n]) for name, n in numbers.items()))
    assert result.trajectory.frame_rate == pytest.approx(rate)
    assert sure is not any(d.code.startswith("rate_") for d in result.trajectory.warnings)


def test_a_number_in_unread_words_is_named_although_one_says_time():
    result = convert(var("q", Q), var("fs", [200]), var("jeder_n_te", [10]))
    assert "unused_beside" in [d.code for d in result.diagnostics]


def test_limits_beside_a_motion_are_harmless():
    limits = {"q_min": Q.min(0) - 1, "q_max": Q.max(0) + 1, "v_max": Q.max(0) * 0 + 3}
    result = convert(var("q", Q), *(var(name, [n]) for name, n in limits.items()))
    assert not result.trajectory.warnings


@pytest.mark.parametrize(
    ("file", "path", "words"),
    [
        ("left_ax7_pick.mat", "q", "ax7"),
        ("AX 7 L900.mat", "q", "ax7 l900"),
        ("traj.mat", "q_ax7", "ax7"),
        ("bx9_l900.mat", "q", ""),
        ("like_ax7_for_bx9.mat", "q", ""),
        ("run2_2024_maker.mat", "q", ""),
        ("traj.mat", "q", ""),
    ],
)
def test_a_name_that_means_another_robot_of_the_library_is_doubted(file, path, words):
    arm = replace(ARM, id="maker_bx9_l900_2", product="BX 9 L900-2", others=("maker_ax7_l900",))
    result = convert(var(path, Q), file=file, robot=arm)
    assert result.outcome is Outcome.ACCEPTED
    said = [d for d in result.diagnostics if d.code == "robot_stated"]
    assert [d.values["words"] for d in said] == ([words] if words else [])
    for doubt in said:
        assert doubt.severity is Severity.WARNING
        assert doubt.fixes[0].option == "variable"
        named = convert(var(path, Q), file=file, robot=arm, variable=doubt.fixes[0].value)
        assert "robot_stated" not in codes(named)
