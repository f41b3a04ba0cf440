"""The converter's node and the catalogue of trajectories."""
