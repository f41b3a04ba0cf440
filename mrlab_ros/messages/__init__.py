"""ROS messages to core objects and back; the only layer that knows both."""
