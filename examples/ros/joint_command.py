"""Stream joint positions to a robot of the lab: python3 joint_command.py ur5e_1 [SECONDS]

Change a parameter, such as AMPLITUDE, and the robot moves by it at the next message. Needs rclpy:
ROS 2 Jazzy, or the Python of a clone of MR-Lab (. .venv/mrlab.sh).
"""

import math
import sys
import time

import rclpy
from rclpy.wait_for_message import wait_for_message
from sensor_msgs.msg import JointState

AMPLITUDE = 0.3  # rad
FREQUENCY = 0.25  # Hz
RATE = 50  # messages a second


def main(robot, seconds="10"):
    rclpy.init()
    node = rclpy.create_node("joint_command_example")
    there, state = wait_for_message(JointState, node, f"/{robot}/joint_states", time_to_wait=10.0)
    if not there:
        sys.exit(f"{robot} says nothing; is the lab running? mrlab up --robots ur5e")
    publisher = node.create_publisher(JointState, f"/{robot}/joint_command", 10)
    while publisher.get_subscription_count() == 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    began = time.monotonic()
    while (passed := time.monotonic() - began) < float(seconds):
        way = AMPLITUDE * math.sin(2 * math.pi * FREQUENCY * passed)
        publisher.publish(JointState(name=state.name, position=[q + way for q in state.position]))
        time.sleep(1 / RATE)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    if not sys.argv[1:]:
        sys.exit("usage: joint_command.py ROBOT [SECONDS], such as ur5e_1 5")
    main(*sys.argv[1:])
