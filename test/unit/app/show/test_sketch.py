"""The small drawing of a motion: the robot's joints in one scale, within its box."""

import numpy as np
from student_files import wave

from mrlab_ros.adapters.robots.library import RobotLibrary, from_library
from mrlab_ros.adapters.share import directory
from mrlab_ros.app.show.sketch import HEIGHT, POSES, WIDTH, sketch
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients, derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory


def test_a_motion_is_drawn_within_its_box_and_returns_where_it_began():
    robot = from_library(RobotLibrary(directory() / "robots"), "ur5e", None)
    q = wave()
    names = tuple(joint.name for joint in robot.joints)
    ones = (1.0,) * 6
    channels = derive(q, 100.0, ProxyCoefficients(ones, ones, ones, ones, 50.0))
    source = Source("wave.mat", "q", "")
    made = Trajectory("wave", "ur5e", None, names, 100.0, q, None, channels, source)
    poses = np.array(sketch(made, robot)["poses"]).reshape(POSES, -1, 2)
    assert poses.shape[1] >= 6
    assert (poses >= 0).all()
    assert (poses <= [WIDTH, HEIGHT]).all()
    assert np.ptp(poses[..., 0]) > WIDTH / 3 or np.ptp(poses[..., 1]) > HEIGHT / 2
    # the base stands, the tool comes back
    assert (np.ptp(poses[:, 0], axis=0) == 0).all()
    np.testing.assert_allclose(poses[0], poses[-1], atol=0.2)
    assert np.ptp(poses[:, -1], axis=0).max() > 5
