"""The ledger: each variable of a file ends explained, harmless or unread."""

import numpy as np
import pytest

from mrlab_ros.core.conversion.evidence.ledger import About, Claim, End, Standing, read
from mrlab_ros.core.conversion.workspace import Variable, Workspace

ROWS, JOINTS = 40, 6
T = np.arange(ROWS) / 50


def end_of(path, values=None, text="", *, rate=50.0, assumed=False):
    """Return how a variable ends beside q at 50 Hz."""
    held = None if values is None else np.asarray(values, dtype=float)
    held = held if held is None or held.ndim == 2 else held.reshape(-1, 1)
    q = Variable("q", "double", (ROWS, JOINTS), np.zeros((ROWS, JOINTS)))
    shape = (1, 1) if held is None else held.shape
    other = Variable(path, "char" if text else "double", shape, held, text=text)
    standing = Standing.ASSUMED if assumed else Standing.STATED
    claims = [Claim(About.RATE, repr(rate), standing, "fs")]
    found = read(Workspace("mat", (q, other)), "q", (ROWS, JOINTS), claims, (), "ur5e")
    return next((e.end for e in found.entries if e.path == path), None)


@pytest.mark.parametrize(
    ("path", "values", "end"),
    [
        ("n_per_s", 50.0, End.TIME),
        ("tau_s", 0.02, End.TIME),
        ("abc", 0.02, End.TIME),
        ("mass", 2.5, End.HARMLESS),
        ("kp", 20.0, End.HARMLESS),
        ("x", T, End.TIME),
        ("x", T[:20], End.TIME),
        ("count", np.arange(ROWS), End.HARMLESS),
        ("force", np.column_stack([T, np.sin(T)]), End.TIME),
        ("meta.timing.h", 0.02, End.TIME),
    ],
)
def test_what_may_be_a_time_is_unread_where_nothing_states_the_rate(path, values, end):
    assert end_of(path, values, rate=100.0, assumed=True) is end


@pytest.mark.parametrize(
    ("path", "values", "end"),
    [
        ("conv", 57.3, End.FACTOR),
        ("q_gain", 0.5, End.FACTOR),
        ("units_per_rad", 100.0, End.FACTOR),
        ("step", 20.0, End.EXPLAINED),
        ("duration", (ROWS - 1) / 50, End.EXPLAINED),
        ("cycle_time", 0.008, End.TIME),
        ("emg_fs", 1000.0, End.HARMLESS),
        ("mass", 2.5, End.HARMLESS),
        ("k", np.pi / 180, End.FACTOR),
        ("rad2deg_applied", 1.0, End.TEXT),
        ("is_degrees", 1.0, End.HARMLESS),
        ("flip", 1.0, End.TEXT),
        ("flip", 0.0, End.HARMLESS),
        ("interp", 10.0, End.TEXT),
        ("zzyx", 1.0, End.TEXT),
        ("version", 1.0, End.HARMLESS),
        ("verbose", 1.0, End.HARMLESS),
        ("plot_on", 1.0, End.HARMLESS),
        ("trial", 1.0, End.HARMLESS),
        ("q_offset", [0, 1.5, 0, 0, 0, 0], End.PER_JOINT),
        ("joint_axis", [1, -1, 1, 1, -1, 1], End.PER_JOINT),
        ("invert_joint", [0, 1, 0, 0, 1, 0], End.PER_JOINT),
        ("mass", [1, 1, 1, 1, 1, 1], End.EXPLAINED),
        ("ticks_per_turn", 4096.0, End.FACTOR),
        ("q0", [0, 0, 0, 0, 0, 0.5], End.PER_JOINT),
        ("axes", [1, 2, 3, 4, 5, 6], End.EXPLAINED),
    ],
)
def test_numbers_beside_a_matrix_whose_rate_is_stated(path, values, end):
    assert end_of(path, values) is end


@pytest.mark.parametrize(
    ("path", "text", "end"),
    [
        ("note", "mirrored arm", End.TEXT),
        ("status", "raw motor counts", End.TEXT),
        ("mirror", "left arm", End.TEXT),
        ("mirror", "none", End.HARMLESS),
        ("sys", "relative", End.TEXT),
        ("author", "M. Rossi", End.HARMLESS),
        ("description", "pick and place of the robot arm", End.HARMLESS),
        ("note", "recorded at 125 Hz", End.TIME),
    ],
)
def test_texts_beside_a_matrix(path, text, end):
    assert end_of(path, text=text) is end
