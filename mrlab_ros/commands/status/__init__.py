"""`mrlab status`."""
