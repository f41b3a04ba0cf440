"""Keeps what cannot be used under another name, so that nothing is lost."""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path

from mrlab_ros.adapters.diagnostics import COPY_KEPT, NOT_SET_ASIDE, SET_ASIDE
from mrlab_ros.core.base.diagnostic import Diagnostic


def set_aside(path: Path, *, copy: bool = False) -> Diagnostic:
    """Rename or copy what is damaged to NAME.damaged-TIME; return what is said of that."""
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
        return NOT_SET_ASIDE(problem=error.strerror)
    return (COPY_KEPT if copy else SET_ASIDE)(file=aside.name)
