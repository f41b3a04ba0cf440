"""The message types as TypeScript: interfaces, constants and CDR codecs, a file a package.

Only what `web/` imports is generated: `robotsReader` decodes, `presenceWriter` encodes, `seekType`
is a service, whose request is encoded and whose response is decoded.
"""

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


IMPORTERS = ("web/src", "web/test", "web/bench")
IMPORT = re.compile(r"import (type )?\{([^}]*)\} from '[^']*/protocol/(\w+_(?:msgs|interfaces))'")
# Names that pages import, and the part of a message or service that each is.
NAMES = (
    (re.compile("create(.+)"), "create"),
    (re.compile("(.+)Reader"), "reader"),
    (re.compile("(.+)Writer"), "writer"),
    (re.compile("(.+)Type"), "service"),
)
# The parts of a message that another part of it uses.
USES = {
    "interface": (),
    "constants": ("interface",),
    "create": ("interface",),
    "read": ("create",),
    "write": ("interface",),
    "reader": ("read",),
    "writer": ("write",),
}
# The parts that the file of another package may use, by how their names begin.
SHARED = {"interface": "type ", "create": "create", "read": "read", "write": "write"}
HELPERS = [
    "type MessageReader",
    "type MessageWriter",
    "messageReader",
    "messageWriter",
    "type ServiceType",
    "serviceType",
]


@dataclass(frozen=True)
class Need:
    """A part of a message that a page uses. what: a key of USES; of: the message's name."""

    what: str
    of: str


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
    def is_half(self) -> bool:
        """Whether it is the request or the response of a service."""
        return self.name.endswith(("_Request", "_Response"))

    @property
    def ros_name(self) -> str:
        """Its name in ROS: a half of a service is in srv/."""
        return re.sub(r"/msg/(.*_(?:Request|Response))$", r"/srv/\1", self.name)


def short(name: str) -> str:
    return name.split("/")[-1].replace("_", "")


def _lower(name: str) -> str:
    return name[0].lower() + name[1:]


def files(root: Path) -> dict[str, str]:
    """Return path -> content of every generated file: what `web/` imports, and what that uses."""
    known = types(root)
    imported = _imported(root, known)
    same = _same(known)
    needs = _closed({Need(need.what, same.get(need.of, need.of)) for need in imported}, known)
    responses = {name: short(same[f"{name}_Response"]) for name in _services(imported, known)}
    packages = sorted({known[need.of].package for need in needs})
    return {
        f"{FOLDER}/{package}.ts": _file(package, known, needs, responses) for package in packages
    }


def _same(known: dict[str, Type]) -> dict[str, str]:
    """Return response -> the response whose interface and codec it shares: the fields are equal.

    Of equal responses the one stands for all whose request has the fewest fields.
    """
    groups: dict[tuple[str, tuple[Field, ...]], list[str]] = {}
    for name, each in known.items():
        if name.endswith("_Response"):
            groups.setdefault((each.package, each.fields), []).append(name)

    def size(name: str) -> tuple[int, str]:
        return len(known[name.replace("_Response", "_Request")].fields), name

    return {name: min(group, key=size) for group in groups.values() for name in group}


def _services(needs: set[Need], known: dict[str, Type]) -> list[str]:
    """Return the services that are called, such as mrlab_msgs/msg/Seek."""
    requests = {need.of for need in needs if need.what == "writer" and known[need.of].is_half}
    return sorted(name.removesuffix("_Request") for name in requests)


def codecs(root: Path) -> list[str]:
    """Return the names of the messages that the pages receive or send, without those in others."""
    known = types(root)
    needs = _imported(root, known)
    return sorted({need.of for need in needs if need.what in ("reader", "writer")})


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


def _imported(root: Path, known: dict[str, Type]) -> set[Need]:
    """Return the needs of every import of a generated name in `web/`."""
    by_short = {(each.package, each.short): each.name for each in known.values()}
    found: set[Need] = set()
    for folder in IMPORTERS:
        for path in sorted((root / folder).rglob("*.ts*")):
            for all_types, names, package in IMPORT.findall(path.read_text()):
                for name in filter(None, (each.strip() for each in names.split(","))):
                    needs = _named(name, package, by_short)
                    if needs is None:
                        raise SystemExit(f"{path} imports {name}, which {package} does not have")
                    found |= {each for each in needs if each.what != "constants" or not all_types}
    return found


def _named(name: str, package: str, by_short: dict[tuple[str, str], str]) -> set[Need] | None:
    """Return the needs of an imported name such as `Robot` or `robotReader`; None: unknown."""
    plain = name.removeprefix("type ")
    found = by_short.get((package, plain))
    if found is not None:
        kinds = ["interface"] if plain != name else ["interface", "constants"]
        return {Need(kind, found) for kind in kinds}
    for pattern, kind in NAMES:
        match = pattern.fullmatch(plain)
        if match is None:
            continue
        short_name = match[1][0].upper() + match[1][1:]
        if kind == "service":
            request = by_short.get((package, f"{short_name}Request"))
            response = by_short.get((package, f"{short_name}Response"))
            if request is not None and response is not None:
                return {Need("writer", request), Need("reader", response)}
        elif (found := by_short.get((package, short_name))) is not None:
            return {Need(kind, found)}
    return None


def _closed(needs: set[Need], known: dict[str, Type]) -> set[Need]:
    """Return the needs with all that they use."""
    found: set[Need] = set()
    wanted = list(needs)
    while wanted:
        need = wanted.pop()
        if need in found:
            continue
        found.add(need)
        wanted += [Need(what, need.of) for what in USES[need.what]]
        for field in known[need.of].fields:
            made = need.what == "create" and "create" in field.default
            if made or need.what in ("interface", "read", "write"):
                wanted += [Need(need.what, used) for used in field.uses]
    return found


def _file(
    package: str, known: dict[str, Type], needs: set[Need], responses: dict[str, str]
) -> str:
    """Return the file of a package. responses: service -> the interface of its response."""
    own = sorted({need.of for need in needs if known[need.of].package == package})
    blocks = [_type(known[name], {need.what for need in needs if need.of == name}) for name in own]
    blocks += [
        list(_service(known[f"{name}_Request"], response))
        for name, response in responses.items()
        if known[f"{name}_Request"].package == package
    ]
    body = "\n".join(line for block in blocks for line in ("", *block))
    return NOTE + "\n" + "".join(_imports(package, known, needs, body)) + body + "\n"


def _imports(package: str, known: dict[str, Type], needs: set[Need], body: str) -> Iterator[str]:
    """Return the imports of a file that has `body`."""
    groups = {"./cdr": ["type CdrReader", "type CdrWriter"], "./message_type": HELPERS}
    for need in needs:
        each = known[need.of]
        if each.package != package and need.what in SHARED:
            name = SHARED[need.what] + each.short
            groups.setdefault(f"./{each.package}", []).append(name)
    for path, names in sorted(groups.items()):
        used = [name for name in names if re.search(rf"\b{name.split()[-1]}\b", body)]
        if used:
            listed = ", ".join(sorted(used, key=lambda name: name.removeprefix("type ")))
            head = "import"
            if all(name.startswith("type ") for name in used):
                head, listed = "import type", listed.replace("type ", "")
            yield f"{head} {{ {listed} }} from '{path}'\n"


def _type(each: Type, needs: set[str]) -> list[str]:
    """Return the lines of a message, or of half of a service."""
    makers = (_interface, _constants, _create, _read, _write)
    if not each.is_half:
        makers += (_reader, _writer)
    parts = [list(make(each)) for make in makers if make.__name__.removeprefix("_") in needs]
    head = each.comments.get("")
    lines = [f"/** {each.ros_name}{f': {head}' if head else ''} */"]
    for number, part in enumerate(parts):
        lines += ["", *part] if number else part
    return lines


def _interface(each: Type) -> Iterator[str]:
    if not each.fields:
        yield f"export type {each.short} = Record<string, never>"
        return
    yield f"export interface {each.short} {{"
    for field in each.fields:
        if comment := each.comments.get(field.name):
            yield f"  /** {comment} */"
        yield f"  {field.name}: {field.type}"
    yield "}"


def _constants(each: Type) -> Iterator[str]:
    yield f"export const {each.short} = {{"
    for constant, value in each.constants:
        if comment := each.comments.get(constant):
            yield f"  /** {comment} */"
        yield f"  {constant}: {_literal(value)},"
    yield "} as const"


def _create(each: Type) -> Iterator[str]:
    yield f"export function create{each.short}(): {each.short} {{"
    yield "  return {" if each.fields else "  return {}"
    yield from (f"    {field.name}: {field.default}," for field in each.fields)
    if each.fields:
        yield "  }"
    yield "}"


def _read(each: Type) -> Iterator[str]:
    into = "into" if each.fields else "_"
    yield f"export function read{each.short}(from: CdrReader, {into}: {each.short}): void {{"
    yield from (f"  {field.read}" for field in each.fields)
    if not each.fields:
        # ROS puts a byte into a message without fields.
        yield "  from.uint8()"
    yield "}"


def _write(each: Type) -> Iterator[str]:
    message = "message" if each.fields else "_"
    yield f"export function write{each.short}(to: CdrWriter, {message}: {each.short}): void {{"
    yield from (f"  {field.write}" for field in each.fields)
    if not each.fields:
        yield "  to.uint8(0)"
    yield "}"


def _reader(each: Type) -> Iterator[str]:
    name = each.short
    head = f"export const {_lower(name)}Reader: MessageReader<{name}>"
    yield f"{head} = /* @__PURE__ */ messageReader("
    yield f"  '{each.ros_name}',"
    yield f"  create{name},"
    yield f"  read{name},"
    yield ")"


def _writer(each: Type) -> Iterator[str]:
    name = each.short
    head = f"export const {_lower(name)}Writer: MessageWriter<{name}>"
    yield f"{head} = /* @__PURE__ */ messageWriter("
    yield f"  '{each.ros_name}',"
    yield f"  write{name},"
    yield ")"


def _service(request: Type, response: str) -> Iterator[str]:
    kind = request.short.removesuffix("Request")
    generic = f"ServiceType<{request.short}, {response}>"
    yield f"export const {_lower(kind)}Type: {generic} = /* @__PURE__ */ serviceType("
    yield f"  '{request.ros_name.removesuffix('_Request')}',"
    yield f"  write{request.short},"
    yield f"  create{response},"
    yield f"  read{response},"
    yield ")"


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
