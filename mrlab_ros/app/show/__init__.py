"""Report pages: the JSON of each report, its still parts, and the one file."""
