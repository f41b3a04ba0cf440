"""Checks of motions and cells: converted, computed, rehearsed."""
