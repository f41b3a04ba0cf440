"""LTI 1.3: people of a course come signed in, hand in, and get their marks in the course."""
