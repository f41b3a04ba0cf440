"""A graded class, as `mrlab class` left it in a folder, for its teachers."""
