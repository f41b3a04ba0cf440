"""Trajectories on disk: the store, export and coefficients."""
