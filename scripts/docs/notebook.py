#!/usr/bin/env python3
"""Runs a notebook of docs/ beside a lab with one UR5e, and writes its outputs into it.

python scripts/docs/notebook.py docs/notebook.ipynb; the site makes a page of it by `page`. A cell
is run as Jupyter runs it, `await` included; its last expression and its figures are shown.
"""

from __future__ import annotations

import ast
import asyncio
import base64
import contextlib
import inspect
import io
import json
import sys
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib import pyplot
from PIL import Image

Document = dict[str, Any]
PNG, HTML, TEXT = "image/png", "text/html", "text/plain"
matplotlib.use("agg")
matplotlib.rcParams["savefig.dpi"] = 80


def executed(document: Document) -> Document:
    """Return a notebook with the outputs of its cells; raise what a cell raises."""
    names: dict[str, Any] = {"__name__": "__main__"}
    cells = [dict(cell) for cell in document["cells"]]
    with contextlib.closing(asyncio.new_event_loop()) as loop:
        code = (cell for cell in cells if cell["cell_type"] == "code")
        for number, cell in enumerate(code, start=1):
            source = "".join(cell["source"])
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                value = loop.run_until_complete(_run(source, names))
            outputs: list[Document] = []
            if printed.getvalue():
                lines = printed.getvalue().splitlines(keepends=True)
                outputs.append({"output_type": "stream", "name": "stdout", "text": lines})
            if value is not None and not source.endswith(";"):
                result = {"output_type": "execute_result", "execution_count": number}
                outputs.append({**result, "metadata": {}, "data": shown(value)})
            for figure in map(pyplot.figure, pyplot.get_fignums()):
                shape = {"output_type": "display_data", "metadata": {}}
                outputs.append({**shape, "data": {PNG: _png(figure.savefig)}})
            pyplot.close("all")
            cell |= {"execution_count": number, "outputs": outputs}
    return document | {"cells": cells}


async def _run(source: str, names: dict[str, Any]) -> Any:
    """Run a cell; return the value of its last expression, or None."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    await _evaluated(tree, "exec", names)
    return None if last is None else await _evaluated(ast.Expression(last.value), "eval", names)


async def _evaluated(tree: Any, mode: str, names: dict[str, Any]) -> Any:
    code = compile(tree, "<cell>", mode, flags=ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
    found: Any = eval(code, names)
    if code.co_flags & inspect.CO_COROUTINE:
        waiting: Coroutine[Any, Any, Any] = found
        return await waiting
    return found


def shown(value: Any) -> dict[str, Any]:
    """Return what a notebook keeps of a value, by its kind."""
    if isinstance(value, Image.Image):
        return {PNG: _png(value.save)}
    if hasattr(value, "_repr_html_"):
        return {HTML: value._repr_html_().splitlines(keepends=True)}
    return {TEXT: repr(value).splitlines(keepends=True)}


def _png(write: Callable[..., Any]) -> str:
    content = io.BytesIO()
    write(content, format="png")
    return base64.b64encode(content.getvalue()).decode()


def page(document: Document, folder: str) -> tuple[str, dict[str, bytes]]:
    """Return a notebook as Markdown, and its pictures by their path below `folder`."""
    parts, pictures = [], dict[str, bytes]()
    for cell in document["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"```python\n{source}\n```")
        for output in cell["outputs"]:
            data = output.get("data", {TEXT: output.get("text")})
            if PNG in data:
                name = f"{folder}/{len(pictures) + 1}.png"
                pictures[name] = base64.b64decode(data[PNG])
                parts.append(f"![What the cell above draws]({name})")
            elif HTML in data:
                text = "".join(data[HTML]).replace(' border="1" class="dataframe"', "")
                parts.append("\n".join(line for line in text.splitlines() if line.strip()))
            else:
                parts.append("```text\n" + "".join(data[TEXT]).rstrip() + "\n```")
    return "\n\n".join(parts) + "\n", pictures


def written(document: Document) -> str:
    """Return the text of a notebook's file."""
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for file in map(Path, sys.argv[1:]):
        file.write_text(written(executed(json.loads(file.read_text()))))
