"""Marks of a class: submissions, results, statistics, gradebooks."""
