"""Identity, journal and health of the processes that make a lab."""
