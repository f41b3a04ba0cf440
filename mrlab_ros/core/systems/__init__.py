"""Robot systems: several robots on one timeline."""
