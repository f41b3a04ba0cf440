"""The ROS nodes: they declare parameters, build a core object, wire it and forward."""
