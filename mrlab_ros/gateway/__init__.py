"""The gateway: one web application that serves pages and carries the lab to browsers.

A zenoh client like any other, and no ROS node.
"""
