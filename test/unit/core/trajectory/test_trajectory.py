"""A trajectory: what it refuses, and what it says before, on, between and after its frames."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from refusals import refused

from mrlab_ros.core.trajectory.diagnostics import (
    CHANNEL_SHAPE,
    FRAME_RATE_NOT_POSITIVE,
    POSITIONS_NOT_FINITE,
    POSITIONS_SHAPE,
)
from mrlab_ros.core.trajectory.trajectory import (
    Array,
    Channels,
    Source,
    Trajectory,
)

frame_rates = st.one_of(st.sampled_from([25.0, 29.97, 100.0, 250.0, 1000.0]), st.floats(1, 1000))


def make(
    positions: Array,
    frame_rate: float = 100.0,
    gripper: list[bool] | None = None,
    channels: Channels | None = None,
) -> Trajectory:
    joints = positions.shape[1] if positions.ndim == 2 else 1
    return Trajectory(
        id="wave",
        robot_model="ur5e",
        end_effector=None,
        joint_names=tuple(f"joint_{j + 1}" for j in range(joints)),
        frame_rate=frame_rate,
        positions=positions,
        gripper=None if gripper is None else np.array(gripper),
        channels=channels or Channels(positions * 2, positions * 3),
        source=Source("wave.mat", "q", "0" * 64),
    )


@st.composite
def trajectories(draw: st.DrawFn) -> Trajectory:
    rows, joints = draw(st.integers(2, 40)), draw(st.integers(1, 8))
    values = draw(arrays(np.float64, (rows, joints), elements=st.floats(-7, 7)))
    gripper = draw(st.none() | st.lists(st.booleans(), min_size=rows, max_size=rows))
    return make(values, draw(frame_rates), gripper)


@given(trajectories())
def test_on_a_frame_it_gives_exactly_that_frame(trajectory: Trajectory) -> None:
    for frame in range(trajectory.frame_count):
        position = frame / trajectory.frame_rate
        assert trajectory.frame_at(position) == frame
        assert np.array_equal(trajectory.sample(position), trajectory.positions[frame])
        assert np.array_equal(trajectory.at(position)[2], trajectory.channels.velocities[frame])


@given(trajectories(), st.floats(0.001, 0.999), st.data())
def test_between_two_frames_it_is_linear(
    trajectory: Trajectory, share: float, data: st.DataObject
) -> None:
    frame = data.draw(st.integers(0, trajectory.frame_count - 2))
    position = (frame + share) / trajectory.frame_rate
    here, there = trajectory.positions[frame], trajectory.positions[frame + 1]
    assert trajectory.frame_at(position) == frame
    assert trajectory.sample(position) == pytest.approx(
        (1 - share) * here + share * there, abs=1e-9
    )


@given(trajectories(), st.floats(0, 1e6))
def test_beyond_its_ends_it_gives_the_end(trajectory: Trajectory, beyond: float) -> None:
    assert np.array_equal(trajectory.sample(-beyond), trajectory.positions[0])
    last = trajectory.duration + beyond
    assert np.array_equal(trajectory.sample(last), trajectory.positions[-1])
    assert trajectory.frame_at(last) == trajectory.frame_count - 1


@given(trajectories(), st.floats(-1, 60))
def test_the_gripper_is_the_last_frames_and_never_between(
    trajectory: Trajectory, position: float
) -> None:
    if trajectory.gripper is None:
        assert trajectory.gripper_at(position) is None
    else:
        expected = bool(trajectory.gripper[trajectory.frame_at(position)])
        assert trajectory.gripper_at(position) is expected


@given(trajectories())
def test_the_grasp_frames_rebuild_the_gripper(trajectory: Trajectory) -> None:
    if trajectory.gripper is None:
        assert trajectory.grasp_frames == ()
        return
    rebuilt = np.zeros(trajectory.frame_count, dtype=bool)
    for frame, closed in trajectory.grasp_frames:
        rebuilt[frame:] = closed
    assert np.array_equal(rebuilt, trajectory.gripper)
    states = [closed for _, closed in trajectory.grasp_frames]
    assert states == [i % 2 == 0 for i in range(len(states))]


def test_the_duration_is_that_of_the_last_frame() -> None:
    assert make(np.zeros((801, 6))).duration == 8.0


def test_its_arrays_cannot_be_changed() -> None:
    trajectory = make(np.zeros((3, 2)), gripper=[False, True, True])
    assert trajectory.gripper is not None
    for array in (trajectory.positions, trajectory.gripper, *vars(trajectory.channels).values()):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


@pytest.mark.parametrize("shape", [(1, 6), (0, 6), (6,), (2, 2, 2)])
def test_a_wrong_shape_is_refused(shape: tuple[int, ...]) -> None:
    with refused(POSITIONS_SHAPE, size="x".join(map(str, shape))):
        make(np.zeros(shape))


def test_columns_that_are_not_the_joints_are_refused() -> None:
    with refused(POSITIONS_SHAPE, joints=6):
        Trajectory(
            id="wave",
            robot_model="ur5e",
            end_effector=None,
            joint_names=("a", "b", "c", "d", "e", "f"),
            frame_rate=100.0,
            positions=np.zeros((4, 7)),
            gripper=None,
            channels=Channels(*(np.zeros((4, 7)) for _ in range(2))),
            source=Source("wave.mat", "q", "0" * 64),
        )


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_finite_is_refused(value: float) -> None:
    positions = np.zeros((3, 2))
    positions[1, 1] = value
    with refused(POSITIONS_NOT_FINITE):
        make(positions)


@pytest.mark.parametrize("rate", [0.0, -100.0, np.nan, np.inf])
def test_a_frame_rate_that_is_none_is_refused(rate: float) -> None:
    with refused(FRAME_RATE_NOT_POSITIVE):
        make(np.zeros((3, 2)), rate)


def test_a_gripper_of_another_length_is_refused() -> None:
    with refused(CHANNEL_SHAPE, channel="gripper", expected="3"):
        make(np.zeros((3, 2)), gripper=[True, False])


@pytest.mark.parametrize("channel", range(2))
def test_a_channel_of_another_shape_is_refused(channel: int) -> None:
    channels = [np.zeros((3, 2)) for _ in range(2)]
    channels[channel] = np.zeros((2, 2))
    with refused(CHANNEL_SHAPE, channel="derived", size="2x2", expected="3x2"):
        make(np.zeros((3, 2)), channels=Channels(*channels))
