#!/usr/bin/env python3
"""Write every generated page, and generated parts of pages, anew; `--check` only compares."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "protocol"))

import design_tokens
import diagnostics_page
import licences_page
import message_stubs
import numbers_of_pages
import parameters_page
import playback_vectors
import protocol_page
import protocol_vectors
import roles_page
import rubrics_page
import typescript_protocol

from mrlab_ros.core.base.state_machine import Table
from mrlab_ros.core.physics.grasp import states
from mrlab_ros.core.playback import states as playback
from mrlab_ros.core.recording import recorder as recording
from mrlab_ros.core.systems import states as systems

ROOT = Path(__file__).resolve().parents[2]


# The state machines of the lab: page, name of its blocks, table.
MACHINES: tuple[tuple[str, str, Table], ...] = (
    ("docs/playback.md", "playback", playback.TABLE),
    ("docs/system-states.md", "system", systems.TABLE),
    ("docs/recorder-states.md", "recorder", recording.TABLE),
    ("docs/physics-model.md", "grasp", states.TABLE),
)
BLOCKS: dict[tuple[str, str], Callable[[], str]] = {
    **{(page, f"{name} states"): table.mermaid for page, name, table in MACHINES},
    **{
        (page, f"{name} table"): table.markdown
        for page, name, table in MACHINES
        if page != "docs/physics-model.md"
    },
    ("docs/rubrics.md", "measures"): rubrics_page.measures,
}
FILES: dict[str, Callable[[], str]] = {
    "docs/diagnostics.md": lambda: diagnostics_page.current(ROOT),
    diagnostics_page.SAMPLES_FILE: lambda: diagnostics_page.samples(ROOT),
    licences_page.PAGE: lambda: licences_page.current(ROOT),
    "docs/parameters.md": parameters_page.current,
    "docs/protocol.md": lambda: protocol_page.current(ROOT),
    "mrlab_ros/core/runtime/colours.py": lambda: design_tokens.python(ROOT),
    "web/src/design/tokens.css": lambda: design_tokens.css(ROOT),
    "web/src/design/tokens.ts": lambda: design_tokens.typescript(ROOT),
    "web/test/playback/vectors.json": playback_vectors.current,
    protocol_vectors.FILE: lambda: protocol_vectors.current(ROOT),
    **{
        path: partial(str, content)
        for module in (typescript_protocol, message_stubs, roles_page)
        for path, content in module.files(ROOT).items()
    },
}


def rendered(text: str, name: str, content: str) -> str:
    """Return `text` with the block called `name` filled with `content`."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"no block '{begin}' is in the page; add it where the text belongs")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", text)


def wanted(page: str) -> str:
    """Return what a page should be, given what it is."""
    if page in FILES:
        return FILES[page]()
    text = numbers_of_pages.filled((ROOT / page).read_text(), ROOT)
    for (place, name), make in BLOCKS.items():
        if place == page:
            text = rendered(text, name, make())
    return text


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="exit 1 where a page is out of date")
    check = parser.parse_args().check
    stale = []
    prose = {str(path.relative_to(ROOT)) for path in ROOT.glob("docs/**/*.md")} - set(FILES)
    for page in sorted(prose | set(FILES)):
        path, text = ROOT / page, wanted(page)
        if not path.is_file() or path.read_text() != text:
            stale.append(page)
            if not check:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
    if check and stale:
        print(f"out of date: {', '.join(stale)}; run make docs")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
