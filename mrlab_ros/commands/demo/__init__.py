"""`mrlab demo`."""
