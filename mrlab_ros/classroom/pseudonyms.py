"""Takes names off a class: off its roster, and off the files that were handed in."""

from __future__ import annotations

import json
import os
import re
import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import orjson

from mrlab_ros.app.check.file import CELLS
from mrlab_ros.app.convert import SUFFIXES
from mrlab_ros.classroom.diagnostics import KEY_TABLE_NOT_READ, KEY_TABLE_NOT_WRITTEN
from mrlab_ros.classroom.marks.exports import Roster, Submission
from mrlab_ros.classroom.marks.result import named, pseudonymous
from mrlab_ros.core.base.errors import BadInput


def unnamed(key: str, files: Sequence[tuple[str, bytes]]) -> list[tuple[str, bytes]]:
    """Return files under names that say nothing; a cell names its motions by them."""
    names = {
        name: f"{key}-{n}{_ending(name)}" if n > 1 else f"{key}{_ending(name)}"
        for n, (name, _) in enumerate(files, 1)
    }
    if not any(name.lower().endswith(CELLS) for name in names):
        return [(names[name], content) for name, content in files]
    longest = sorted(names, key=len, reverse=True)
    known = re.compile(b"|".join(re.escape(name.encode()) for name in longest))
    return [
        (
            names[name],
            known.sub(lambda found: names[found[0].decode()].encode(), content)
            if name.lower().endswith(CELLS)
            else content,
        )
        for name, content in files
    ]


def _ending(name: str) -> str:
    return next(
        (s for s in sorted(SUFFIXES, key=len, reverse=True) if name.lower().endswith(s)), ""
    )


@dataclass(frozen=True)
class Pseudonyms:
    """A roster without names. key_table: the file beside the class that says who is who; who: by
    pseudonym; label: what a file or folder of the export is called."""

    roster: Roster
    key_table: Path
    who: Mapping[str, Submission]
    label: Callable[[str], str]


def of_roster(roster: Roster, out: Path) -> Pseudonyms:
    """Return the roster without names, and write who is who. Raises BadInput."""
    path = out.with_name(f"{out.name}-names.json")
    try:
        known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        secret = bytes.fromhex(known["secret"]) if known else secrets.token_bytes(32)
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise BadInput(KEY_TABLE_NOT_READ(file=str(path), why=str(error))) from None
    changed, who = pseudonymous(roster, secret)
    students = {
        name: {"name": s.name, "identifier": s.identifier, "email": s.email, "folder": s.folder}
        for name, s in who.items()
    }
    files = {
        new.path: old.path
        for new, old in zip(changed.left_out, roster.left_out, strict=True)
        if old.entry is not None
    }
    content = {
        "secret": secret.hex(),
        "students": {**known.get("students", {}), **students},
        "files": {**known.get("files", {}), **files},
    }
    try:
        written = path.with_name(f".{path.name}-writing")
        descriptor = os.open(written, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        with os.fdopen(descriptor, "wb") as file:
            file.write(orjson.dumps(content, option=orjson.OPT_INDENT_2))
        os.replace(written, path)
    except OSError as error:
        raise BadInput(KEY_TABLE_NOT_WRITTEN(file=str(path), why=error.strerror)) from None
    return Pseudonyms(changed, path, who, partial(named, secret=secret))
