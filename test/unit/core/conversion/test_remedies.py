"""Advice leads on: parts of parts, options that do not fit, names and times that mislead."""

import converter_corpus as corpus
import numpy as np
import pytest
from fakes import make_model
from refusals import said_in

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.core.conversion import convert as conversion_convert
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.evidence import joining
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY, Variable, Workspace

COEFFICIENTS = load_coefficients(corpus.ROOT / "config" / "torque_proxy.yaml")
ARM = make_model(6)  # 6 joints, -3 to 3 rad, 2 rad/s
ROWS = 300
Q = corpus.law(ROWS)[:, None] * np.array([1, -0.6, 0.8, 0.7, 0.5, 0.9]) * 0.8 - 0.2
T = np.arange(ROWS) / 50.0


def var(path, values, **facts):
    values = np.asarray(values, dtype=facts.pop("dtype", float))
    values = values[:, None] if values.ndim == 1 else np.atleast_2d(values)
    kind = "single" if values.dtype == np.float32 else "double"
    return Variable(path, kind, values.shape, values, **facts)


def convert(*variables, robot=ARM, confirm=None, **options):
    workspace = Workspace("fake", variables, 0, "0" * 64, confirm)
    return conversion_convert.convert(
        "traj.mat", lambda: workspace, Options(**options), robot, COEFFICIENTS, created_ns=1
    )


def codes(result):
    return [d.code for d in result.diagnostics]


def first_fix(result):
    fix = next(f for f in result.diagnostics[0].fixes if f.option)
    return fix.option, fix.value


def test_two_jumps_are_left_by_the_longest_part_between_them():
    q = Q.copy()
    q[:20] -= 0.9
    q[150:] += 0.9
    result = convert(var("q", q))
    assert codes(result)[0] == "discontinuity"
    assert first_fix(result) == ("variable", "q(151:300, :)")
    offered = [f.value for f in result.diagnostics[0].fixes]
    assert offered == ["q(151:300, :)", "q(21:150, :)", "q(1:20, :)"]
    for part in offered:
        assert convert(var("q", q), variable=part).outcome is Outcome.ACCEPTED


@pytest.mark.parametrize("name", ["q", "arm_motion"])
def test_the_rate_that_is_advised_once_ends_what_is_too_fast_in_any_joint(name):
    fast = var(name, Q), var("fs", [1000.0])
    too_fast = [d for d in convert(*fast).diagnostics if d.code == "velocity_limit"]
    assert len({d.joint for d in too_fast}) > 2
    (fix,) = {d.fixes for d in too_fast}
    assert fix[0].option == "frame_rate"
    rate = float(fix[0].value)
    for mended in (convert(*fast, frame_rate=rate), convert(var("q", Q), var("fs", [rate]))):
        assert mended.outcome is Outcome.ACCEPTED
        assert "velocity_limit" not in codes(mended)
    saved = f"fs = {rate:g}; save('traj.mat', 'q', 'fs', '-v7')"
    assert fix[0].matlab == (saved if name == "q" else f"q = {name}; {saved}")
    (times,) = {d.values["times"] for d in too_fast}
    slow = convert(var("q", Q), var("t", T * 50.0 / 1000.0 * times), resample=True)
    assert "velocity_limit" not in codes(slow)


def test_no_rate_is_advised_where_points_keep_their_times():
    fast = var("q", Q), var("t", T * 50.0 / 1000.0)
    too_fast = [d for d in convert(*fast, resample=True).diagnostics if d.code == "velocity_limit"]
    assert too_fast
    assert not any(d.fixes or "slower" in d.values for d in too_fast)


def test_a_part_of_a_part_is_written_as_a_part_of_the_matrix():
    assert joining.rows_of("q", 2, 9) == "q(2:9, :)"
    assert joining.rows_of("q(151:300, :)", 2, 150) == "q(152:300, :)"
    assert joining.rows_of("q(101:2:300, 1:6)", 1, 50) == "q(101:2:199, 1:6)"
    assert joining.rows_of("q(:, 2:7)", 3, 4) == "q(3:4, 2:7)"
    q = Q.copy()
    q[160:] += 0.9
    result = convert(var("q", q), variable="q(151:300, :)")
    assert first_fix(result) == ("variable", "q(161:300, :)")
    taken = convert(var("q", Q), variable="q(151:300, :)(2:150, :)").trajectory
    np.testing.assert_array_equal(taken.positions, Q[151:])


def test_pieces_of_a_joined_part_are_read_again():
    asked = []
    pieces = [var(f"q{i + 1}", Q[:, i]) for i in range(6)]
    part = "q1..q6(1:200, :)"
    result = convert(*pieces, join="q1..q6", variable=part, confirm=asked.extend)
    assert result.trajectory.frame_count == 200
    assert asked == [f"q{i + 1}" for i in range(6)]


@pytest.mark.parametrize("part", ["q(302:400,:)", "q(0:9,:)", "q(:,2:7)", "q(5:4,:)", "q(a,:)"])
def test_a_part_outside_the_matrix_names_its_rows_and_columns(part):
    worst = convert(var("q", Q), variable=part).diagnostics[0]
    assert (worst.code, worst.fixes[0].option, worst.fixes[0].value) == (
        "bad_part",
        "variable",
        "q",
    )
    axis = {values.get("axis") for values in said_in(worst).values()} - {None}
    assert axis == {"column" if part == "q(:,2:7)" else "row"}


@pytest.mark.parametrize("column", ["9", "3", "end", "0"])
def test_a_gripper_that_is_no_column_to_spare_says_so(column):
    result = convert(var("q", Q), gripper=column)
    assert codes(result)[0] == "bad_option"
    assert result.diagnostics[0].values["option"] == "gripper"
    assert first_fix(result) == ("gripper", "")


@pytest.mark.parametrize("options", [{}, {"join": "q1..q6"}])
def test_joints_of_different_length_are_named(options):
    pieces = [var(f"q{i + 1}", Q[: ROWS - 20 * (i == 3), i]) for i in range(6)]
    worst = convert(*pieces, **options).diagnostics[0]
    assert worst.code == "pieces_differ"
    assert (worst.values["usual"], worst.values["others"]) == (300, ["q4 (280)"])
    assert "q4(1:280)" in worst.fixes[0].matlab


def test_angles_of_an_orientation_that_wrap_are_doubted_once_unwrapped():
    x = np.linspace(0.3, 0.6, ROWS)
    roll = np.where(np.arange(ROWS) % 7 < 3, np.pi - 1e-3, 1e-3 - np.pi)
    pose = np.column_stack([x, 0.1 * np.sin(9 * x), 0 * x + 0.4, roll, 0 * x, 0.3 * np.cos(5 * x)])
    arm = corpus.model("ur5e")
    assert codes(convert(var("q", pose), robot=arm))[0] == "jump_2pi"
    unwrapped = convert(var("q", pose), robot=arm, unwrap=True)
    doubted = [w for w in unwrapped.diagnostics if w.code == "doubtful_values"]
    assert any(said_in(w).get("pose_hint") == {"hint": "wraps"} for w in doubted)


def test_the_columns_that_are_advised_are_the_ones_that_were_found():
    worst = convert(var("q", np.column_stack([T, Q, 0 * T, Q]))).diagnostics[0]
    text = worst.fixes[0].value
    assert worst.code == "wrong_shape"
    assert worst.values["columns"] == text


@pytest.mark.parametrize(("blocks", "columns"), [("tqd", "2:7"), ("qd", "1:6"), ("qda", "1:6")])
def test_a_matrix_of_states_is_told_its_columns(blocks, columns):
    d = np.gradient(Q, axis=0) * 50
    parts = {"t": T, "q": Q, "d": d, "a": np.gradient(d, axis=0) * 50}
    state = var("X", np.column_stack([parts[b] for b in blocks]))
    result = convert(state)
    assert codes(result)[0] == "wrong_shape"
    assert first_fix(result) == ("columns", columns)
    mended = convert(state, columns=columns)
    assert mended.outcome is Outcome.ACCEPTED
    np.testing.assert_array_equal(mended.trajectory.positions, Q)
    assert [w.code for w in mended.trajectory.warnings] == ["doubtful_name"]


@pytest.mark.parametrize("names", [("q", "q_copy"), ("q", "Q"), ("q", "q_copy", "q_copy2")])
def test_equal_matrices_are_one(names):
    result = convert(*(var(name, Q.copy()) for name in names))
    assert result.trajectory.source.variable == names[0]
    assert "copies" in codes(result)
    assert not result.trajectory.warnings


@pytest.mark.parametrize("unit", ["rad_s", "rad/s", "deg_s", "rad_per_s", "rad_s2", "Nm"])
def test_a_unit_at_the_end_of_a_name_says_what_it_is(unit):
    headings = tuple(f"q{i + 1}_{unit}" for i in range(6))
    assert convert(var("q", Q, columns=headings)).trajectory is None


@pytest.mark.parametrize("container", ["emg", "filter"])
def test_the_rate_of_other_data_does_not_decide(container):
    result = convert(var("q", Q), var(f"{container}.fs", [2000.0]))
    assert result.trajectory.frame_rate == 100.0
    found = next(d for d in result.diagnostics if d.code == "rate_unclear")
    assert [f.value for f in found.fixes] == ["100", "2000"]


def test_columns_of_velocities_in_a_timetable_are_no_class_to_convert():
    table = Variable("TT", "timetable", (ROWS, 6))
    column = var("TT{:,:}", Q, columns=tuple(f"dq{i + 1}" for i in range(6)))
    result = convert(table, column)
    assert codes(result)[0] == "no_trajectory"
    assert result.diagnostics[0].fixes[0].matlab == "plot(TT{:,:})"


@pytest.mark.parametrize("rate", [30.0, 60.0, 125.0, 250.0])
def test_times_rounded_to_10_ms_are_even(rate):
    t = np.round(np.arange(ROWS) / rate, 2)
    result = convert(var("q", Q / 4), var("t", t))
    assert result.trajectory.frame_rate == rate
    assert "time_rounded" in codes(result)
    assert "time_uneven" not in codes(result)
    beside = convert(var("q", np.column_stack([t, Q[:, :5]]))).diagnostics[0]
    if rate < 100:
        assert beside.code == "time_column"
    else:
        assert "may_be_time" in said_in(beside)


def test_uneven_times_in_whole_units_are_not_taken_as_rounded():
    t = np.cumsum(np.where(np.arange(ROWS) % 2, 0.01, 0.03))
    assert "time_uneven" in codes(convert(var("q", Q), var("t", t)))
    rng = np.random.default_rng(7)
    t = np.cumsum(rng.integers(1, 5, ROWS)) * 0.01
    assert "time_uneven" in codes(convert(var("q", Q), var("t", t)))


@pytest.mark.parametrize(("name", "unit"), [("t_min", 60.0), ("zeit_min", 60.0), ("t_h", 3600.0)])
def test_minutes_and_hours_are_taken_with_a_warning(name, unit):
    result = convert(var("q", Q), var(name, T / unit))
    assert result.trajectory.frame_rate == pytest.approx(50.0)
    assert "time_unit" in codes(result)


def test_times_that_single_precision_cannot_hold_are_named():
    stamps = var("t", (1.7e9 + T), dtype=np.float32)
    found = next(d for d in convert(var("q", Q), stamps).diagnostics if d.code == "rate_unused")
    assert "coarse_times" in said_in(found)


def test_times_as_text_are_named_with_what_reads_them():
    text = Variable("t", "string", (ROWS, 1))
    found = next(d for d in convert(var("q", Q), text).diagnostics if d.code == "rate_unused")
    assert "times_of_class" in said_in(found)
    assert found.fixes[-1].matlab == "t = str2double(string(t))"


def test_waypoints_become_a_motion_once_their_times_are_known():
    points = Q[:: ROWS // 7]
    alone = convert(var("q", points))
    assert "waypoints" in codes(alone)
    refused = convert(var("q", points), resample=True)
    assert codes(refused)[0] == "no_times"
    assert "t = 2 *" in refused.diagnostics[0].fixes[0].matlab
    for beside in (var("t", 2.0 * np.arange(len(points))), var("dt", [2.0])):
        even = convert(var("q", points), beside, resample=True)
        assert even.trajectory.frame_rate == 100.0
        assert even.trajectory.duration == pytest.approx(2.0 * (len(points) - 1))
        assert "waypoints" not in codes(even)


def test_waypoints_at_a_rate_that_was_asked_for_are_named_too():
    assert "waypoints" in codes(convert(var("q", Q[::40]), frame_rate=1.0))


def test_pieces_that_were_not_all_listed_are_not_joined_by_an_option():
    pieces = tuple(var(f"c{{{i + 1}}}", Q[i]) for i in range(ROWS))
    workspace = Workspace("fake", pieces, 40, "0" * 64)
    result = conversion_convert.convert(
        "traj.mat", lambda: workspace, Options(), ARM, COEFFICIENTS, created_ns=1
    )
    worst = result.diagnostics[0]
    assert worst.code == "inside_container"
    assert worst.values["more"] == 40
    assert [f.option for f in worst.fixes] == [""]


def followed(variables, **options):
    """Follow first fixes; return what was followed, and the result."""
    steps = []
    result = convert(*variables, **options)
    while result.outcome is not Outcome.ACCEPTED and len(steps) < 3:
        fixes = [f for f in result.diagnostics[0].fixes if f.option]
        if not fixes:
            break
        value = True if fixes[0].value == "true" else fixes[0].value
        options |= {fixes[0].option: value}
        steps.append((fixes[0].option, fixes[0].value))
        result = convert(*variables, **options)
    return steps, result


def test_a_factor_of_the_file_says_the_unit_before_the_range_does():
    steps, result = followed([var("q", 1000 * Q), var("scale", [0.001])])
    assert steps == [("units", "mrad")]
    np.testing.assert_allclose(result.trajectory.positions, Q, atol=1e-12)
    assert convert(var("q", 1000 * Q)).diagnostics[0].fixes[0].matlab == "plot(q)"


def test_angles_of_motors_are_divided_by_their_gears_and_not_taken_as_degrees():
    result = convert(var("q", 40 * Q), var("gear_ratio", [40.0]))
    assert [(f.option, f.matlab) for f in result.diagnostics[0].fixes] == [
        ("", "q = q ./ gear_ratio(:).';")
    ]


def test_a_unit_that_was_not_understood_is_advised_where_its_words_name_it():
    for words, expected in (("deg/角度", [("units", "deg")]), ("ells", [])):
        unit = Variable("unit", "char", (1, len(words)), text=words)
        assert followed([var("q", np.degrees(Q)), unit])[0] == expected


def test_zeros_at_both_ends_are_left_out_in_two_steps():
    zeros = np.zeros((9, 6))
    steps, result = followed([var("q", np.vstack([zeros, Q, zeros]))])
    assert steps == [("variable", "q(1:309, :)"), ("variable", "q(10:309, :)")]
    assert "rows_left_out" not in codes(result)
    steps, result = followed([var("q", np.vstack([Q, zeros]).T)])
    assert steps == [("transpose", "true"), ("variable", "q(:, 1:300)")]
    assert result.trajectory.frame_count == ROWS


def test_a_part_of_a_motion_says_what_it_leaves_out():
    found = convert(var("q", Q), variable="q(1:200, :)").diagnostics
    lost = next(d for d in found if d.code == "rows_left_out")
    assert (lost.values["count"], lost.values["rows"]) == (100, ROWS)


def test_a_gripper_among_the_joints_is_named_by_its_column():
    states = (np.arange(ROWS) > 150).astype(float)
    matrix = np.column_stack([Q[:, :3], states, Q[:, 3:]])
    result = convert(var("q", matrix))
    fix = result.diagnostics[0].fixes[0]
    assert fix.matlab == "q = [q(:, [1 2 3 5 6 7]) q(:, 4)];"
    assert first_fix(result) == ("gripper", "4")


def test_a_full_turn_between_few_rows_is_unwrapped():
    q = Q[::25].copy()
    q[5:, 4] += 2 * np.pi
    steps, result = followed([var("q", q), var("fs", [2.0])])
    assert steps == [("unwrap", "true")]
    np.testing.assert_allclose(result.trajectory.positions, Q[::25], atol=1e-12)


def test_a_file_of_python_gets_no_lines_of_matlab():
    workspace = Workspace("NumPy npz", (var("q", 1000 * Q), var("scale", [0.001])), 0, "0" * 64)
    for file, has_lines in (("traj.npz", False), ("traj.mat", True)):
        result = conversion_convert.convert(
            file, lambda: workspace, Options(), ARM, COEFFICIENTS, created_ns=1
        )
        fixes = result.diagnostics[0].fixes
        assert [(f.option, f.value, bool(f.matlab)) for f in fixes] == [
            ("units", "mrad", has_lines)
        ]


def message(positions):
    times = np.arange(len(positions)) / 40.0  # not the default rate: frames are made between them
    points = Variable("/jt", JOINT_TRAJECTORY, positions.shape, positions, columns=ARM.joint_names)
    return points, var("/jt.time_from_start", times)


def test_points_of_a_message_are_checked_before_lines_join_them():
    turned = Q.copy()
    turned[150:, 5] += 2 * np.pi
    assert followed(message(turned))[0] == [("unwrap", "true")]
    random = np.random.default_rng(3).uniform(-2, 2, Q.shape)
    assert codes(convert(*message(random)))[0] == "no_motion"


def test_a_topic_that_is_not_there_offers_the_topics_alone():
    result = convert(*message(Q), variable="/nope")
    assert [f.value for f in result.diagnostics[0].fixes] == ["/jt"]
