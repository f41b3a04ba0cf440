"""Recording and replaying sessions of the lab."""
