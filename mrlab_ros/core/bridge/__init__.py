"""What the bridge carries, who may see it, and how long it takes."""
