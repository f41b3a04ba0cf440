"""Message definitions as a bag carries them: a type's text, then that of every type within."""

from __future__ import annotations

import re
from collections.abc import Callable

SEPARATOR = "=" * 80
FIELD = re.compile(r"^\s*([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z]\w*", re.MULTILINE)
BUILT_IN = frozenset(
    {"bool", "byte", "char", "float32", "float64", "string", "wstring"}
    | {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
)


def full_definition(kind: str, read: Callable[[str], str]) -> str:
    """Return the text of `kind`, such as sensor_msgs/msg/JointState, in the form ros2msg.

    `read` returns the text of one type's .msg file. The types within follow, each once, below a
    line of 80 equals signs and `MSG: package/Name`.
    """
    texts = {kind: read(kind)}
    waiting = [kind]
    while waiting:
        parent = waiting.pop(0)
        for inner in _types_in(texts[parent], parent.split("/")[0]):
            if inner not in texts:
                texts[inner] = read(inner)
                waiting.append(inner)
    parts = [texts.pop(kind)]
    for inner, text in texts.items():
        package, _, name = inner.split("/")
        parts.append(f"{SEPARATOR}\nMSG: {package}/{name}\n{text}")
    return "\n".join(part.rstrip("\n") for part in parts) + "\n"


def _types_in(text: str, package: str) -> list[str]:
    code = "\n".join(line.split("#")[0] for line in text.splitlines())
    found = []
    for written in FIELD.findall(code):
        if written in BUILT_IN:
            continue
        parts = written.split("/")
        owner = parts[0] if len(parts) > 1 else "std_msgs" if written == "Header" else package
        found.append(f"{owner}/msg/{parts[-1]}")
    return found
