"""The message types as stubs for mypy: `typings/PACKAGE/{msg,srv,action}.pyi`.

Stubs are written of all types of mrlab_msgs, of the other types that `mrlab_ros` imports, and of
the types in their fields. mrlab_msgs is read from its definitions, the others as installed.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from rosbags.interfaces import Nodetype

from mrlab_ros.gateway.lab.definitions import EMPTY, PACKAGE, Definitions, texts_of

FOLDER = "typings"
NOTE = "# Generated from the message definitions by `make docs`.\n"
MODULE = re.compile(r"\w+\.(?:msg|srv|action)")
# The classes within a service or an action.
PARTS = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
SCALARS = {
    "float": "float",
    "double": "float",
    "bool": "bool",
    "octet": "bytes",
    "string": "str",
    "wstring": "str",
}
SEQUENCE = re.compile(r"sequence<([^,>]+)[^>]*>|(.+)\[\d+\]")
# Sequences of numbers are arrays; a sequence of any kind can be assigned.
BASES = '''"""Bases of the stubs: fields that hold numbers, and services."""

from array import array
from collections.abc import Sequence
from typing import Any, Generic, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Number = TypeVar("Number", int, float)
Request = TypeVar("Request")
Response = TypeVar("Response")

Numbers: TypeAlias = Sequence[Number] | array[Number] | NDArray[np.number[Any]]

class NumbersField(Generic[Number]):
    def __get__(self, message: object, owner: object = ...) -> array[Number]: ...
    def __set__(self, message: object, values: Numbers[Number]) -> None: ...

class Service(Generic[Request, Response]):
    Request: type[Request]
    Response: type[Response]
'''


@dataclass(frozen=True)
class Message:
    """A message, or a part of a service or an action. fields: name -> type in Python, many."""

    fields: dict[str, tuple[str, bool]]
    constants: dict[str, Any]


class Types:
    """The types by module, such as mrlab_msgs.srv, and name."""

    def __init__(self, root: Path) -> None:
        texts = texts_of(root / "msg_schemas")
        self.own = {
            (f"{PACKAGE}.{kind}", name) for _, kind, name in (text.split("/") for text in texts)
        }
        self._defined = Definitions(texts).store.fielddefs

    def parts(self, module: str, name: str) -> list[tuple[str, Message]]:
        """Return the message, or the parts of a service or an action, with their names."""
        parts = PARTS.get(module.split(".")[1])
        if (module, name) in self.own:
            names = [name] if parts is None else [f"{name}_{part}" for part in parts]
            found = [_defined(*self._defined[f"{PACKAGE}/msg/{each}"]) for each in names]
        else:
            whole = getattr(import_module(module), name)
            classes = [whole] if parts is None else [getattr(whole, part) for part in parts]
            found = [_installed(each) for each in classes]
        return list(zip(parts or (name,), found, strict=True))


def files(root: Path) -> dict[str, str]:
    """Return path -> content of every stub."""
    types = Types(root)
    found = _closed(types, types.own | _imported(root))
    content = {f"{FOLDER}/message_bases.pyi": NOTE + BASES}
    for module in sorted({module for module, _ in found}):
        package, kind = module.split(".")
        names = sorted(name for other, name in found if other == module)
        content[f"{FOLDER}/{package}/__init__.pyi"] = ""
        content[f"{FOLDER}/{package}/{kind}.pyi"] = _file(types, module, names)
    return content


def _imported(root: Path) -> set[tuple[str, str]]:
    """Return module and name of every type that `mrlab_ros` imports."""
    return {
        (str(node.module), each.name)
        for path in sorted((root / "mrlab_ros").rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.ImportFrom) and MODULE.fullmatch(node.module or "")
        for each in node.names
    }


def _closed(types: Types, wanted: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """Return the types with those in their fields."""
    found: set[tuple[str, str]] = set()
    while wanted:
        found |= wanted
        elements = {
            element
            for each in wanted
            for _, message in types.parts(*each)
            for element, _ in message.fields.values()
        }
        used = {tuple(element.rsplit(".", 1)) for element in elements if "." in element}
        wanted = {(module, name) for module, name in used} - found
    return found


def _defined(constants: list[Any], fields: list[Any]) -> Message:
    """Return a type as its definition says."""
    return Message(
        {name: _element(kind) for name, kind in fields if name != EMPTY},
        {name: value for name, _, value in constants},
    )


def _element(kind: Any) -> tuple[str, bool]:
    """Return the type of a field or of its elements in Python, and whether there are many."""
    node, detail = kind
    if node is Nodetype.NAME:
        return detail.replace("/", "."), False
    if node is Nodetype.BASE:
        return _scalar(detail[0]), False
    return _element(detail[0])[0], True


def _installed(message: Any) -> Message:
    """Return a type as its class says."""
    fields = {}
    for name, kind in message.get_fields_and_field_types().items():
        match = SEQUENCE.fullmatch(kind)
        element = (match[1] or match[2]) if match else kind
        of = element.replace("/", ".msg.") if "/" in element else _scalar(element)
        fields[name] = of, match is not None
    return Message(fields, getattr(type(message), f"_{type(message).__name__}__constants", {}))


def _scalar(name: str) -> str:
    """Return the type of a number or text in Python."""
    return next((python for start, python in SCALARS.items() if name.startswith(start)), "int")


def _file(types: Types, module: str, names: list[str]) -> str:
    body = "\n".join(line for name in names for line in ("", *_type(types, module, name)))
    body = body.replace(f"{module}.", "")
    used = sorted(set(re.findall(r"\b(\w+\.msg)\.", body)))
    imports = [f"import {each}" for each in used]
    if "Sequence[" in body:
        imports.insert(0, "from collections.abc import Sequence")
    if "ClassVar" in body:
        imports.append("from typing import ClassVar")
    imports += [
        f"from message_bases import {name}"
        for name in ("Numbers", "NumbersField", "Service")
        if f"{name}[" in body
    ]
    return NOTE + "\n".join(imports) + "\n" + body + "\n"


def _type(types: Types, module: str, name: str) -> Iterator[str]:
    if module.endswith(".msg"):
        for part, message in types.parts(module, name):
            yield from _class(part, message)
        return
    is_service = module.endswith(".srv")
    yield f"class {name}{f'(Service[{name}.Request, {name}.Response])' if is_service else ''}:"
    for part, message in types.parts(module, name):
        yield from (f"    {line}" for line in _class(part, message))


def _class(name: str, message: Message) -> Iterator[str]:
    yield f"class {name}:"
    for constant, value in sorted(message.constants.items()):
        yield f"    {constant}: ClassVar[{type(value).__name__}]"
    fields = {field: _field(*kind) for field, kind in message.fields.items()}
    yield from (f"    {field}: {kind}" for field, (kind, _) in fields.items())
    given = "".join(f", {field}: {kind} = ..." for field, (_, kind) in fields.items())
    yield f"    def __init__(self{', *' if given else ''}{given}) -> None: ..."


def _field(element: str, many: bool) -> tuple[str, str]:
    """Return the type of a field, and of what its constructor takes."""
    if not many:
        return element, element
    if element in ("int", "float"):
        return f"NumbersField[{element}]", f"Numbers[{element}]"
    return f"list[{element}]", f"Sequence[{element}]"
