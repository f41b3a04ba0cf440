"""A class of submissions: who handed in what, its marks, and what it has in common."""
