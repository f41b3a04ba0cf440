"""All definitions that a client decodes the lab with, in one JSON document."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.messages.definitions import text_of, types_in
from mrlab_ros.messages.qos import message_class

OWN_PACKAGE = "mrlab_msgs"
VERSION = 1


def schema(types: Iterable[str]) -> bytes:
    """Return the definitions of all types of the lab, of `types`, and of all types within.

    A JSON document: `messages` and `services` with the text of each type, such as
    sensor_msgs/msg/JointState, and `hashes` with each type's hash (REP 2011). Types that are not
    installed are left out.
    """
    wanted = sorted({*_own(), *types})
    kinds = [kind for kind in wanted if _is_installed(kind)]
    for kind in kinds:  # grows while it is read
        kinds += [inner for inner in dict.fromkeys(_within(kind)) if inner not in kinds]
    texts = {kind: text_of(kind) for kind in sorted(kinds)}
    document = {
        "version": VERSION,
        "messages": {kind: text for kind, text in texts.items() if "/msg/" in kind},
        "services": {kind: text for kind, text in texts.items() if "/srv/" in kind},
        "hashes": {kind: value for kind in texts for kind, value in _hashes(kind)},
    }
    return json.dumps(document).encode()


def _own() -> Iterator[str]:
    share = Path(get_package_share_directory(OWN_PACKAGE))
    for folder in ("msg", "srv"):
        for file in share.glob(f"{folder}/*.{folder}"):
            yield f"{OWN_PACKAGE}/{folder}/{file.stem}"


def _is_installed(kind: str) -> bool:
    try:
        message_class(kind)
        text_of(kind)
    except BadInput:
        return False
    return True


def _within(kind: str) -> Iterator[str]:
    found: Any = message_class(kind)
    for part in (found,) if "/msg/" in kind else (found.Request, found.Response):
        yield from types_in(part)


def _hashes(kind: str) -> Iterator[tuple[str, str]]:
    """Yield a type with its hash, and a service's request and response with theirs."""
    package, folder, name = kind.split("/")
    names = (kind,) if folder == "msg" else (kind, f"{kind}_Request", f"{kind}_Response")
    try:
        file = Path(get_package_share_directory(package)) / folder / f"{name}.json"
        known = json.loads(file.read_text())["type_hashes"]
    except (PackageNotFoundError, OSError, ValueError, KeyError):
        return
    for entry in known:
        if entry["type_name"] in names:
            yield entry["type_name"], entry["hash_string"]
