"""The engine port, implemented with pybullet."""
