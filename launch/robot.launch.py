"""Put a robot into a running lab: ros2 launch mrlab_ros robot.launch.py model:=ur5e [x:=1 y:=0].

It is what `mrlab spawn` does, so that a launch file of your own can include it once a robot.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.commands.up.surroundings import graph_range
from mrlab_ros.processes.launch_arguments import ROBOT


def generate_launch_description():
    """Declare the arguments; the command follows from their values."""
    declared = [DeclareLaunchArgument(each.name, **each.settings) for each in ROBOT]
    return LaunchDescription([*declared, OpaqueFunction(function=spawn)])


def spawn(context):
    """Return the command that puts the robot into the lab."""
    names = [each.name for each in ROBOT]
    values = {name: LaunchConfiguration(name).perform(context).strip() for name in names}
    options = ["--yaw", values["yaw"]]
    if values["x"] or values["y"]:
        options += ["--at", f"{values['x'] or 0},{values['y'] or 0}"]
    for argument, option in (("name", "--name"), ("end_effector", "--tool")):
        if values[argument]:
            options += [option, values[argument]]
    command = python_process.command("mrlab_ros.cli", "spawn", values["model"], *options)
    reach = graph_range(values["discovery"])
    return [ExecuteProcess(cmd=[*command], name="spawn", output="screen", additional_env=reach)]
