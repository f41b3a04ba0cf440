"""`mrlab convert`."""
