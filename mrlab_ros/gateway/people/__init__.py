"""People: who somebody is, and what somebody may do."""
