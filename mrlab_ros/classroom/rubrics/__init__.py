"""Rubrics: what a motion is for, as named tests with points."""
