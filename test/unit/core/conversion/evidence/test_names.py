"""What names of variables in public workspaces say."""

import pytest

from mrlab_ros.core.conversion.evidence.names import Hint, hint, leaf

POSITIONS = """
q Q qMatrix qMat qCombined q_history q_traj qtraj q_raw q_filt q_filter q_ds q_actual q_act
q_target q_des qlist qj qc qt qPath qs jointTraj jointTrajectory
joint_trajectory joint_angles jointangles JointAngles angle_export theta theta_list
thetalist thetaRes th_l th_r ref_joint point_record configs robotConfigs q1 q_0 traj_q0_q1
q_actual.signals.values s.q out.q.signals.values TrajectoryData.theta out.q.Data
q_target.signals(1).values run(2).q c.joint_positions currentJoints
Gelenkwinkel Achswinkel q1..q6 A1..A6 log.j1..log.j6 actual_q_0..actual_q_5 theta_deg sollwinkel
"""
TWO_FACED = """
traj trajectory pos position waypoints path trj Bahn Trajektorie refTraj traj_points
"""
NEUTRAL = """
result results data A Y ans simout out out.simout.signals.values c{3} m.Y t1
"""
SPEAKS_AGAINST = """
qd qdd q_dd qdd1 qd_des dq dq_des ddq qDot qDot_list q_dot theta_dot dtheta dtheta_list
speed_record acceleration_record tau tau_g_all torque torques i_actual F force tcp_pose
tcp_force tool_vector pose Kp Kd J M DH qlim T u v qobs xd xe c_pol joint_velocity
jointVelocities qVel qd_target.signals.values tool_vector.signals.values robot.qlim Jacobian
joint_torques target_speed phi_d1
X qp qv omega thetad joint_speeds currents errors xyzrpy Gelenkgeschwindigkeit Drehmoment
Motorstrom Regelabweichung actual_current actual_TCP_pose
thetaPunkt phi_punkt qPunkt Winkelgeschw dTh dphi v_q v_q1 joint_v a_q q_2p e_q e_theta eTheta
q_tilde qTilde qTilde1 T_joint
"""


@pytest.mark.parametrize("path", POSITIONS.split())
def test_names_of_positions(path):
    assert hint(path) is Hint.POSITIONS


@pytest.mark.parametrize("path", TWO_FACED.split())
def test_names_of_joint_positions_and_of_tool_paths(path):
    assert hint(path) is Hint.TWO_FACED


@pytest.mark.parametrize("path", NEUTRAL.split())
def test_names_that_say_nothing(path):
    assert hint(path) is Hint.NEUTRAL


@pytest.mark.parametrize("path", SPEAKS_AGAINST.split())
def test_names_that_speak_against(path):
    assert hint(path) in (Hint.AGAINST, Hint.DOUBTFUL)


def test_qd_is_only_doubtful_as_it_also_names_desired_positions():
    assert hint("qd") is Hint.DOUBTFUL


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("q", "q"),
        ("out.q.signals.values", "q"),
        ("out.q.signals(2).values", "q"),
        ("s(3).theta", "theta"),
        ("q_actual.signals.values", "q_actual"),
    ],
)
def test_the_name_that_speaks_is_not_the_container(path, name):
    assert leaf(path) == name
