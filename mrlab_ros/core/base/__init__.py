"""Errors, clocks, geometry, records and diagnostics, used by every room of the core."""
