"""Trajectories over HTTP: listing, publishing, versions, sharing, undo, downloads."""
