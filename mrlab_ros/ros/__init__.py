"""rclpy's mechanisms: executors, raw streams, calls, parameters."""
