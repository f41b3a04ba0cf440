"""Checks of motions on the library's robots, in the engine that the lab has."""
