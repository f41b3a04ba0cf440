"""docs/diagnostics.md, and the codes with sample values for the tests of other languages."""

from __future__ import annotations

import importlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mrlab_ros.core.base.diagnostic import Code, plain
from mrlab_ros.core.base.phrase import Placeholder

SAMPLES_FILE = "web/test/words/codes.json"
# A value of each quantity, as a reader could meet it.
SAMPLES: dict[str, Any] = {
    "text": "ur5e_1",
    "rows": [7, 9],
    "list": ["a", "b"],
    "either": ["a", "b"],
    "position": [0.42, -0.28, 0.31],
    "problem": "it is damaged",
    "problems": ["it is damaged", "it is empty"],
    "reasons": ["it is damaged", "it is empty"],
    "count": 3,
    "integer": 3,
    "bytes": 1536000,
    "state": "PLAYING",
}
# Rooms whose texts reach terminals and programs only.
TERMINAL = ("mrlab_ros.adapters.robots.importing", "mrlab_ros.client", "mrlab_ros.commands")


def tables(root: Path) -> dict[str, dict[str, Code]]:
    """Return the codes of every module `diagnostics`, by module and name of the constant."""
    found = {}
    for path in sorted(root.joinpath("mrlab_ros").rglob("diagnostics.py")):
        name = ".".join(path.relative_to(root).with_suffix("").parts)
        codes = {k: v for k, v in vars(importlib.import_module(name)).items() if type(v) is Code}
        if codes:
            found[name] = codes
    return found


def sample(code: Code) -> dict[str, Any]:
    """Return a value for each name in the texts of a code."""
    parts = [part for each in code.phrases for part in each.placeholders()]
    values = {part.name: _sample(part) for part in parts}
    if any(part.quantity == "measure" for part in parts):
        values["unit"] = "rad"
    return values


def _sample(part: Placeholder) -> Any:
    if part.quantity == "choice":
        return part.words[0].partition("=")[0]
    return SAMPLES.get(part.quantity, 0.5)


def samples(root: Path) -> str:
    """Return the codes that a page can show: code -> templates, sample values, English texts."""
    lines = []
    for module, codes in tables(root).items():
        if module.startswith(TERMINAL):
            continue
        for code in codes.values():
            if not code.page:
                continue
            values = sample(code)
            found = code(**values)
            entry = {
                "text": code.text,
                "remedy": code.remedy,
                "values": plain(values),
                "en": [found.message, found.remedy],
            }
            body = json.dumps(entry, ensure_ascii=False)
            lines.append(f"  {json.dumps(code.code)}: {body}")
    return "{\n" + ",\n".join(sorted(lines)) + "\n}\n"


def current(root: Path) -> str:
    """Return docs/diagnostics.md."""
    lines = [
        "# Everything that the lab says, by code",
        "",
        "Whatever a person is told has a stable code and typed values beside its text: in the",
        "JSON of the commands and of the gateway, in every service response, state and",
        "diagnostic of the graph. Programs read code and values; texts may change with any",
        "release. An ERROR refuses, a WARNING doubts, an INFO informs; a line beside that says",
        "when a code is raised, where its text does not. Angles are rad, lengths m, times s on",
        "the wire; the texts show degrees and mm. This page is generated from the tables beside",
        "the code.",
    ]
    for module, codes in tables(root).items():
        room = module.removeprefix("mrlab_ros.").removesuffix(".diagnostics").replace(".", "/")
        lines += ["", f"## {room}"]
        for code in codes.values():
            lines += list(_entry(code))
    return re.sub(":matlab}", "}", "\n".join(lines) + "\n")


def _entry(code: Code) -> Iterator[str]:
    yield from ("", f"### {code.code}", "")
    yield f"{code.severity.name}. {code.meaning}".rstrip()
    yield from ("", f"> {code.text}")
    if code.remedy:
        yield from (">", f"> *{code.remedy}*")
    parts = {part.name: part.quantity for each in code.phrases for part in each.placeholders()}
    if parts:
        yield from ("", "Values: " + ", ".join(f"`{n}` ({q})" for n, q in sorted(parts.items())))
    for option, value, matlab in code.fixes:
        ways = [
            f"option `{option}` = `{value}`" if option else "",
            f"`{matlab}`" if matlab else "",
        ]
        yield from ("", f"Fix: {', or '.join(filter(None, ways))}")
    for words in code.commands:
        yield from ("", f"Fix: `{words}`")
