"""`mrlab class`: marks all submissions of an export by a rubric."""
