"""The node that publishes frames, one URDF of all robots, and markers: what 3D panels show."""
