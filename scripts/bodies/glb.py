"""Writes and reads a binary glTF file; the same mesh gives the same bytes.

trimesh writes the same, with indices of 32 bits: docs/dependencies.md has the figures.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, linear, srgb

FLOAT, SHORT, INT = 5126, 5123, 5125


def read(path: Path) -> list[tuple[Material, Mesh]]:
    """Return the pieces of a file that `write` wrote."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + length])
    blob = data[28 + length :]

    def values(number: int) -> np.ndarray:
        accessor = document["accessors"][number]
        at = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        kind = {FLOAT: "<f4", SHORT: "<u2", INT: "<u4"}[accessor["componentType"]]
        width = {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        count = accessor["count"]
        return np.frombuffer(blob, kind, count * width, at).reshape(count, width)

    pieces = []
    for primitive in document["meshes"][0]["primitives"]:
        made = document["materials"][primitive["material"]]
        finish = made["pbrMetallicRoughness"]
        red, green, blue = (round(srgb(value), 4) for value in finish["baseColorFactor"][:3])
        material = Material(
            made["name"],
            (red, green, blue),
            finish["metallicFactor"],
            finish["roughnessFactor"],
            finish["baseColorFactor"][3],
        )
        mesh = Mesh(
            values(primitive["attributes"]["POSITION"]).astype(np.float64),
            values(primitive["indices"]).reshape(-1, 3).astype(np.int64),
            values(primitive["attributes"]["NORMAL"]).astype(np.float64),
        )
        pieces.append((material, mesh))
    return pieces


def write(path: Path, pieces: list[tuple[Material, Mesh]]) -> None:
    """Write one mesh with one primitive per piece, in the link's own frame, metres."""
    blob = bytearray()
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []

    def store(array: np.ndarray, kind: str, component: int, target: int) -> int:
        data = np.ascontiguousarray(array).tobytes()
        views.append(
            {"buffer": 0, "byteOffset": len(blob), "byteLength": len(data), "target": target}
        )
        blob.extend(data)
        blob.extend(b"\0" * (-len(blob) % 4))
        accessor: dict[str, Any] = {
            "bufferView": len(views) - 1,
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if kind == "VEC3" and target == 34962:
            accessor["min"] = [float(v) for v in array.min(axis=0)]
            accessor["max"] = [float(v) for v in array.max(axis=0)]
        accessors.append(accessor)
        return len(accessors) - 1

    primitives, materials = [], []
    for material, mesh in pieces:
        wide = len(mesh.vertices) > 65535
        indices = mesh.faces.ravel().astype(np.uint32 if wide else np.uint16)
        primitives.append(
            {
                "attributes": {
                    "POSITION": store(mesh.vertices.astype(np.float32), "VEC3", FLOAT, 34962),
                    "NORMAL": store(mesh.normals.astype(np.float32), "VEC3", FLOAT, 34962),
                },
                "indices": store(indices, "SCALAR", INT if wide else SHORT, 34963),
                "material": len(materials),
            }
        )
        materials.append(
            {
                "name": material.name,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [
                        *(round(linear(c), 5) for c in material.colour),
                        material.alpha,
                    ],
                    "metallicFactor": material.metalness,
                    "roughnessFactor": material.roughness,
                },
                **({"alphaMode": "BLEND"} if material.alpha < 1 else {}),
            }
        )
    document = {
        "asset": {"version": "2.0", "generator": "mrlab scripts/robots"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": path.stem}],
        "meshes": [{"name": path.stem, "primitives": primitives}],
        "materials": materials,
        "buffers": [{"byteLength": len(blob)}],
        "bufferViews": views,
        "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(blob)
    path.write_bytes(
        struct.pack("<4sII", b"glTF", 2, size)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(blob), b"BIN\0")
        + bytes(blob)
    )
