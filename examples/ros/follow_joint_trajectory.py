"""Move a robot of the lab by MoveIt's action: python3 follow_joint_trajectory.py ur5e_1

Needs rclpy and control_msgs: ROS 2 Jazzy, or the Python of a clone of MR-Lab (. .venv/mrlab.sh).
"""

import sys

import rclpy
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionClient
from rclpy.wait_for_message import wait_for_message
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

# By how much each joint turns, there and back, rad; and the time of each way, s.
WAY, TIME = 0.3, 1


def main(robot):
    rclpy.init()
    node = rclpy.create_node("follow_example")
    there, state = wait_for_message(JointState, node, f"/{robot}/joint_states", time_to_wait=10.0)
    if not there:
        sys.exit(f"{robot} says nothing; is the lab running? mrlab up --robots ur5e")
    client = ActionClient(node, FollowJointTrajectory, f"/{robot}/follow_joint_trajectory")
    if not client.wait_for_server(timeout_sec=10.0):
        sys.exit(f"{robot} has no follow_joint_trajectory; its lab may be older")
    points = [
        JointTrajectoryPoint(
            positions=[q + way for q in state.position], time_from_start=Duration(sec=time)
        )
        for way, time in ((WAY, TIME), (0.0, 2 * TIME))
    ]
    goal = FollowJointTrajectory.Goal(
        trajectory=JointTrajectory(joint_names=state.name, points=points)
    )

    def show(message):
        print(f"{message.feedback.actual.positions[0]:.3f} rad", end="\r")

    sent = client.send_goal_async(goal, feedback_callback=show)
    rclpy.spin_until_future_complete(node, sent)
    ended = sent.result().get_result_async()
    rclpy.spin_until_future_complete(node, ended)
    result = ended.result().result
    print(f"{robot}: {result.error_string}")
    client.destroy()
    node.destroy_node()
    rclpy.shutdown()
    return result.error_code


if __name__ == "__main__":
    if not sys.argv[1:]:
        sys.exit("usage: follow_joint_trajectory.py ROBOT, such as ur5e_1")
    sys.exit(main(*sys.argv[1:]))
