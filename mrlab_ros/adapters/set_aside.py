"""Keeps what cannot be used under another name, so that nothing is lost."""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path


def set_aside(path: Path, *, copy: bool = False) -> str:
    """Rename or copy what is damaged to NAME.damaged-TIME; return a sentence that says so."""
    stamp = time.strftime("%Y-%m-%dT%H-%M-%S")
    number = 1
    aside = path.with_name(f"{path.name}.damaged-{stamp}")
    while os.path.lexists(aside):
        number += 1
        aside = path.with_name(f"{path.name}.damaged-{stamp}-{number}")
    try:
        if copy:
            shutil.copy2(path, aside)
        else:
            path.rename(aside)
    except OSError as error:
        return f"It cannot be set aside: {error.strerror}"
    return f"{'A copy is kept as' if copy else 'It is now called'} {aside.name}"
