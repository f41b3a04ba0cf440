"""What mkdocs calls while it builds the site: pages from outside docs/, notebooks, links, colours,
diagrams.

The pages are written for the repository, where a link may lead to any file and a comment above a
block says how it is tested. On the site such a file is copied below files/, and the comments go.
"""

from __future__ import annotations

import json
import os
import re
import runpy
from pathlib import Path, PurePosixPath
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]
# Pages of the site that lie outside docs/.
OUTSIDE = {
    "start.md": "README.md",
    "changelog.md": "CHANGELOG.md",
    "client-python.md": "examples/clients/python/README.md",
    "client-c.md": "examples/clients/c/README.md",
}
# Written by build.py; without it, as in the tests, diagrams stay text.
MERMAID = ROOT / "build" / "mermaid" / "mermaid.min.js"
LINK = re.compile(r"(\]\()(?!https?:|mailto:|#)([^)#\s]+)")
MARK = re.compile(r"^(?:<!-- prints -->\n```\w*|<!--.*?-->\n?|```\n)", re.M)
FENCE = re.compile(r"^```.*?^```$", re.M | re.S)


def place(path: str) -> str:
    """Return where a file of the repository stands on the site; path: relative to its root."""
    for page, source in OUTSIDE.items():
        if path == source:
            return page
    inside = PurePosixPath(path)
    if inside.match("docs/*.ipynb"):
        inside = inside.with_suffix(".md")  # made below
    return str(inside.relative_to("docs")) if inside.is_relative_to("docs") else f"files/{path}"


def linked(text: str, source: str) -> dict[str, str]:
    """Return the relative links of a page's prose, each with the path in the repository it names.

    source: the page's own path in the repository. Links without a file are left to mkdocs.
    """
    found = {}
    for _, target in LINK.findall(FENCE.sub("", text)):
        path = os.path.normpath(PurePosixPath(source).parent / target)
        if (ROOT / path).is_file():
            found[target] = path
    return found


def rewritten(text: str, source: str) -> str:
    """Return a page's text with its links as the site has them, and without marks of blocks."""
    links = {target: place(path) for target, path in linked(text, source).items()}
    here = str(PurePosixPath(place(source)).parent)

    def link(match: re.Match[str]) -> str:
        target = links.get(match[2])
        return match[1] + (os.path.relpath(target, here) if target else match[2])

    text = LINK.sub(link, text)
    fences, inside = [], False
    for line in text.splitlines(keepends=True):
        if line.startswith("```"):
            inside = not inside
            if inside and fences and fences[-1] == "<!-- prints -->\n":
                fences[-1] = ""
                line = '``` { .text title="prints" }\n'
            elif inside and line == "```\n":
                line = "```sh\n"
        elif not inside and line.startswith("<!--") and "prints" not in line:
            continue
        fences.append(line)
    return "".join(fences)


def colours() -> str:
    """Return the stylesheet with the colours of the lab's own pages, from config/design.json."""
    design = json.loads((ROOT / "config" / "design.json").read_text())
    lines = [f":root {{ --mrlab-family: {design['type']['family']};"]
    lines += [f"--mrlab-mono: {design['type']['mono']}; }}"]
    for scheme, theme in (("default", "light"), ("slate", "dark")):
        pairs = (f"--mrlab-{name}: {value[theme]};" for name, value in design["colours"].items())
        lines.append(f"[data-md-color-scheme={scheme}] {{ {' '.join(pairs)} }}")
    return "\n".join(lines).replace("_", "-") + "\n"


def on_config(config: MkDocsConfig) -> None:
    if MERMAID.is_file():
        config.extra_javascript.append("javascripts/mermaid.min.js")


def on_files(files: Files, config: MkDocsConfig) -> None:
    """Add the pages and files that lie outside docs/, and what is generated."""

    def add(uri: str, **content: Any) -> None:
        files.append(File.generated(config, uri, **content))

    for page, source in OUTSIDE.items():
        add(page, content=(ROOT / source).read_text())
    page_of = runpy.run_path(str(ROOT / "scripts" / "docs" / "notebook.py"))["page"]
    for notebook in sorted((ROOT / "docs").glob("*.ipynb")):
        text, pictures = page_of(json.loads(notebook.read_text()), f"images/{notebook.stem}")
        add(f"{notebook.stem}.md", content=text)
        for uri, content in pictures.items():
            add(uri, content=content)
    texts = {f"docs/{f.src_uri}": f.content_string for f in files.documentation_pages()}
    texts |= {source: (ROOT / source).read_text() for source in OUTSIDE.values()}
    for source, text in texts.items():
        for path in linked(text, source).values():
            if place(path).startswith("files/") and files.get_file_from_path(place(path)) is None:
                add(place(path), abs_src_path=str(ROOT / path))
    add("stylesheets/colours.css", content=colours())
    if MERMAID.is_file():
        add("javascripts/mermaid.min.js", abs_src_path=str(MERMAID))


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    uri = page.file.src_uri
    return rewritten(markdown, OUTSIDE.get(uri, f"docs/{uri}"))
