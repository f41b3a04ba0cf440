"""Rubrics: named tests with points, and what a checked motion gets for each."""
