"""Each code of the converter: a file that has it, and every fix it carries, applied."""

import shutil
import subprocess
from dataclasses import dataclass, field, replace
from typing import Any

import converter_corpus as corpus
import numpy as np
import pytest
import scipy.io

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import diagnostics as files
from mrlab_ros.core.base.diagnostic import Code, Severity
from mrlab_ros.core.conversion import convert as conversion_convert
from mrlab_ros.core.conversion import diagnostics
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY, Variable, Workspace

COEFFICIENTS = load_coefficients(corpus.ROOT / "config" / "torque_proxy.yaml")
ROBOT = corpus.model("ur5e")
ROWS = 300
Q = corpus.move(rows=ROWS, seed=5)
DQ = corpus.velocity(Q)
T = np.arange(ROWS) / 100
CLOSED = ((np.arange(ROWS) > 100) & (np.arange(ROWS) < 200)).astype(float)
Q_NAMES = tuple(f"q{i}" for i in range(1, 7))
COLUMN = np.arange(ROWS)[:, None]
POINTS = Q[::40]


def var(path, values, **facts):
    values = np.asarray(values, dtype=float)
    values = values[:, None] if values.ndim == 1 else np.atleast_2d(values)
    return Variable(path, "double", values.shape, values, **facts)


def text(path, words):
    return Variable(path, "char", (1, len(words)), text=words)


def message(path, times, positions, names=ROBOT.joint_names):
    shape = positions.shape
    points = Variable(path, JOINT_TRAJECTORY, shape, positions, columns=tuple(names))
    return points, var(f"{path}.time_from_start", times)


def changed(rows, columns, by):
    q = Q.copy()
    q[rows, columns] += by
    return q


@dataclass
class Example:
    """Variables and options whose conversion has a code."""

    variables: list[Variable]
    options: dict[str, Any] = field(default_factory=dict)
    most_rows: int = 1_000_000


REPEATED = np.where(np.arange(ROWS) == 50, T - 0.01, T)
BACK = np.where(np.arange(ROWS) > 200, T - 0.5, T)
UNEVEN = np.cumsum(np.where(COLUMN[:, 0] % 3, 0.01, 0.013))
POSES = np.column_stack([corpus.poses(Q)[:, :3, 3], corpus.rpy(Q)[:, 3:]])
PAGES = corpus.poses(Q[:60]).transpose(1, 2, 0)
ON_ITS_WAY = np.clip(CLOSED + 0.5 * (np.arange(ROWS) == 5), 0, 1)
TIMED = np.column_stack([T, Q])
EXAMPLES = {
    # refused
    "too_many_rows": Example([var("q", Q)], most_rows=100),
    "no_trajectory": Example([var("tau", Q)]),
    "looks_like": Example([var("q", corpus.quaternions(Q))]),
    "never_filled": Example([var("q", 0 * Q)]),
    "rows_not_filled": Example([var("q", np.vstack([Q, np.zeros((9, 6))]))]),
    "ambiguous": Example([var("q1", Q), var("q2", Q - 0.4)]),
    "unknown_variable": Example([var("q", Q)], {"variable": "Q"}),
    "unsupported_object": Example([Variable("ts", "timeseries", (1, 1), is_object=True)]),
    "inside_container": Example([var(f"path({i}).pos", Q[i : i + 1]) for i in range(1, 60)]),
    "pieces_differ": Example([var(f"q{i + 1}", Q[: ROWS - i, i]) for i in range(6)]),
    "wrong_shape": Example([var("log", np.column_stack([T, Q, DQ]))]),
    "recorded_states": Example([Variable("/joint_states", "sensor_msgs/msg/JointState", ())]),
    "transforms": Example(
        [Variable("T", "double", (4, 4, 60), corpus.poses(Q[:60]).transpose(1, 2, 0))]
    ),
    "empty": Example([var("q", np.zeros((0, 6)))]),
    "single_sample": Example([var("q", Q[:1])]),
    "not_real": Example([Variable("q", "double", (ROWS, 6), note="complex")]),
    "wrong_class": Example([Variable("q", "int32", (ROWS, 6))]),
    "non_finite": Example([var("q", np.vstack([Q, np.full((4, 6), np.nan)]))]),
    "transposed": Example([var("q", np.degrees(Q).T)]),
    "time_column": Example([var("data", np.column_stack([Q, COLUMN / (ROWS - 1)]))]),
    "layout_read": Example([var("data", TIMED)]),
    "seven_axes": Example([var("q", np.column_stack([Q, Q[:, 1]]))]),
    "degrees": Example([var("q", np.degrees(Q))]),
    "counts": Example([var("q", np.rint(np.degrees(Q) * 100))]),
    "scale_beside": Example([var("q", 1000 * Q), var("scale", [0.001])]),
    "unit_of_name": Example([var("q_gon", Q * 200 / np.pi)]),
    "unit_conflict": Example([var("q_deg", np.degrees(Q)), text("unit", "rad")]),
    "counts_stated": Example([var("q", Q), text("unit", "counts")]),
    "order_unclear": Example([var("q", Q), var("joint_order", [2, 3, 1, 4, 5, 6])]),
    "names_other": Example([var("q", Q), text("names", "hip,knee,ankle,toe,arm,neck")]),
    "robot_stated": Example([var("q", Q), text("robot", "KUKA LBR iiwa 7")]),
    "no_motion": Example([var("q", np.random.default_rng(1).uniform(-3, 3, (ROWS, 6)))]),
    "bad_columns": Example([var("q", Q)], {"columns": "2:7"}),
    "bad_part": Example([var("q", Q)], {"variable": "q(302:400, :)"}),
    "bad_rate": Example([var("q", Q)], {"frame_rate": 1e-9}),
    "bad_option": Example([var("q", Q)], {"gripper": "9"}),
    "no_times": Example([var("q", Q)], {"resample": True}),
    "joint_names": Example([*message("m", T, Q, [f"j{i}" for i in range(6)])]),
    "bad_message": Example([*message("m", 0 * T, Q)]),
    "too_long": Example([*message("m", 200 * T, Q)], {"frame_rate": 1e5}),
    "joint_limit": Example([var("q", Q * 1.0 + [0, 0, 3.5, 0, 0, 0])]),
    "discontinuity": Example([var("q", changed(slice(100, None), slice(None), 0.9))]),
    "stray_rows": Example([var("q", changed(100, slice(None), 0.9))]),
    "jump_2pi": Example([var("q", changed(slice(100, None), 5, 2 * np.pi))]),
    # accepted with a warning
    "neutral_name": Example([var("data", Q)]),
    "doubtful_name": Example([var("qd", Q)], {"variable": "qd"}),
    "doubtful_values": Example([var("q", np.tile(Q[:1], (ROWS, 1)))]),
    "tool_path_differs": Example([var("q", Q), var("tcp", POSES[::-1] * 1.5)]),
    "unit_unread": Example([var("q", Q), text("unit", "ells")]),
    "stamps_back": Example([*message("m", T, Q), var("m.earlier_stamps", [2.0])]),
    "recording_pauses": Example([*message("m", T + 60 * (T > 1), Q)]),
    "units_differ": Example([var("q", Q, units=("rad",) * 5 + ("deg",))]),
    "order_stated": Example([var("q", Q), var("joint_order", [2, 1, 3, 4, 5, 6])]),
    "motor_side": Example([var("q", Q), var("gear_ratio", [100.0])]),
    "text_unread": Example([var("q", Q), text("note", "mirrored for the left arm")]),
    "unused_beside": Example([var("q", Q), var("q_offset", [1, 2, 3, 4, 5, 6.5])]),
    "rows_left_out": Example([var("q", Q)], {"variable": "q(1:200, :)"}),
    "twin": Example([var("q_act", Q + 1e-3), var("q_des", Q)]),
    "rate_unused": Example([var("q", Q), Variable("t", "char", (ROWS, 4))]),
    "waypoints": Example([var("q", POINTS), var("t", 2.0 * np.arange(len(POINTS)))]),
    "rate_of_velocity": Example([var("q", Q), var("qd", DQ)]),
    "rate_assumed": Example([var("q", Q), var("freq", [100.0])]),
    "rate_unclear": Example([var("q", Q), var("f", [2.0])]),
    "rate_conflict": Example([var("q", Q), var("t", T), var("fs", [250.0])]),
    "time_unit": Example([var("q", Q), var("t", 10.0 * np.arange(ROWS))]),
    "time_counts_rows": Example([var("q", Q), var("t", np.arange(ROWS))]),
    "time_length": Example([var("q", Q), var("t", np.arange(ROWS + 1) / 100)]),
    "time_uneven": Example([var("q", Q), var("t", UNEVEN)]),
    "time_repeated": Example([var("q", Q), var("t", REPEATED)]),
    "time_backward": Example([var("q", Q), var("t", BACK)]),
    "velocity_limit": Example([var("q", Q), var("fs", [2000.0])]),
    "gripper_range": Example([var("q", np.column_stack([Q, 0.085 * (1 - CLOSED)]))]),
    "gripper_between": Example([var("q", np.column_stack([Q, ON_ITS_WAY]))]),
    "gripper_unmoved": Example([var("q", np.column_stack([Q, 1 + 0 * CLOSED]))]),
    "gripper_assumed": Example(
        [var("q", np.column_stack([Q, CLOSED]), columns=(*Q_NAMES, "done"))]
    ),
    "gripper_opens": Example(
        [var("q", np.column_stack([Q, CLOSED]), columns=(*Q_NAMES, "gripper_open"))]
    ),
    "gripper_beside": Example([var("q", Q), var("gripper", 0.085 * CLOSED)]),
    # good to know
    "object_ignored": Example([var("q", Q), Variable("ts", "timeseries", (1, 1), is_object=True)]),
    "other_candidates": Example([var("q", Q), var("data", Q[::-1] + 0.4)]),
    "copies": Example([var("q", Q), var("q_copy", Q)]),
    "rate_default": Example([var("q", Q)]),
    "rate_found": Example([var("q", Q), var("fs", [100.0])]),
    "time_rounded": Example([var("q", Q), var("t", np.round(np.arange(ROWS) / 60, 2))]),
    "joints_matched": Example([var("q", Q[:, ::-1], columns=ROBOT.joint_names[::-1])]),
    "resampled": Example([var("q", Q), var("t", UNEVEN)], {"resample": True}),
    "gripper_constant": Example([var("q", np.column_stack([Q, 0 * CLOSED]))]),
    "squeezed": Example([Variable("q", "double", (6, 1, ROWS), Q.T.reshape(6, 1, ROWS))]),
    "converted_unit": Example([var("q", np.degrees(Q), units=("deg",))]),
    "transpose_applied": Example([var("q", Q.T)], {"transpose": True}),
    "columns_applied": Example([var("q", TIMED)], {"columns": "2:7"}),
    "gripper_applied": Example([var("q", Q), var("hand", CLOSED)], {"gripper": "hand"}),
    "invert_applied": Example([var("q", np.column_stack([Q, 1 - CLOSED]))], {"invert": True}),
    "units_applied": Example([var("q", np.degrees(Q))], {"units": "deg"}),
    "unwrap_applied": Example([var("q", Q)], {"unwrap": True}),
}
# What the file, the reader or the converter itself brings about: no option mends it.
OF_THE_FILE = {
    files.MISSING: {},
    files.UNSUPPORTED_FORMAT: {"form": "html"},
    files.UNREADABLE: {"why": "it ends early"},
    files.BAD_TABLE: {"why": "line 3 has 'x'"},
    files.CONVERTER_FAILED: {"error": "KeyError()"},
    files.READER_DIED: {"signal": 11},
    files.READERS_DISAGREE: {"why": "scipy finds 1.0", "variable": "q"},
    files.TOO_LARGE: {"part": "file", "limit": 2e9},
    files.TOO_SLOW: {"limit": 20.0},
}
REASONS = {"clock", "name_says", "times_of_class", "unit_reaches", "trajectory_taken"}
ELSEWHERE = {"kinematics_agree", "kinematics_differ"}  # test_kinematics_match


def convert(example: Example, options: Options):
    workspace = Workspace("fake", tuple(example.variables), 0, "0" * 64)
    return conversion_convert.convert(
        "traj.mat",
        lambda: workspace,
        options,
        ROBOT,
        COEFFICIENTS,
        created_ns=1,
        most_rows=example.most_rows,
    )


def found_in(example: Example, code: str):
    result = convert(example, Options(**example.options))
    found = next((d for d in result.diagnostics if d.code == code), None)
    assert found is not None, [d.code for d in result.diagnostics]
    return result, found


def test_every_code_of_the_converter_has_an_example():
    declared = [code for code in vars(diagnostics).values() if type(code) is Code]
    # a reason stands inside a finding and ends without a full stop
    findings = {code.code for code in declared if code.text.endswith((".", "]", "problems}"))}
    assert findings - REASONS == {*EXAMPLES, *ELSEWHERE}


@pytest.mark.parametrize("code", EXAMPLES)
def test_each_fix_leads_to_an_accepted_file_or_the_next_problem(code):
    example = EXAMPLES[code]
    result, found = found_in(example, code)
    if found.severity is Severity.ERROR:
        assert result.outcome is not Outcome.ACCEPTED
        assert found.fixes, "a refusal carries what mends it"
        assert result.diagnostics[0].code == code
    else:
        assert result.outcome is Outcome.ACCEPTED
    if found.severity is Severity.WARNING:
        assert found.fixes, "a warning carries what ends it"
    for fix in found.fixes:
        assert fix.option or fix.matlab or fix.command
        if not fix.option:
            continue
        mended = convert(example, corpus.applied(Options(**example.options), fix))
        if mended.outcome is not Outcome.ACCEPTED:
            assert mended.diagnostics[0].code != code, (fix, mended.message)
            assert mended.diagnostics[0].fixes


@pytest.mark.parametrize("code", OF_THE_FILE)
def test_what_no_option_mends_carries_a_line_of_matlab(code):
    found = code(file="q.mat", **OF_THE_FILE[code])
    assert [f.matlab for f in found.fixes if not f.option]


# Lines that only MATLAB can run, that need something of the person's own, or that look at data.
NOT_RUN = {"unsupported_object", "object_ignored", "single_sample", "transforms", "wrong_class"}
# the line takes the place of an option that cannot be
OF_AN_OPTION = {"bad_rate", "bad_option", "bad_part", "bad_columns", "unknown_variable"}
LOOKING = ("size(", "any(", "find(", "plot", "isempty(", "dir(")


def lines_of_matlab():
    """Yield (code, line) of every fix whose line changes something that Octave can run."""
    for code, example in EXAMPLES.items():
        if code in NOT_RUN or any(v.values is None or v.is_message for v in example.variables):
            continue
        if any(len(v.shape) != 2 or not v.path.isidentifier() for v in example.variables):
            continue
        _, found = found_in(example, code)
        for fix in found.fixes:
            if fix.matlab and not fix.matlab.startswith(LOOKING):
                yield code, fix.matlab


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("octave-cli"), reason="needs GNU Octave")
def test_each_line_of_matlab_runs_and_leads_on(tmp_path):
    cases = list(lines_of_matlab())
    assert len(cases) > 30
    script = ["1;"]
    for number, (code, line) in enumerate(cases):
        values = {v.path: v.values for v in EXAMPLES[code].variables}
        scipy.io.savemat(tmp_path / f"{number}.mat", values)
        saves = "" if "save(" in line else "save('-v7', 'traj.mat');"
        script += [
            f"clear all; load('{number}.mat');",
            f"try, {line.rstrip(';')}; {saves} movefile('traj.mat', 'done{number}.mat');",
            f"catch e, disp(['{number}: ' e.message]); end",
        ]
    (tmp_path / "run_lines.m").write_text("\n".join(script))
    done = subprocess.run(
        ["env", "-u", "LD_LIBRARY_PATH", "octave-cli", "--norc", "--quiet", "run_lines.m"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=100,
    )
    # Octave's own words about its end, on stderr, say nothing of the lines.
    assert not done.stdout, (done.stdout, done.stderr, cases)
    assert done.returncode == 0, done.stderr
    stuck = {}
    for number, (code, line) in enumerate(cases):
        loaded = scipy.io.loadmat(tmp_path / f"done{number}.mat")
        variables = [var(n, v) for n, v in loaded.items() if not n.startswith("__")]
        example = replace(EXAMPLES[code], variables=variables)
        asked = {} if code in OF_AN_OPTION else example.options
        result = convert(example, Options(**asked))
        if result.outcome is not Outcome.ACCEPTED and result.diagnostics[0].code == code:
            stuck[line] = result.message
    assert not stuck
