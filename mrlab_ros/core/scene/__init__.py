"""The robots of the scene, and the scene as a document."""
