"""Key expressions: keys in which `*` stands for one part and `**` for any parts."""

from __future__ import annotations

import re
from functools import lru_cache


@lru_cache(maxsize=4096)
def pattern(expression: str) -> re.Pattern[str]:
    """Return the pattern that the keys of an expression match."""
    parts = {"*": "/[^/]+", "**": "(?:/[^/]+)*"}
    return re.compile("".join(parts.get(p, "/" + re.escape(p)) for p in expression.split("/")))


def matches(expression: str, key: str) -> bool:
    """Return whether a key belongs to an expression."""
    return pattern(expression).fullmatch(f"/{key}") is not None
