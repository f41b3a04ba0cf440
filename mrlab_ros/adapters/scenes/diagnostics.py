"""Diagnostics of scene files and of the meshes of objects."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

NO_SCENE = Code(
    "no_scene",
    "There is no scene '{scene}'; there are: {known:list}.",
    "[Did you mean '{close}'?]",
    meaning="A scene was named that is neither shipped nor saved.",
)
BAD_SCENE_NAME = Code(
    "bad_scene_name",
    "'{name}' cannot name a scene; expected lower-case letters, digits and underscores, such as "
    "class_3.",
    meaning="A name that the file of a scene cannot have.",
)
OBJECT_MESH_URI = Code(
    "object_mesh_uri",
    "The mesh is '{mesh}'; expected a URI that begins with {prefix} and ends with "
    "{formats:either}.",
    meaning="The mesh of an object is of no format that the lab reads, or elsewhere.",
)
OBJECT_MESH_MISSING = Code(
    "object_mesh_missing",
    "The mesh {mesh} does not exist.",
    "Put it at {path}, or correct the URI.",
    meaning="The mesh of an object is not there.",
)
OBJECT_MESH_UNREADABLE = Code(
    "object_mesh_unreadable",
    "The mesh {mesh} cannot be read: {why:problem}.",
    "Export it again.",
    meaning="The mesh of an object is damaged.",
)
OBJECT_MESH_TOO_FINE = Code(
    "object_mesh_too_fine",
    "The mesh {mesh} has {count:integer} triangles; expected {most:integer} at most.",
    "Simplify it, in Blender with the modifier Decimate.",
    meaning="The mesh of an object that collides has too many triangles.",
)
OBJECT_MESH_EMPTY = Code(
    "object_mesh_empty",
    "The mesh {mesh} has no triangles, or a vertex that is not finite.",
    "Export it again.",
    meaning="The mesh of an object holds nothing.",
)
OBJECT_MESH_FLAT = Code(
    "object_mesh_flat",
    "The mesh {mesh} is flat; what falls and is held needs a volume.",
    "Give it a thickness, or write fixed: true.",
    meaning="The mesh of an object that can move encloses nothing.",
)
OBJECT_MESH_SIZE = Code(
    "object_mesh_size",
    "The mesh {mesh} measures {size:length}; expected {low:length} to {high:length}.",
    "Export it in metres.",
    meaning="The mesh of an object is much too large or too small.",
)
