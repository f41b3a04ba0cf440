"""Scene files and the meshes of objects."""
