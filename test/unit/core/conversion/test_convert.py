"""The use case: which matrix is taken, what is refused and why, what the options do."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import refusals
from fakes import make_model
from refusals import said_in

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.diagnostics import READERS_DISAGREE, UNREADABLE
from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import convert as conversion_convert
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome, id_from
from mrlab_ros.core.conversion.diagnostics import BAD_OPTION
from mrlab_ros.core.conversion.evidence import joining
from mrlab_ros.core.conversion.options import Options, parse_columns
from mrlab_ros.core.conversion.workspace import Variable, Workspace

COEFFICIENTS = load_coefficients(Path(__file__).parents[4] / "config" / "torque_proxy.yaml")
ARM = make_model(6)  # 6 joints, -3 to 3 rad, 2 rad/s


def motion(rows=300, joints=6, reach=1.0):
    u = np.linspace(0, 1, rows)[:, None]
    s = 10 * u**3 - 15 * u**4 + 6 * u**5
    return reach * s * np.linspace(0.2, 1.0, joints) - 0.3


def var(path, values=None, kind="double", shape=None, **more):
    if values is None:
        return Variable(path, kind, shape or (1, 1), None, **more)
    values = np.atleast_2d(np.asarray(values))
    return Variable(path, kind, values.shape, values, **more)


def convert(*variables, robot=ARM, **options) -> ConversionResult:
    workspace = Workspace("fake", variables, 0, "0" * 64)
    result = conversion_convert.convert(
        "traj.mat", lambda: workspace, Options(**options), robot, COEFFICIENTS, created_ns=1
    )
    assert result.message
    return result


def accepted(*variables, **options):
    result = convert(*variables, **options)
    assert result.outcome is Outcome.ACCEPTED, result.message
    assert result.trajectory is not None
    return result.trajectory


def refused(*variables, **options) -> str:
    result = convert(*variables, **options)
    assert result.outcome is Outcome.REJECTED, result.message
    assert result.trajectory is None
    assert result.diagnostics[0].severity is Severity.ERROR
    return result.diagnostics[0].code


def offered(*variables, **options):
    result = convert(*variables, **options)
    assert result.outcome is Outcome.AMBIGUOUS, result.message
    assert result.diagnostics[0].code == "ambiguous"
    return [c.path for c in result.candidates]


def codes(result):
    return {d.code for d in result.diagnostics}


def test_the_plain_case():
    q = motion()
    t = accepted(var("q", q))
    np.testing.assert_array_equal(t.positions, q)
    assert (t.id, t.robot_model, t.frame_rate, t.gripper) == ("traj", "fake", 100.0, None)
    assert (t.source.file, t.source.variable) == ("traj.mat", "q")
    assert t.joint_names == ARM.joint_names
    assert t.warnings == ()


@pytest.mark.parametrize("joints", [1, 4, 6, 7, 9])
def test_any_number_of_joints(joints):
    robot = make_model(joints)
    assert accepted(var("q", motion(joints=joints)), robot=robot).positions.shape == (300, joints)
    with_gripper = np.column_stack([motion(joints=joints), np.arange(300) > 99])
    assert accepted(var("q", with_gripper), robot=robot).gripper.sum() == 200


@pytest.mark.parametrize(
    "path", ["s.q", "out.q.signals.values", "run(2).q", "c{3}", "TrajectoryData.theta"]
)
def test_the_matrix_is_found_inside_containers(path):
    assert accepted(var(path, motion())).source.variable == path


def test_the_usual_company_does_not_disturb():
    t = accepted(
        var("q", motion()),
        var("qd", motion()),
        var("qdd", motion()),
        var("tau", motion()),
        var("J", np.eye(6)),
        var("Kp", np.eye(6)),
        var("T", np.eye(4)),
        var("t", np.arange(300)[:, None] / 50),
        var("robot", kind="SerialLink", is_object=True),
        var("note", kind="char", shape=(1, 40)),
    )
    assert (t.source.variable, t.frame_rate) == ("q", 50.0)


def test_several_plausible_are_offered_likeliest_first():
    assert offered(var("q1", motion()), var("q2", motion() + 0.5)) == ["q1", "q2"]
    assert (
        accepted(var("q1", motion()), var("q2", -motion()), variable="q2").source.variable == "q2"
    )


@pytest.mark.parametrize("name", ["qd", "qobs"])
def test_a_doubtful_name_is_asked_about(name):
    assert offered(var(name, motion())) == [name]
    t = accepted(var(name, motion()), variable=name)
    assert [w.code for w in t.warnings] == ["doubtful_name"]


@pytest.mark.parametrize("name", ["qdd", "tau", "tcp_pose", "force", "s.qDot"])
def test_other_quantities_are_no_trajectory(name):
    assert refused(var(name, motion())) == "no_trajectory"


def test_unordered_rows_with_a_neutral_name_are_asked_about():
    data = np.random.default_rng(2).uniform(-1, 1, (200, 6))
    assert offered(var("A", data)) == ["A"]


def test_gains_beside_a_timeseries_are_not_published():
    series = var("q", kind="timeseries", shape=(), is_object=True)
    for name in ("K", "A", "gains"):
        result = convert(series, var(name, np.eye(6) * 2))
        assert result.outcome is Outcome.REJECTED
        worst = result.diagnostics[0]
        assert worst.code == "unsupported_object"
        assert worst.fixes[0].matlab == "q = q.Data; save('traj.mat', 'q', '-v7')"
        assert worst.values["objects"] == ["q (timeseries)"]
    # nor is a smooth matrix without a telling name taken for it
    assert convert(series, var("Y", motion())).outcome is not Outcome.ACCEPTED


@pytest.mark.parametrize(
    ("kind", "line"),
    [
        ("timeseries", "d.Data"),
        ("timetable", "d.Variables"),
        ("table", "d{:, :}"),
        ("Simulink.SimulationData.Dataset", "d{1}.Values.Data"),
    ],
)
def test_objects_come_with_the_line_that_saves_their_numbers(kind, line):
    result = convert(var("d", kind=kind, is_object=True))
    assert result.diagnostics[0].code == "unsupported_object"
    assert result.diagnostics[0].fixes[0].matlab == f"q = {line}; save('traj.mat', 'q', '-v7')"


def test_an_object_that_holds_no_samples_is_not_offered_as_one():
    box = var("obs", kind="Cuboid", is_object=True)
    corners = np.random.default_rng(3).uniform(-2, 2, (30, 6))
    result = convert(box, var("qobs", corners))
    assert result.diagnostics[0].code == "no_trajectory"
    held = result.diagnostics[0].values["held"]
    assert held == ["obs (1x1 Cuboid)", "qobs (30x6 double)"]


def test_objects_beside_a_clear_trajectory_are_mentioned():
    result = convert(var("q", motion()), var("robot", kind="rigidBodyTree", is_object=True))
    assert result.outcome is Outcome.ACCEPTED
    assert "object_ignored" in codes(result)


@pytest.mark.parametrize(
    ("variable", "code"),
    [
        (var("q", np.degrees(motion(reach=2.0))), "degrees"),
        (var("q", np.column_stack([motion(joints=7)])), "seven_axes"),
        (var("q", motion()[:1]), "single_sample"),
        (var("q", motion()[:1].T), "single_sample"),
        (var("q", shape=(0, 6)), "empty"),
        (var("q", shape=(0, 0)), "empty"),
        (var("q", motion(joints=5)), "wrong_shape"),
        (var("q", motion(joints=9)), "wrong_shape"),
        (var("q", np.arange(50)[:, None]), "wrong_shape"),
        (var("q", shape=(50, 6), note="complex"), "not_real"),
        (var("q", shape=(50, 6), kind="int16"), "wrong_class"),
        (var("q", shape=(50, 6), kind="logical"), "wrong_class"),
        (var("q", shape=(50, 6), kind="sparse"), "wrong_class"),
        (var("q", shape=(6, 1, 50)), "wrong_shape"),
        (var("q", np.where(motion() > 0.3, np.nan, motion())), "non_finite"),
        (var("q", motion(reach=4.0)), "joint_limit"),
        (var("time", np.arange(50)[None]), "no_trajectory"),
    ],
)
def test_refusals_name_their_reason(variable, code):
    assert refused(variable) == code
    # asked for by name, the reason is the same or more precise, never acceptance
    assert convert(variable, variable=variable.path).outcome is Outcome.REJECTED


def test_an_array_of_three_dimensions_is_taken_and_said():
    q = motion()
    result = convert(Variable("q", "double", (6, 1, 300), q.T[:, None]))
    assert result.trajectory is not None, result.message
    np.testing.assert_array_equal(result.trajectory.positions, q)
    said = next(d for d in result.diagnostics if d.code == "squeezed")
    assert said.severity is Severity.INFO
    assert (said.values["size"], said.values["taken"]) == ("6x1x300", "300x6")
    assert said.values["line"] == "q = squeeze(q).';"


def test_lines_of_matlab_for_an_array_begin_with_the_one_that_makes_the_matrix():
    wide = np.column_stack([motion(), motion()])
    result = convert(Variable("s.q", "double", (12, 1, 300), wide.T[:, None]))
    worst = result.diagnostics[0]
    assert worst.code == "wrong_shape"
    assert worst.fixes[0].matlab.startswith("q = squeeze(s.q).'; q = q(:, ")


def test_an_object_without_a_size_is_refused_by_its_name():
    closed = Variable("ts", "timeseries", (), is_object=True)
    assert refused(closed, variable="ts")


def test_transforms_alone_are_named():
    pages = np.tile(np.eye(4)[:, :, None], (1, 1, 50))
    result = convert(Variable("T", "double", pages.shape, pages))
    assert [d.code for d in result.diagnostics] == ["transforms"]


@pytest.mark.parametrize("label", ["joint angles", ""])
def test_degrees_that_the_file_names_are_converted(label):
    q = motion(reach=1.5)
    facts = {"label": label, "units": ("deg",)}
    result = convert(var("x.Data", np.degrees(q), **facts))
    assert result.trajectory is not None, result.message
    np.testing.assert_allclose(result.trajectory.positions, q, atol=1e-12)
    assert "converted_unit" in codes(result)
    assert bool(result.trajectory.warnings) is (not label)
    # what radians may reach as well is converted with a warning
    small = convert(var("q", motion(reach=1.5), units=("deg",)))
    assert "doubtful_values" in codes(small)


def test_samples_kept_one_by_one_come_with_the_line_that_joins_them():
    result = convert(*(var(f"path({i}).pos", motion()[i : i + 1]) for i in range(1, 9)))
    assert result.diagnostics[0].code == "inside_container"
    assert result.diagnostics[0].fixes[0].matlab.startswith("q = vertcat(path.pos)")


def test_an_empty_workspace_says_so():
    result = convert()
    worst = result.diagnostics[0]
    assert (worst.code, worst.values["count"]) == ("no_trajectory", 0)


def test_what_the_reader_refuses_is_a_result():
    def read():
        raise BadInput(UNREADABLE(file="x.mat", why="it ends"))

    result = conversion_convert.convert("x.mat", read, Options(), ARM, COEFFICIENTS)
    assert (result.outcome, codes(result)) == (Outcome.REJECTED, {"unreadable"})


def test_transpose_and_columns_find_the_time_row_of_simulink():
    q = motion()
    matrix = np.vstack([np.arange(300) / 250, q.T])
    t = accepted(var("q", matrix), transpose=True, columns="2:7")
    np.testing.assert_array_equal(t.positions, q)
    assert t.frame_rate == 250.0
    t = accepted(var("q", matrix), var("K", np.eye(6)), transpose=True, columns="2:end")
    assert t.source.variable == "q"


def test_columns_take_the_joints_of_a_wider_matrix():
    q = motion()
    wide = np.column_stack([np.arange(300) / 20, q, q])
    t = accepted(var("log", wide), columns="2:7", variable="log")
    np.testing.assert_array_equal(t.positions, q)
    assert t.frame_rate == 20.0
    t = accepted(var("q", motion(joints=7)), columns="1:6")
    assert t.gripper is None


def test_a_seventh_column_is_left_out_by_a_press_and_rounding_is_no_joint():
    (alone, _) = convert(var("q", motion(joints=7))).diagnostics[0].fixes
    assert (alone.option, alone.value) == ("columns", "1:6")
    rounding = np.random.default_rng(1).normal(0, 1e-15, 300)
    t = accepted(var("q", np.column_stack([motion(), rounding])))
    assert t.gripper is not None
    assert not t.gripper.any()


def test_degrees_are_converted_when_declared_and_only_then():
    q = motion(reach=2.0)
    t = accepted(var("q", np.degrees(q)), degrees=True)
    np.testing.assert_allclose(t.positions, q, atol=1e-15)


@pytest.mark.parametrize(("unit", "turn"), [("", 1.0), ("deg", 180 / np.pi)])
def test_times_in_milliseconds_beside_the_joints_are_no_seconds(unit, turn):
    q = motion(rows=301)
    values = np.column_stack([np.arange(301.0) * 10, q * turn])
    result = convert(var("data", values), columns="2:7", units=unit)
    assert result.trajectory is not None, result.message
    assert result.trajectory.frame_rate == 100
    assert "time_unit" in codes(result)


@pytest.mark.parametrize("named", ["", "/joint_states"])
def test_recorded_states_of_other_joints_are_named(named):
    states = Variable("/joint_states", "sensor_msgs/msg/JointState", columns=("a", "b"))
    result = convert(var("/tf", kind="tf2_msgs/msg/TFMessage"), states, variable=named)
    assert result.diagnostics[0].code == "recorded_states"
    commands = [fix.command for fix in result.diagnostics[0].fixes]
    assert commands == ["mrlab robots list"]
    assert list(result.diagnostics[0].values["found"]) == ["a", "b"]


def test_unwrap_removes_full_turns():
    q = motion(reach=1.5)
    jumped = q.copy()
    jumped[150:, 2] -= 2 * np.pi
    result = convert(var("q", jumped), var("fs", 50.0))
    assert "jump_2pi" in codes(result)
    # Its rows are shown at the times of which the findings speak.
    assert result.frame_rate == 50.0
    np.testing.assert_allclose(accepted(var("q", jumped), unwrap=True).positions, q, atol=1e-12)


def test_whole_numbers_and_singles_are_doubles():
    whole = np.clip(np.arange(30)[:, None] // 10 - 1, -1, 1) * np.ones(6)
    t = accepted(var("q", whole.astype(np.int8)), frame_rate=1.0)
    assert t.positions.dtype == np.float64
    single = motion().astype(np.float32)
    np.testing.assert_array_equal(
        accepted(var("q", single, kind="single")).positions, single.astype(np.float64)
    )


def gripper_motion(column):
    return var("q", np.column_stack([motion(len(column)), column]))


def test_the_gripper_is_closed_above_the_middle():
    column = np.repeat([0.0, 85.0, 0.0], 100)
    result = convert(gripper_motion(column))
    np.testing.assert_array_equal(result.trajectory.gripper, column > 42.5)
    assert "gripper_range" in codes(result)
    ramp = np.concatenate([np.zeros(140), np.linspace(0, 1, 20), np.ones(140)])
    np.testing.assert_array_equal(accepted(gripper_motion(ramp)).gripper, ramp > 0.5)


@pytest.mark.parametrize(("ends", "between"), [((0.0, 1.0), 18), ((0.01, 0.09), 18)])
def test_samples_between_the_gripper_s_ends_are_counted(ends, between):
    column = np.interp(np.arange(300), [140, 159], ends)
    (found,) = [d for d in convert(gripper_motion(column)).diagnostics if "between" in d.code]
    assert found.severity is Severity.WARNING
    assert (found.values["count"], found.values["rows"]) == (between, 300)


def test_a_noisy_gripper_is_at_its_ends():
    noise = np.random.default_rng(1).uniform(0, 0.01, 300)
    assert "gripper_between" not in codes(convert(gripper_motion((np.arange(300) > 150) + noise)))


@pytest.mark.parametrize("value", [0.0, 1.0, 85.0])
def test_a_constant_gripper_is_open(value):
    result = convert(gripper_motion(np.full(300, value)))
    assert result.outcome is Outcome.ACCEPTED
    assert not result.trajectory.gripper.any()
    assert ("gripper_unmoved" if value else "gripper_constant") in codes(result)


@pytest.mark.parametrize(
    ("company", "rate", "code"),
    [
        ([], 100.0, "rate_default"),
        ([var("fs", 250.0)], 250.0, "rate_found"),
        ([var("frame_rate", 30)], 30.0, "rate_found"),
        ([var("m('fs')", 250.0, label="fs")], 250.0, "rate_found"),
        ([var('d{"dt"}', 0.02, label="dt")], 50.0, "rate_found"),
        ([var("c{2}", 250.0)], 100.0, "rate_default"),
        ([var("dt", 0.008)], 125.0, "rate_found"),
        ([var("Ts", 1 / 30)], 30.0, "rate_found"),
        ([var("t", np.linspace(0, 299 / 60, 300)[:, None])], 60.0, "rate_found"),
        ([var("tout", np.arange(300)[None] / 500)], 500.0, "rate_found"),
        ([var("t", np.arange(299)[:, None] / 60)], 100.0, "rate_default"),
        ([var("f", 1e9)], 100.0, "rate_default"),
        ([var("fs", -5.0)], 100.0, "rate_default"),
        ([var("F", np.ones((3, 1)))], 100.0, "rate_default"),
        ([var("dt", 0.01), var("t", np.arange(300)[:, None] / 50)], 50.0, "rate_conflict"),
    ],
)
def test_the_frame_rate_comes_from_the_file_or_the_default(company, rate, code):
    result = convert(var("q", motion()), *company)
    assert result.trajectory.frame_rate == rate
    assert code in codes(result)


def test_a_long_text_beside_a_rate_is_no_data_of_its_own():
    said = var("meta.comment", kind="char", shape=(1, 40), text="pick and place, test 3")
    assert accepted(var("q", motion()), var("meta.fs", 20.0), said).frame_rate == 20.0


def test_the_time_of_the_structure_itself_comes_first():
    t = np.arange(300)[:, None] / 40
    result = convert(var("out.q.time", t), var("out.q.signals.values", motion()), var("dt", 0.001))
    assert result.trajectory.frame_rate == 40.0


def test_the_own_time_of_a_signal_comes_first():
    own = var("log{1}.Values.Time", np.arange(300)[:, None] / 250)
    q = var("log{1}.Values.Data", motion(), time="log{1}.Values.Time")
    assert accepted(var("fs", 20.0), own, q).frame_rate == 250.0


def test_uneven_times_are_a_warning():
    t = np.cumsum(np.where(np.arange(300) % 2, 0.01, 0.03))[:, None]
    result = convert(var("q", motion()), var("t", t))
    assert "time_uneven" in {w.code for w in result.trajectory.warnings}


def test_the_rate_asked_for_wins():
    assert accepted(var("q", motion()), var("fs", 250.0), frame_rate=10.0).frame_rate == 10.0


def test_a_closed_object_says_why_it_is_closed():
    closed = var("q", kind="timeseries", shape=(), is_object=True, note="mat-io is missing")
    found = convert(closed).diagnostics[0]
    assert found.code == "unsupported_object"
    assert found.values["objects"] == ["q (timeseries)"]
    assert found.values["why"] == "mat-io is missing"
    assert found.fixes[0].matlab.startswith("q = q.Data")
    handle = var("q", kind="function_handle", shape=(1, 1), is_object=True)
    found = convert(handle).diagnostics[0]
    assert found.code == "unsupported_object"
    assert found.values["why"].code == "function_handle"
    assert "arrayfun(@(s) reshape(q(s), 1, []), t(:)" in found.fixes[0].matlab
    beside = var("f", kind="function_handle", shape=(1, 1), is_object=True)
    assert "object_ignored" not in codes(convert(var("q", motion()), beside))


def test_matrices_inside_objects_are_named():
    log = var("log", kind="Simulink.SimulationData.Dataset", shape=(1, 1))
    result = convert(log, var("log{1}.Data", np.ones((50, 2))))
    assert result.diagnostics[0].values["inside"] == ["log{1}.Data (50x2)"]


def test_the_matrix_that_is_taken_is_confirmed_by_a_second_reader():
    asked = []
    workspace = Workspace("fake", (var("q", motion()), var("tau", motion())), confirm=asked.append)

    def run():
        return conversion_convert.convert(
            "traj.mat", lambda: workspace, Options(), ARM, COEFFICIENTS, created_ns=1
        )

    assert run().outcome is Outcome.ACCEPTED
    assert asked == [["q"]]
    assert joining.sources("q(1:9, :)", "") == ["q"]
    assert joining.sources("q1..q3", "q1..q3") == ["q1", "q2", "q3"]

    def differs(paths):
        raise BadInput(READERS_DISAGREE(file="traj.mat", variable=paths[0], why="x"))

    workspace = replace(workspace, confirm=differs)
    assert run().diagnostics[0].code == "readers_disagree"
    assert run().outcome is Outcome.REJECTED


@pytest.mark.parametrize("rate", [-1.0, float("nan"), float("inf"), 1e9])
def test_an_impossible_rate_is_refused(rate):
    assert refused(var("q", motion()), frame_rate=rate) == "bad_rate"


def test_an_unknown_variable_is_answered_with_the_names_there_are():
    result = convert(var("q", motion()), variable="Q")
    assert result.diagnostics[0].code == "unknown_variable"
    assert result.diagnostics[0].values["held"] == ["q (300x6 double)"]


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("2:7", [1, 2, 3, 4, 5, 6]),
        ("2 : 7", [1, 2, 3, 4, 5, 6]),
        ("[1 3 5]", [0, 2, 4]),
        ("1,3:4", [0, 2, 3]),
        ("1:2:7", [0, 2, 4, 6]),
        ("6:end", [5, 6, 7]),
        ("end", [7]),
    ],
)
def test_columns_are_written_as_in_matlab(text, columns):
    assert parse_columns(text, 8, "q", "9x8") == columns


@pytest.mark.parametrize("text", ["0:3", "1:9", "x", "1:0:3", "", "7:2", "-1", "1..3", "1:2:3:4"])
def test_other_columns_are_refused(text):
    with pytest.raises(BadInput):
        parse_columns(text, 8, "q", "9x8")


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("pick.mat", "pick"),
        ("pick.MAT.gz", "pick"),
        ("a b (2).mat", "a_b_2"),
        ("Größe 3.mat", "Groesse_3"),
        (".mat", "trajectory"),
        ("../up.mat", "up"),
        ("x" * 300 + ".mat", "x" * 128),
    ],
)
def test_a_file_gives_the_name(file, name):
    assert id_from(file) == name


@pytest.mark.parametrize("name", ["../x", "a/b", "x" * 129, "漢", "ü@2"])
def test_impossible_names_are_misuse_of_the_request(name):
    with pytest.raises(BadInput, match="cannot be used"):
        conversion_convert.convert(
            "q.mat", lambda: None, Options(), ARM, COEFFICIENTS, trajectory_id=name
        )


def test_the_course_of_a_candidate_is_drawn():
    result = convert(var("q1", motion()), var("q2", -motion()))
    rising, falling = (c.sparkline() for c in result.candidates)
    assert (rising[0], rising[-1]) == ("▁", "█")
    assert (falling[0], falling[-1]) == ("█", "▁")


@pytest.mark.parametrize(("most", "code"), [(300, None), (299, "too_many_rows")])
def test_more_rows_than_the_limit_are_refused(most, code):
    workspace = Workspace("fake", (var("q", motion(300)), var("fs", 100.0)), 0, "0" * 64)
    result = conversion_convert.convert(
        "traj.mat", lambda: workspace, Options(), ARM, COEFFICIENTS, most_rows=most
    )
    assert (result.outcome is Outcome.ACCEPTED) is (code is None), result.message
    if code:
        worst = result.diagnostics[0]
        assert (worst.code, worst.values["rows"], worst.values["most"]) == (code, 300, 299)


def test_a_time_that_goes_back_is_cut_before_it_does():
    t = np.arange(300) / 100
    t[200:] -= 0.5
    result = convert(var("q", motion()), var("t", t[:, None]))
    (found,) = [d for d in result.diagnostics if d.code == "time_backward"]
    assert found.first_row == 201
    assert found.values["last"] == 200


def test_a_time_that_was_not_used_is_named_with_its_row():
    t = np.arange(300) / 500
    t[99] = np.nan
    result = convert(var("q", motion()), var("t", t[:, None]))
    (found,) = [d for d in result.diagnostics if d.code == "rate_unused"]
    assert (found.variable, found.severity) == ("t", Severity.WARNING)
    assert said_in(found)["time_not_finite"]["first_row"] == 100


def test_waypoints_are_mended_with_resample():
    ends, t = motion(5, reach=2.0), np.arange(5.0)[:, None] * 2
    assert "waypoints" in codes(convert(var("q", ends), var("t", t)))
    mended = convert(var("q", ends), var("t", t), resample=True, frame_rate=100.0)
    assert mended.trajectory.frame_count == 801
    assert "waypoints" not in codes(mended)


def test_a_gap_of_a_month_is_not_to_be_mended_with_a_rate():
    t = np.arange(300) / 100
    t[150:] += 3e6
    result = convert(var("q", motion()), var("t", t[:, None]), resample=True)
    assert result.diagnostics[0].code == "too_long"
    assert not any(f.option == "frame_rate" for f in result.diagnostics[0].fixes)


def test_degrees_in_some_columns_are_not_converted_in_silence():
    q = motion(reach=1.5)
    q[:, 5] = np.degrees(q[:, 5]) * 1.5
    result = convert(var("q", q))
    assert result.diagnostics[0].code == "degrees"
    assert said_in(result.said)["unit_mixed"]["columns"] == "6"
    assert [f.option for f in result.diagnostics[0].fixes] == [""]
    warnings = accepted(var("q", q), units="deg").warnings
    assert any("little_in_degrees" in said_in(w) for w in warnings)
    assert not accepted(var("q", np.degrees(motion(reach=2.0))), units="deg").warnings


def test_velocities_under_the_name_of_positions_are_doubted() -> None:
    u = np.linspace(0, 1, 101)[:, None]
    bump = (30 * u**2 - 60 * u**3 + 30 * u**4) * np.array([0.9, 0.4, -0.5, 0.3, 0.2, 0.6])
    robot = make_model(6, home=-1.0)
    (warning,) = accepted(var("q", bump), var("fs", 20.0), robot=robot).warnings
    assert said_in(warning)["seen"]["what"] == "between_zeros"
    calm = (var("fs", 20.0),)
    away = np.column_stack([bump[:, :1], bump[:, 1:] - 1.2])
    assert not accepted(var("q", away), *calm, robot=robot).warnings
    assert not accepted(var("q", bump), *calm, robot=make_model(6)).warnings  # its home


def test_a_word_that_may_mean_two_units_is_no_option() -> None:
    assert Options(units="gradians").factor()[0] == Options(units="grads").factor()[0] == "gon"
    with refusals.refused(BAD_OPTION, BadInput, found="grad"):
        Options(units="grad").factor()


def test_options_that_name_things_twice_or_needlessly_are_answered():
    q = motion()
    for code, taken in (
        ("repeated_columns", accepted(var("q", q), columns="1 1 1 1 1 1")),
        (
            "repeated_pieces",
            accepted(var("q1", q[:, :1]), var("q2", q[:, 1:2]), join="q1,q1,q1,q1,q1,q2"),
        ),
    ):
        assert any(code in said_in(w) for w in taken.warnings)
    assert accepted(var("q", q), variable="q ").frame_count == 300
    result = convert(var("q", q), transpose=True)
    assert "rows_already" in said_in(result.said)
