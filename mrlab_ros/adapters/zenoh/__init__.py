"""zenoh: the port that the bridge uses, its configuration, and a session on it."""
