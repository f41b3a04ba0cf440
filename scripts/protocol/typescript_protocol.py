"""The message types as TypeScript: interfaces, constants and CDR codecs, a file a package."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from rosbags.interfaces import Nodetype

from mrlab_ros.gateway.lab.definitions import EMPTY, Definitions, texts_of

NOTE = "// Generated from the message definitions by `make docs`.\n"
CONFIG = "config/bridge.yaml"
FOLDER = "web/src/protocol"
SCALARS = {
    "bool": ("boolean", "false"),
    "string": ("string", "''"),
    "uint64": ("bigint", "0n"),
    "int64": ("bigint", "0n"),
}
ARRAYS = {
    "float64": "Float64Array",
    "float32": "Float32Array",
    "int64": "BigInt64Array",
    "uint64": "BigUint64Array",
    "int32": "Int32Array",
    "uint32": "Uint32Array",
    "int16": "Int16Array",
    "uint16": "Uint16Array",
    "int8": "Int8Array",
    "uint8": "Uint8Array",
}
# IDL's names of a byte.
BASES = {"octet": "uint8", "byte": "uint8", "char": "uint8"}


@dataclass(frozen=True)
class Field:
    """A field as TypeScript has it. default, read and write are expressions."""

    name: str
    type: str
    default: str
    read: str
    write: str
    uses: tuple[str, ...]


@dataclass(frozen=True)
class Type:
    """A message, or half of a service. name: such as mrlab_msgs/msg/Seek_Request."""

    name: str
    constants: tuple[tuple[str, Any], ...]
    fields: tuple[Field, ...]
    comments: dict[str, str]

    @property
    def package(self) -> str:
        return self.name.split("/")[0]

    @property
    def short(self) -> str:
        return short(self.name)

    @property
    def ros_name(self) -> str:
        """Its name in ROS: a half of a service is in srv/."""
        return re.sub(r"/msg/(.*_(?:Request|Response))$", r"/srv/\1", self.name)


def short(name: str) -> str:
    return name.split("/")[-1].replace("_", "")


def _lower(name: str) -> str:
    return name[0].lower() + name[1:]


def files(root: Path) -> dict[str, str]:
    """Return path -> content of every generated file."""
    found = types(root)
    services = sorted(
        each.ros_name.removesuffix("_Request")
        for each in found.values()
        if each.ros_name.endswith("_Request")
    )
    packages = sorted({each.package for each in found.values()})
    return {f"{FOLDER}/{package}.ts": _file(package, found, services) for package in packages}


def types(root: Path) -> dict[str, Type]:
    """Return every type of the lab, what the bridge carries, and what they hold, by name."""
    texts = texts_of(root / "msg_schemas")
    store = Definitions(texts).store
    config = yaml.safe_load((root / CONFIG).read_text())
    wanted = [rule["type"] for rule in config["topics"]]
    for name in texts:
        half = name.replace("/srv/", "/msg/")
        wanted += [name] if half == name else [f"{half}_Request", f"{half}_Response"]
    found: dict[str, Type] = {}
    while wanted:
        name = wanted.pop()
        if name in found:
            continue
        constants, fields = store.fielddefs[name]
        found[name] = Type(
            name,
            tuple((constant, value) for constant, _, value in constants),
            tuple(_field(*each) for each in fields if each[0] != EMPTY),
            _comments(texts, name),
        )
        wanted += [used for field in found[name].fields for used in field.uses]
    return found


def _file(package: str, types: dict[str, Type], services: list[str]) -> str:
    own = sorted((each for each in types.values() if each.package == package), key=_order)
    foreign: dict[str, set[str]] = {}
    for each in own:
        for field in each.fields:
            for used in field.uses:
                if types[used].package != package:
                    name = short(used)
                    foreign.setdefault(types[used].package, set()).update(
                        (f"type {name}", f"create{name}", f"read{name}", f"write{name}")
                    )
    mine = [name for name in services if name.startswith(f"{package}/")]
    lines = [NOTE]
    links = "MessageType, ServiceType" if mine else "MessageType"
    lines.append(f"import type {{ {links} }} from '../link/link'")
    lines.append("import { type CdrReader, type CdrWriter, messageType } from './cdr'")
    for other, names in sorted(foreign.items()):
        listed = ", ".join(sorted(names, key=lambda name: name.removeprefix("type ")))
        lines.append(f"import {{ {listed} }} from './{other}'")
    for each in own:
        lines += ["", *_type(each)]
    for name in mine:
        lines += ["", *_service(name)]
    return "\n".join(lines) + "\n"


def _order(each: Type) -> str:
    return each.name


def _type(each: Type) -> Iterator[str]:
    name = each.short
    head = each.comments.get("")
    yield f"/** {each.ros_name}{f': {head}' if head else ''} */"
    if each.fields:
        yield f"export interface {name} {{"
        for field in each.fields:
            comment = each.comments.get(field.name)
            if comment:
                yield f"  /** {comment} */"
            yield f"  {field.name}: {field.type}"
        yield "}"
    else:
        yield f"export type {name} = Record<string, never>"
    if each.constants:
        yield ""
        yield f"export const {name} = {{"
        for constant, value in each.constants:
            comment = each.comments.get(constant)
            if comment:
                yield f"  /** {comment} */"
            yield f"  {constant}: {_literal(value)},"
        yield "} as const"
    yield ""
    yield f"export function create{name}(): {name} {{"
    if each.fields:
        yield "  return {"
        yield from (f"    {field.name}: {field.default}," for field in each.fields)
        yield "  }"
    else:
        yield "  return {}"
    yield "}"
    yield ""
    into = "into" if each.fields else "_"
    yield f"export function read{name}(from: CdrReader, {into}: {name}): void {{"
    yield from (f"  {field.read}" for field in each.fields)
    if not each.fields:
        # ROS puts a byte into a message without fields.
        yield "  from.uint8()"
    yield "}"
    yield ""
    message = "message" if each.fields else "_"
    yield f"export function write{name}(to: CdrWriter, {message}: {name}): void {{"
    yield from (f"  {field.write}" for field in each.fields)
    if not each.fields:
        yield "  to.uint8(0)"
    yield "}"
    yield ""
    yield f"export const {_lower(name)}Type: MessageType<{name}> = /* @__PURE__ */ messageType("
    yield f"  '{each.ros_name}',"
    yield f"  create{name},"
    yield f"  read{name},"
    yield f"  write{name},"
    yield ")"


def _service(name: str) -> Iterator[str]:
    kind = name.split("/")[-1]
    generic = f"ServiceType<{kind}Request, {kind}Response>"
    yield f"export const {_lower(kind)}Type: {generic} = {{"
    yield f"  name: '{name}',"
    yield f"  request: {_lower(kind)}RequestType,"
    yield f"  response: {_lower(kind)}ResponseType,"
    yield "}"


def _field(name: str, kind: Any) -> Field:
    node, detail = kind
    place = f"into.{name}"
    if node is Nodetype.NAME:
        of = short(detail)
        return Field(
            name,
            of,
            f"create{of}()",
            f"read{of}(from, {place})",
            f"write{of}(to, message.{name})",
            (detail,),
        )
    if node is Nodetype.BASE:
        base = BASES.get(detail[0], detail[0])
        kind_of, zero = SCALARS.get(base, ("number", "0"))
        known = place if base == "string" else ""
        return Field(
            name,
            kind_of,
            zero,
            f"{place} = from.{base}({known})",
            f"to.{base}(message.{name})",
            (),
        )
    (inner, inner_detail), length = detail
    # A bounded sequence has its length on the wire, a fixed array has not.
    fixed = f", {length}" if node is Nodetype.ARRAY else ""
    if inner is Nodetype.NAME:
        of = short(inner_detail)
        default = f"Array.from({{ length: {length} }}, create{of})" if fixed else "[]"
        return Field(
            name,
            f"{of}[]",
            default,
            f"{place} = from.messages({place}, create{of}, read{of}{fixed})",
            f"to.messages(message.{name}, write{of}{fixed})",
            (inner_detail,),
        )
    base = BASES.get(inner_detail[0], inner_detail[0])
    if base in ARRAYS:
        kind_of = ARRAYS[base]
        default = f"new {kind_of}({length if fixed else 0})"
    else:
        kind_of, zero = SCALARS[base]
        default = f"new Array<{kind_of}>({length}).fill({zero})" if fixed else "[]"
        kind_of = f"{kind_of}[]"
    return Field(
        name,
        kind_of,
        default,
        f"{place} = from.{base}s({place}{fixed})",
        f"to.{base}s(message.{name}{fixed})",
        (),
    )


def _comments(texts: dict[str, str], name: str) -> dict[str, str]:
    """Return field or constant -> the comment behind it; "": the one at the head."""
    half = ""
    if name.endswith(("_Request", "_Response")):
        name, _, half = name.replace("/msg/", "/srv/").rpartition("_")
    text = texts.get(name, "")
    if half:
        text = text.partition("---")[0 if half == "Request" else 2]
    found: dict[str, str] = {}
    head = []
    for line in text.splitlines():
        code, _, comment = line.partition("#")
        comment = comment.strip().replace("*/", "* /")
        words = code.replace("=", " ").split()
        if len(words) >= 2:
            found[words[1]] = comment
        elif comment and not found:
            head.append(comment)
    found[""] = " ".join(head)
    return found


def _literal(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return "'" + value.replace("\\", "\\\\").replace("'", "\\'") + "'"
    return repr(value)
