"""What one-file pages are made of: the built code, and the meshes of robots."""
