"""Meshes as small glTF files: KHR_mesh_quantization, which the pages' reader knows.

And what a mesh file holds, as `mesh_copies.py` finds it.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.robots.diagnostics import ROBOT_MESH_UNREADABLE
from mrlab_ros.core.base.errors import BadInput

MAGIC, JSON_CHUNK, BIN_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, SHORT, BYTE = 5126, 5122, 5120
EXTENSION = "KHR_mesh_quantization"
SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def quantised(path: Path) -> bytes:
    """Return a mesh file of any known format as GLB with 16 bits a coordinate, 8 a normal.

    Positions are off by at most 1/65000 of the mesh's longest side. Raises BadInput where the
    file cannot be read.
    """
    data = _read(path)
    if data[:4] != struct.pack("<I", MAGIC):
        data = _as_glb(path)
    head, binary = _parts(data, path)
    return _glb(*_smaller(head, binary))


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        why = error.strerror or str(error)
        raise BadInput(ROBOT_MESH_UNREADABLE(uri=str(path), why=why)) from None


def _as_glb(path: Path) -> bytes:
    import trimesh

    try:
        exported = trimesh.load_scene(path).export(file_type="glb")
    except Exception as error:  # every mesh reader has errors of its own
        why = str(error) or type(error).__name__
        raise BadInput(ROBOT_MESH_UNREADABLE(uri=path.name, why=why)) from None
    assert isinstance(exported, bytes)
    return exported


def _parts(data: bytes, path: Path) -> tuple[dict[str, Any], bytes]:
    """Return the JSON and the binary part of a GLB."""
    try:
        length, kind = struct.unpack_from("<II", data, 12)
        if kind != JSON_CHUNK:
            raise ValueError("its first chunk is not JSON")
        head = json.loads(data[20 : 20 + length])
        rest = data[20 + length :]
        return head, rest[8 : 8 + struct.unpack_from("<I", rest)[0]] if rest else b""
    except (struct.error, ValueError) as error:
        raise BadInput(ROBOT_MESH_UNREADABLE(uri=path.name, why=str(error))) from None


def _smaller(head: dict[str, Any], binary: bytes) -> tuple[dict[str, Any], bytes]:
    """Return both parts with short positions and normals, and no buffer view left unused."""
    accessors = head.get("accessors", [])
    primitives = [p for mesh in head.get("meshes", []) for p in mesh["primitives"]]
    plain = not any("targets" in p or "extensions" in p for p in primitives)
    if not primitives or not plain or head.get("skins") or head.get("animations"):
        return head, binary
    uses = [p["attributes"] for p in primitives]
    positions = {a["POSITION"] for a in uses if _is_float(accessors[a["POSITION"]])}
    normals = {a["NORMAL"] for a in uses if "NORMAL" in a and _is_float(accessors[a["NORMAL"]])}
    if any("sparse" in one or "bufferView" not in one for one in accessors) or not positions:
        return head, binary
    values = {i: _values(accessors[i], head, binary) for i in positions}
    low = np.min([v.min(axis=0) for v in values.values()], axis=0)
    high = np.max([v.max(axis=0) for v in values.values()], axis=0)
    middle, half = (low + high) / 2, float((high - low).max()) / 2 or 1.0

    written: list[bytes] = []
    views: list[dict[str, Any]] = []

    def add(content: bytes, view: Mapping[str, Any]) -> int:
        offset = sum(map(len, written))
        written.append(content + bytes(-len(content) % 4))
        views.append({**view, "buffer": 0, "byteOffset": offset, "byteLength": len(content)})
        return len(views) - 1

    for number, accessor in enumerate(accessors):
        target = head["bufferViews"][accessor["bufferView"]].get("target")
        view: dict[str, Any] = {} if target is None else {"target": target}
        if number in positions:
            shorts = np.rint((values[number] - middle) / half * 32767).astype("<i2")
            accessor.update(
                componentType=SHORT,
                normalized=True,
                min=shorts.min(axis=0).tolist(),
                max=shorts.max(axis=0).tolist(),
            )
            content = _padded(shorts)
            view["byteStride"] = 8
        elif number in normals:
            found = _values(accessor, head, binary)
            content = _padded(np.rint(np.clip(found, -1, 1) * 127).astype("i1"))
            accessor.update(componentType=BYTE, normalized=True)
            accessor.pop("min", None)
            accessor.pop("max", None)
            view["byteStride"] = 4
        else:
            content = np.ascontiguousarray(_values(accessor, head, binary)).tobytes()
        accessor["bufferView"] = add(content, view)
        accessor.pop("byteOffset", None)
    for image in head.get("images", []):
        if "bufferView" not in image:
            continue
        source = head["bufferViews"][image["bufferView"]]
        begin = source.get("byteOffset", 0)
        image["bufferView"] = add(binary[begin : begin + source["byteLength"]], {})
    head["bufferViews"] = views
    packed = b"".join(written)
    head["buffers"] = [{"byteLength": len(packed)}]
    _scale_back(head, middle.tolist(), half)
    head["extensionsUsed"] = sorted({*head.get("extensionsUsed", []), EXTENSION})
    head["extensionsRequired"] = sorted({*head.get("extensionsRequired", []), EXTENSION})
    return head, packed


def _scale_back(head: dict[str, Any], middle: list[float], half: float) -> None:
    """Move each mesh to a node of its own below, which brings the shorts back to metres."""
    nodes = head["nodes"]
    for node in list(nodes):
        if "mesh" in node:
            nodes.append({"mesh": node.pop("mesh"), "translation": middle, "scale": [half] * 3})
            node.setdefault("children", []).append(len(nodes) - 1)


def _is_float(accessor: Mapping[str, Any]) -> bool:
    return bool(accessor["componentType"] == FLOAT)


def _values(accessor: Mapping[str, Any], head: Mapping[str, Any], binary: bytes) -> NDArray[Any]:
    """Return the values of an accessor, (count, components), whatever their stride."""
    size, width = SIZES[accessor["componentType"]], COMPONENTS[accessor["type"]]
    view = head["bufferViews"][accessor["bufferView"]]
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    kinds = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
    return np.ndarray(
        (accessor["count"], width),
        kinds[accessor["componentType"]],
        binary,
        begin,
        (view.get("byteStride") or size * width, size),
    )


def _padded(values: NDArray[Any]) -> bytes:
    """Return (N, 3) numbers with a fourth that is 0: each row begins at a multiple of 4 bytes."""
    return np.pad(values, ((0, 0), (0, 1))).tobytes()


def _glb(head: Mapping[str, Any], binary: bytes) -> bytes:
    text = json.dumps(head, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    length = 12 + 8 + len(text) + 8 + len(binary)
    return b"".join(
        (
            struct.pack("<III", MAGIC, 2, length),
            struct.pack("<II", len(text), JSON_CHUNK),
            text,
            struct.pack("<II", len(binary), BIN_CHUNK),
            binary,
        )
    )


COLLISION = "collision"
FORMATS = (".stl", ".dae", ".obj", ".glb", ".gltf")


@dataclass(frozen=True)
class Look:
    """The contents of a mesh file.

    size: its longest side in the file's unit. problem: why it cannot be read, as `plain` has it.
    missing: files that it names and that were not found, or not taken. visual, solid: names of
    its copies.
    """

    size: float = 0.0
    problem: Mapping[str, Any] | None = None
    missing: Sequence[str] = ()
    visual: str = ""
    solid: str = ""
