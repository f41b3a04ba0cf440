"""One module for each outside world the lab touches."""
