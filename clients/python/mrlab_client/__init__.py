"""A running MR-Lab from Python without ROS: arrays are checked, shown, played and recorded.

The names are those of `mrlab_ros`, the lab's own package. Units are SI and radians.
"""

from mrlab_client.errors import FileRefused, LabError, NoAnswer
from mrlab_client.lab import Lab, check
from mrlab_client.motion import Check, Finding, Motion
from mrlab_client.recording import Recording
from mrlab_client.robot import JointSample, LabRobot, Run

__all__ = [
    "Check",
    "FileRefused",
    "Finding",
    "JointSample",
    "Lab",
    "LabError",
    "LabRobot",
    "Motion",
    "NoAnswer",
    "Recording",
    "Run",
    "check",
]
