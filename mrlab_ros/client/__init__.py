"""Programs beside the lab: a client of its graph, and the Python API on top of it."""
