"""Checks of what robots of the running lab are about to play."""
