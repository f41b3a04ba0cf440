"""The site of docs/: each page has one place, links lead somewhere, nothing is fetched."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).parents[2]
SITE = ROOT / "scripts" / "site"
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCE = re.compile(r"^```.*?^```$|`[^`\n]+`", re.M | re.S)
LINK = re.compile(r"\]\((?!https?:|mailto:)([^)#\s]*)(?:#([^)\s]+))?\)")


def places(entry: Any) -> Iterator[str]:
    """Yield the pages of an entry of the navigation, in reading order."""
    if isinstance(entry, str):
        yield entry
    else:
        for each in entry.values() if isinstance(entry, dict) else entry:
            yield from places(each)


def anchors(page: Path) -> set[str]:
    """Return the anchors of a page's headings, as GitHub and the site make them."""
    headings = re.findall(
        r"^#+ (.+)$", FENCE.sub(lambda m: m[0].strip("`"), page.read_text()), re.M
    )
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)|[*`]", r"\1", heading) for heading in headings)
    return {re.sub(r"[^\w\- ]", "", each.lower()).replace(" ", "-") for each in plain}


def test_every_page_has_one_place_on_the_site() -> None:
    navigation = (SITE / "mkdocs.yml").read_text().partition("\nnav:\n")[2]
    listed = list(places(yaml.safe_load(navigation)))
    assert sorted(listed) == sorted(set(listed))
    inside = {page.relative_to(ROOT / "docs").as_posix() for page in (ROOT / "docs").rglob("*.md")}
    assert inside <= set(listed), f"add to scripts/site/mkdocs.yml: {inside - set(listed)}"


def test_no_guide_is_long() -> None:
    """Long pages explain, or list: the navigation has them elsewhere."""
    navigation = yaml.safe_load((SITE / "mkdocs.yml").read_text().partition("\nnav:\n")[2])
    readers = [entry for reader in navigation for entry in next(iter(reader.values()))]
    guides = [
        page
        for entry in readers
        if isinstance(entry, dict) and {"Guides", "Tutorials"} & set(entry)
        for page in places(entry)
    ]
    assert len(guides) > 20
    long = {
        page: len(re.sub(r"<!--.*?-->", "", (ROOT / "docs" / page).read_text()).split())
        for page in guides
        if (ROOT / "docs" / page).exists()
    }
    assert {page: count for page, count in long.items() if count > 1200} == {}


def test_links_of_pages_lead_somewhere() -> None:
    wrong = []
    for page in PAGES:
        for target, anchor in LINK.findall(FENCE.sub("", page.read_text())):
            file = page.parent / target if target else page
            if not file.exists():
                wrong.append((page.name, target))
            elif anchor and file.suffix == ".md" and anchor not in anchors(file):
                wrong.append((page.name, f"{target}#{anchor}"))
    assert wrong == []


@pytest.mark.slow
def test_the_site_is_built_strictly_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    pytest.importorskip("mkdocs", reason="not set up: python3 scripts/bootstrap.py --dev")
    command = [sys.executable, "-m", "mkdocs", "build", "-q", "-f", str(SITE / "mkdocs.yml")]
    done = subprocess.run(
        [*command, "-d", str(tmp_path)],
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    pages = sorted(tmp_path.glob("*.html"))
    assert len(pages) > 30
    loads = r"<(?:script|img|link rel=\"(?:stylesheet|preconnect)\")[^>]+\"(https?://[^\"]+)"
    assert [url for page in pages for url in re.findall(loads, page.read_text())] == []
    shown = (tmp_path / "playback.html").read_text()
    assert "&lt;!--" not in shown
    assert '<pre class="mermaid">' in shown
