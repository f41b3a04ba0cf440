"""Robot descriptions: library, URDF, meshes, checks and import."""
