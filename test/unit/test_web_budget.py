"""How many bytes a page loads, from the built files."""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterable
from pathlib import Path

import pytest

DIST = Path(__file__).parents[2] / "web" / "dist"
# gzip, bytes, with what the lab says in German: half of it is the table of codes
WITHOUT_3D, WITH_3D = 120_000, 360_000
PAGES = (
    "src/pages/upload/page.tsx",
    "src/pages/trajectories/page.tsx",
    "src/pages/people/page.tsx",
    "src/pages/account/sign_in.tsx",
    "src/pages/account/pair.tsx",
    "src/pages/account/invitation.tsx",
)
# What these pages load for a motion that is shown, published and read in German.
MOTION = (
    "src/pages/motion/motion_view.tsx",
    "src/pages/motion/link_with_code.tsx",
    "src/scene/preview/preview.ts",
    "src/words/de.ts",
)


@pytest.fixture(scope="module")
def manifest() -> dict[str, dict[str, list[str]]]:
    read: dict[str, dict[str, list[str]]] = json.loads(
        (DIST / ".vite" / "manifest.json").read_text()
    )
    return read


def loaded(manifest: dict[str, dict[str, list[str]]], entries: Iterable[str]) -> int:
    """Return how many bytes the entries and all that they import at once are, in gzip."""
    seen: set[str] = set()
    waiting = ["index.html", *entries]
    files = {"index.html"}
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        chunk = manifest[name]
        files.update([str(chunk["file"]), *chunk.get("css", [])])
        waiting += chunk.get("imports", [])
    return sum(len(gzip.compress((DIST / file).read_bytes(), 9)) for file in files)


@pytest.mark.parametrize("page", PAGES)
def test_a_page_without_3d_is_small(manifest: dict[str, dict[str, list[str]]], page: str) -> None:
    assert loaded(manifest, [page, "src/words/de.ts"]) < WITHOUT_3D


@pytest.mark.parametrize("page", PAGES[:2])
def test_a_page_with_3d_is_small_enough(
    manifest: dict[str, dict[str, list[str]]], page: str
) -> None:
    assert WITHOUT_3D < loaded(manifest, [page, *MOTION]) < WITH_3D


def test_the_pages_load_nothing_from_elsewhere() -> None:
    html = (DIST / "index.html").read_text()
    assert not any(word in html for word in ("http://", "https://", "<style"))
