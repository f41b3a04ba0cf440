"""`mrlab check`: evidence of a motion before a robot moves."""
