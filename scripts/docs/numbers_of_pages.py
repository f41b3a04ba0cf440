"""Numbers in the prose of pages that code decides: `25 s<!-- mrlab_ros/gateway/x.py WAIT_S -->`.

The comment names a file and a constant, field or parameter in it; the number before it is written
from its value, in the unit that stands there. The unit of the value is its name's suffix
(`_MS`, `_DEG`), else the base unit of SI, bytes, or a part of 1. What a trial found says so:
`5 cm<!-- measured -->`.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable
from pathlib import Path

NUMBER = r"(?P<number>\d[\d,]*(?:\.\d+)?)"
UNITS = {
    "s": 1.0,
    "ms": 1e-3,
    "us": 1e-6,
    "ns": 1e-9,
    "minutes": 60.0,
    "hours": 3600.0,
    "days": 86400.0,
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "km": 1e3,
    "rad": 1.0,
    "degrees": math.pi / 180,
    "deg": math.pi / 180,
    "Hz": 1.0,
    "N": 1.0,
    "kg": 1.0,
    "g": 1e-3,
    "%": 1e-2,
    "bytes": 1.0,
    "kB": 1e3,
    "MB": 1e6,
    "GB": 1e9,
    "KiB": 2.0**10,
    "MiB": 2.0**20,
    "GiB": 2.0**30,
}
UNIT = rf"(?:{'|'.join(sorted(map(re.escape, UNITS), key=len, reverse=True))})"
QUANTITY = re.compile(rf"(?<![\w.,`/-]){NUMBER} ?(?P<unit>{UNIT})(?![\w/])")
MEASURED = re.compile(rf"{NUMBER} ?(?:{UNIT})<!-- measured -->")
SOURCED = re.compile(
    rf"{NUMBER}(?P<between> ?(?P<unit>{UNIT}|[a-z]+)?)<!-- (?P<file>[\w./-]+) (?P<name>\w+) -->"
)
ASSIGNED = re.compile(
    r"^\s*(?:export )?(?:const )?(\w+(?:, \w+)*)(?:\s*:\s*\w+)?\s*[:=] *(\S.*)$", re.MULTILINE
)
OPERATIONS: dict[type[ast.AST], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.LShift: lambda left, right: left * 2**right,
}


def filled(text: str, root: Path) -> str:
    """Return the page `text` with each number that names its source as that has it."""

    def current(found: re.Match[str]) -> str:
        name, unit = found["name"], found["unit"] or ""
        value = value_of(root / found["file"], name) * _scale(name) / UNITS.get(unit, 1.0)
        shown = f"{value:,.6g}" if "," in found["number"] else f"{value:.6g}"
        return f"{shown}{found['between']}<!-- {found['file']} {name} -->"

    return SOURCED.sub(current, text)


def value_of(file: Path, name: str) -> float:
    """Return the number that `name` has in a file of Python, TypeScript or YAML."""
    for names, values in ASSIGNED.findall(file.read_text()):
        known = re.split(r",\s*", names)
        if name in known:
            given = re.split(r"\s#|//|;", values)[0].strip(" ,")
            several = given.split(",") if len(known) > 1 else [given]
            return _number(ast.parse(several[known.index(name)].strip(), mode="eval").body)
    raise SystemExit(f"{file}: no number is called {name}; a page names it as its source")


def _number(node: ast.AST) -> float:
    match node:
        case ast.Constant(value=int() | float()):
            return float(node.value)
        case ast.BinOp() if type(node.op) in OPERATIONS:
            return OPERATIONS[type(node.op)](_number(node.left), _number(node.right))
        case ast.Name():
            return {"SECOND": 1e9, "MS": 1e6, **UNITS}[node.id]
        case ast.Attribute(attr="pi"):
            return math.pi
        case ast.Call(func=ast.Attribute(attr="radians"), args=[angle]):
            return math.radians(_number(angle))
    raise SystemExit(f"this is no number: {ast.unparse(node)}")


def _scale(name: str) -> float:
    """Return the size of the unit that a name ends in."""
    suffix = name.rpartition("_")[2]
    names = {unit.lower(): size for unit, size in UNITS.items()}
    return names.get(suffix.lower(), 1.0) if "_" in name else 1.0


def without_source(text: str) -> list[str]:
    """Return the quantities in the prose of a page that name no source, and no trial."""
    prose = re.sub(r"^```.*?^```$|`[^`\n]*`", "", text, flags=re.M | re.S)
    for known in (SOURCED, MEASURED):
        prose = known.sub("", prose)
    return [found.group() for found in QUANTITY.finditer(prose)]
