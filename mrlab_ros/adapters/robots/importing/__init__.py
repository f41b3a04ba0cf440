"""A description of somebody else becomes a robot of the lab."""
