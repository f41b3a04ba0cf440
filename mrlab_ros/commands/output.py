"""How a command prints what the lab answered."""

from __future__ import annotations

import json
from typing import Annotated

import typer

AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def say(message: str, *, as_json: bool, **facts: object) -> None:
    """Print the lab's sentence, or a JSON object with it and `facts`."""
    print(json.dumps({**facts, "message": message}) if as_json else message, flush=True)
