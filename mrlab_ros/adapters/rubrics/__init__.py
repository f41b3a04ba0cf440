"""Rubrics as YAML files."""
