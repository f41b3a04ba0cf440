"""Writes a whole robot as one packed glTF file: for pages, which read it in one go.

One node a link, one primitive a link, one material. Colour, metalness and roughness are pictures:
the colours of the materials, and the drawings on the links (atlas.py); the baked light is the
colour of the vertices.
Positions are 16 bits (KHR_mesh_quantization); the buffers are packed (EXT_meshopt_compression)
where meshoptimizer is installed, which has to be compiled, and three times as large elsewhere.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.robots.packing.atlas import Atlas, Drawing
from mrlab_ros.adapters.robots.packing.pieces import Piece
from mrlab_ros.adapters.robots.packing.surfaces import Faces, linear
from mrlab_ros.core.base.geometry import Array

USHORT, UINT, BYTE, UBYTE = 5123, 5125, 5120, 5121
VERTICES, INDICES = 34962, 34963
PACKING, SHORTS = "EXT_meshopt_compression", "KHR_mesh_quantization"
# bytes of a vertex, padded to 4: position 3 x 16 bits, normal and light 3 x 8, texture 2 x 16
STRIDE = 20
VERTEX = np.dtype(
    [
        ("position", "<u2", 3),
        ("pad", "<u2"),
        ("normal", "i1", 3),
        ("pad2", "i1"),
        ("light", "u1", 4),
        ("places", "<u2", 2),
    ]
)
FINEST = 2e-5  # m, between two coordinates
STEPS = 16383  # along the longest side; more bits pack worse and show nothing

try:
    import meshoptimizer
except ModuleNotFoundError:
    meshoptimizer = None
else:
    # What the extension reads: vertices as in its version 0, indices as in its version 1.
    meshoptimizer.encode_vertex_version(0)
    meshoptimizer.encode_index_version(1)


def write(
    path: Path,
    links: Mapping[str, Sequence[Piece]],
    made_of: Mapping[str, str],
    drawings: Sequence[Drawing] = (),
    size: int = 512,
) -> None:
    """Write the pieces of each link, in the link's own frame, m.

    made_of: the digests of what they show, kept in the file; drawings: those that pieces name, put
    into a picture of `size` pixels. Raises ValueError where they do not fit.
    """
    pieces = [piece for own in links.values() for piece in own]
    palette = {piece.material.name: piece.material for piece in pieces}
    palette |= {drawing.material.name: drawing.material for drawing in drawings}
    file = _File(Atlas(list(palette.values()), drawings, size))
    for link, own in links.items():
        parts = {
            link: [piece for piece in own if not _is_hose(piece)],
            f"{link}_hose": [piece for piece in own if _is_hose(piece)],
        }
        file.add(link, {name: part for name, part in parts.items() if part})
    path.write_bytes(file.bytes(made_of))


def _is_hose(piece: Piece) -> bool:
    return "hose" in piece.material.name or "cable" in piece.material.name


class _File:
    def __init__(self, atlas: Atlas) -> None:
        self._atlas = atlas
        self._packed = bytearray()
        self._unpacked = 0
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._nodes: list[dict[str, Any]] = []
        self._roots: list[int] = []

    def add(self, link: str, parts: Mapping[str, Sequence[Piece]]) -> None:
        """Add a node of the link's frame, with a node below it for each part."""
        children = []
        for name, pieces in parts.items():
            children.append(len(self._nodes))
            self._nodes.append({"name": f"{name}_mesh", **self._mesh(name, pieces)})
        self._roots.append(len(self._nodes))
        self._nodes.append({"name": link, "children": children})

    def _mesh(self, name: str, pieces: Sequence[Piece]) -> dict[str, Any]:
        """Add a mesh; return the reference to it and where it lies."""
        joined = _joined(pieces, self._atlas)
        vertices, indices, low, step = _ordered(*joined)
        accessors = len(self._accessors)
        wide = len(vertices) > 65535
        self._view(vertices, STRIDE, "ATTRIBUTES", VERTICES)
        view = len(self._views) - 1
        places = vertices["position"]
        fields = (
            ("VEC3", USHORT, 0, False),
            ("VEC3", BYTE, 8, True),
            ("VEC4", UBYTE, 12, True),
            ("VEC2", USHORT, 16, True),
        )
        for kind, component, offset, normalised in fields:
            self._accessors.append(
                {
                    "bufferView": view,
                    "byteOffset": offset,
                    "componentType": component,
                    "count": len(vertices),
                    "type": kind,
                    **({"normalized": True} if normalised else {}),
                }
            )
        self._accessors[accessors]["min"] = places.min(axis=0).tolist()
        self._accessors[accessors]["max"] = places.max(axis=0).tolist()
        self._view(indices, 4 if wide else 2, "TRIANGLES", INDICES, len(vertices))
        self._accessors.append(
            {
                "bufferView": view + 1,
                "componentType": UINT if wide else USHORT,
                "count": len(indices),
                "type": "SCALAR",
            }
        )
        names = ("POSITION", "NORMAL", "COLOR_0", "TEXCOORD_0")
        primitive = {
            "attributes": {name: accessors + n for n, name in enumerate(names)},
            "indices": accessors + len(names),
            "material": 0,
        }
        self._meshes.append({"name": name, "primitives": [primitive]})
        return {
            "mesh": len(self._meshes) - 1,
            "translation": [round(float(value), 6) for value in low],
            "scale": [step] * 3,
        }

    def _view(
        self, values: NDArray[Any], stride: int, mode: str, target: int, vertices: int = 0
    ) -> None:
        """Add a view of a row of vertices, or of indices of so many of them."""
        view: dict[str, Any] = {"byteLength": len(values) * stride, "target": target}
        if mode == "ATTRIBUTES":
            view["byteStride"] = stride
        if meshoptimizer is None:
            plain = values if vertices == 0 else values.astype(f"<u{stride}")
            view |= {"buffer": 0, "byteOffset": self._store(plain.tobytes())}
        else:
            packed = (
                meshoptimizer.encode_index_buffer(values, len(values), vertices)
                if vertices
                else meshoptimizer.encode_vertex_buffer(values, len(values), stride)
            )
            extension = {
                "buffer": 0,
                "byteOffset": self._store(packed),
                "byteLength": len(packed),
                "byteStride": stride,
                "count": len(values),
                "mode": mode,
            }
            view |= {"buffer": 1, "byteOffset": self._unpacked, "extensions": {PACKING: extension}}
            self._unpacked += len(values) * stride + -len(values) * stride % 4
        self._views.append(view)

    def _store(self, data: bytes) -> int:
        at = len(self._packed)
        self._packed.extend(data)
        self._packed.extend(b"\0" * (-len(data) % 4))
        return at

    def _extras(self) -> dict[str, Any]:
        """Return what the pictures hold, for a reader that keeps the colours with the vertices.

        palette: a row a column of the top band, whose height is `band`: linear colour, roughness,
        metalness; white: a place in the picture that is so; drawings: left, top, right, bottom of
        each, and the row of the palette whose finish it has.
        """
        atlas = self._atlas
        palette = [
            [*(round(linear(c), 5) for c in m.colour), m.roughness, m.metalness]
            for m in atlas.palette
        ]
        if not atlas.drawings:
            return {"palette": palette}
        drawings = [
            [*(round(value, 5) for value in atlas.place(n)), atlas.finish(n)]
            for n in range(len(atlas.drawings))
        ]
        white = [round(value, 5) for value in atlas.white]
        return {"palette": palette, "band": atlas.band, "white": white, "drawings": drawings}

    def bytes(self, made_of: Mapping[str, str]) -> bytes:
        """Return the file."""
        images = []
        for name, data in (
            ("colours", self._atlas.colours()),
            ("finish", self._atlas.finishes()),
        ):
            at = self._store(data)
            self._views.append({"buffer": 0, "byteOffset": at, "byteLength": len(data)})
            view = len(self._views) - 1
            images.append({"name": name, "bufferView": view, "mimeType": "image/png"})
        material = {
            "name": "body",
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": 0},
                "metallicRoughnessTexture": {"index": 1},
            },
            "extras": self._extras(),
        }
        nearest, smooth, mipmaps, clamped = 9728, 9729, 9987, 33071
        drawn = bool(self._atlas.drawings)
        extensions, buffers = [SHORTS], [dict[str, Any](byteLength=len(self._packed))]
        if self._unpacked:
            extensions = [PACKING, SHORTS]
            fallback = {PACKING: {"fallback": True}}
            buffers.append({"byteLength": self._unpacked, "extensions": fallback})
        document = {
            "asset": {
                "version": "2.0",
                "generator": "mrlab",
                "extras": dict(made_of),
            },
            "extensionsUsed": extensions,
            "extensionsRequired": extensions,
            "scene": 0,
            "scenes": [{"nodes": self._roots}],
            "nodes": self._nodes,
            "meshes": self._meshes,
            "materials": [material],
            "textures": [{"source": n, "sampler": n} for n in range(2)],
            "images": images,
            "samplers": [
                {
                    "magFilter": smooth if mixed else nearest,
                    "minFilter": mipmaps if mixed else nearest,
                    "wrapS": clamped,
                    "wrapT": clamped,
                }
                for mixed in (drawn, False)
            ],
            "buffers": buffers,
            "bufferViews": self._views,
            "accessors": self._accessors,
        }
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        return (
            struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self._packed))
            + struct.pack("<I4s", len(text), b"JSON")
            + text
            + struct.pack("<I4s", len(self._packed), b"BIN\0")
            + bytes(self._packed)
        )


def _joined(pieces: Sequence[Piece], atlas: Atlas) -> tuple[Array, Faces]:
    """Return vertices (V, 9): place, normal, light, place in the picture; and their faces."""
    rows, faces, at = [], [], 0
    for piece in pieces:
        count = len(piece.mesh.vertices)
        if piece.drawing is None or piece.places is None:
            places = np.tile(atlas.of_material(piece.material.name), (count, 1))
        else:
            left, top, right, bottom = atlas.place(piece.drawing)
            places = [left, top] + piece.places * [right - left, bottom - top]
        rows.append(
            np.column_stack([piece.mesh.vertices, piece.mesh.normals, piece.light, places])
        )
        faces.append(piece.mesh.faces + at)
        at += count
    return np.concatenate(rows), np.concatenate(faces)


def _ordered(rows: Array, faces: Faces) -> tuple[NDArray[Any], NDArray[Any], Array, float]:
    """Return vertices and indices as they are stored, and the corner and step of their grid, m."""
    low = rows[:, :3].min(axis=0)
    step = max(float((rows[:, :3].max(axis=0) - low).max()) / STEPS, FINEST)
    stored = np.zeros(len(rows), dtype=VERTEX)
    stored["position"] = np.round((rows[:, :3] - low) / step)
    stored["normal"] = np.round(rows[:, 3:6] * 127)
    stored["light"][:, :3] = np.round(rows[:, 6:7] * 255)
    stored["light"][:, 3] = 255
    stored["places"] = np.round(rows[:, 7:9] * 65535)
    unique, index = np.unique(stored.view((np.void, STRIDE)).ravel(), return_inverse=True)
    vertices = unique.view(stored.dtype)
    corners = index.ravel()[faces]
    whole = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    indices = np.ascontiguousarray(corners[whole].ravel().astype(np.uint32))
    count = len(vertices)
    if meshoptimizer is None:
        return vertices, indices, low, step
    ordered = np.empty_like(indices)
    meshoptimizer.optimize_vertex_cache(ordered, indices, len(indices), count)
    remap = np.empty(count, dtype=np.uint32)
    used = meshoptimizer.optimize_vertex_fetch_remap(remap, ordered, len(ordered), count)
    placed = np.zeros(used, dtype=vertices.dtype)
    kept = remap < used
    placed[remap[kept]] = vertices[kept]
    return placed, np.ascontiguousarray(remap[ordered]), low, step
