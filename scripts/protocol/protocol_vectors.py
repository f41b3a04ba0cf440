"""Two messages of every type that has a codec, with their CDR, for the tests of the codecs."""

from __future__ import annotations

import base64
import json
import random
from pathlib import Path
from typing import Any

import typescript_protocol
from rosbags.interfaces import Nodetype

from mrlab_ros.gateway.lab.definitions import EMPTY, Definitions, texts_of

FILE = "web/test/protocol/vectors.json"
WORDS = ("", "a", "shoulder_pan_joint", "grün 🤖", "a text that is longer than a name would be")
WIDTHS = {"8": 1 << 7, "16": 1 << 15, "32": 1 << 31, "64": 1 << 63}


def current(root: Path) -> str:
    """Return the file: type -> [{"values", "cdr"}, ...]; 64-bit integers are texts."""
    definitions = Definitions(texts_of(root / "msg_schemas"))
    lines = []
    types = typescript_protocol.types(root)
    for name in typescript_protocol.codecs(root):
        chance = random.Random(name)
        pair = []
        for _ in range(2):
            values = _message(definitions, name, chance)
            cdr = base64.b64encode(definitions.encode(name, values)).decode()
            pair.append({"values": _json(definitions, name, values), "cdr": cdr})
        entry = json.dumps(pair, ensure_ascii=False, separators=(",", ":"))
        lines.append(f"  {json.dumps(types[name].ros_name)}: {entry}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _message(definitions: Definitions, name: str, chance: random.Random) -> dict[str, Any]:
    fields = definitions.store.fielddefs[name][1]
    return {field: _value(definitions, kind, chance) for field, kind in fields if field != EMPTY}


def _value(definitions: Definitions, kind: Any, chance: random.Random) -> Any:
    node, detail = kind
    if node is Nodetype.NAME:
        return _message(definitions, detail, chance)
    if node is Nodetype.BASE:
        return _scalar(detail[0], chance)
    inner, length = detail
    count = length if node is Nodetype.ARRAY else chance.choice((0, 1, 2, 3))
    return [_value(definitions, inner, chance) for _ in range(count)]


def _scalar(base: str, chance: random.Random) -> Any:
    if base == "string":
        return chance.choice(WORDS)
    if base == "bool":
        return chance.random() < 0.5
    if base.startswith("float"):
        # Representable in 32 bits too.
        return chance.randrange(-(1 << 20), 1 << 20) / 1024
    half = WIDTHS["8" if base in ("octet", "byte", "char") else base.lstrip("uint")]
    if base == "byte":
        # rosbags takes it for a signed one, the pages for an unsigned one.
        return chance.randrange(half)
    return chance.randrange(-half, half) if base.startswith("int") else chance.randrange(2 * half)


def _json(definitions: Definitions, name: str, values: dict[str, Any]) -> dict[str, Any]:
    kinds = dict(definitions.store.fielddefs[name][1])
    return {field: _shown(definitions, kinds[field], value) for field, value in values.items()}


def _shown(definitions: Definitions, kind: Any, value: Any) -> Any:
    node, detail = kind
    if node is Nodetype.NAME:
        return _json(definitions, detail, value)
    if node is Nodetype.BASE:
        return str(value) if detail[0].endswith("64") and "int" in detail[0] else value
    return [_shown(definitions, detail[0], each) for each in value]
