"""What a file says of its matrices: names, units, statements, times, company."""
