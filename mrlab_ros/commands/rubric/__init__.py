"""`mrlab rubric`: named tests with points."""
