#!/usr/bin/env python3
"""Write the generated parts of the documentation anew; `--check` only compares."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Mapping
from enum import Enum
from pathlib import Path

from mrlab_ros.core import playback_states, system_states
from mrlab_ros.core.physics import grasp

DOCS = Path(__file__).resolve().parent.parent / "docs"


def diagram(transitions: Mapping[tuple[Enum, Enum], Enum], first: str) -> str:
    """Draw a table of transitions as a Mermaid state diagram."""
    lines = ["```mermaid", "stateDiagram-v2", f"    [*] --> {first}"]
    for (state, event), target in transitions.items():
        lines.append(f"    {state.name} --> {target.name}: {event.value}")
    return "\n".join([*lines, "```"])


BLOCKS: dict[tuple[str, str], Callable[[], str]] = {
    ("playback.md", "playback states"): lambda: diagram(playback_states.TRANSITIONS, "IDLE"),
    ("physics.md", "grasp states"): lambda: diagram(grasp.TRANSITIONS, "OPEN"),
    ("systems.md", "system states"): lambda: diagram(system_states.TRANSITIONS, "READY"),
}


def rendered(text: str, name: str, content: str) -> str:
    """Return `text` with the block called `name` filled with `content`."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"no block '{begin}' is in the page; add it where the text belongs")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="exit 1 where a page is out of date")
    check = parser.parse_args().check
    stale = []
    for (page, name), make in BLOCKS.items():
        path = DOCS / page
        old = path.read_text()
        new = rendered(old, name, make())
        if new != old:
            stale.append(f"{page}: {name}")
            if not check:
                path.write_text(new)
    if check and stale:
        print(f"out of date: {', '.join(stale)}; run python scripts/generate_docs.py")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
