"""The trajectory, its derived channels and its file format."""
