"""`mrlab up`."""
