"""Checks of a motion before a robot moves: limits, evidence from physics, a verdict."""
