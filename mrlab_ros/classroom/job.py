"""A run of a class for the desk of the gateway, in a process of its own.

It takes the folder of the class and one of PROPOSE, HOLD, FINAL and BACK, and prints JSON lines:
how many submissions are done of how many, and at the end that it is done, or the problem. What
only a run needs is imported by it: the desk imports this module for its names.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
from pathlib import Path
from typing import Any

from mrlab_ros.adapters import share
from mrlab_ros.app.check.file import scene_of
from mrlab_ros.classroom.folder import BEFORE, HELD, PROPOSED, SOURCES, WORKSHEET
from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.setup import Bounds, Setup
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, plain
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.conversion.options import Options

PROPOSE, HOLD, FINAL, BACK = "propose", "hold", "final", "back"
EXPORT, RUBRIC, SHEET = "export.zip", "rubric.yaml", "worksheet.csv"


def work(folder: Path, how: str, form: str) -> list[Diagnostic]:
    """Mark the class from its sources; return what its teacher has to know. Raises LabError.

    PROPOSE writes no page and changes no mark that holds; HOLD and FINAL let the marks hold, BACK
    those of the run before.
    """
    from mrlab_ros.classroom.run import Request, form_of, marked

    sources = folder / {FINAL: HELD, BACK: BEFORE}.get(how, SOURCES)
    proposes = how == PROPOSE
    setup = setup_of(sources, pages=not proposes)
    sheet = folder / SOURCES / SHEET
    *_, problems = marked(
        Request(
            sources / EXPORT,
            setup,
            folder / PROPOSED if proposes else folder,
            template=sheet if sheet.exists() else None,
            fills=how == FINAL,
            form=form_of(form),
            base=folder if proposes else None,
            final=how == FINAL,
            worksheet=folder / WORKSHEET,
            progress=lambda done, count: said(done=done, all=count),
        )
    )
    if how == HOLD:
        if (folder / HELD).exists():
            hold(folder / HELD, folder / BEFORE)
        hold(folder / SOURCES, folder / HELD)
    if how == BACK:
        for place in (SOURCES, HELD):
            hold(folder / BEFORE, folder / place)
        shutil.rmtree(folder / BEFORE)
    if how in (HOLD, BACK):
        shutil.rmtree(folder / PROPOSED, ignore_errors=True)
    return [each for each in problems if each.severity is not Severity.INFO]


def setup_of(sources: Path, *, pages: bool) -> Setup:
    """Return how a class is checked by the rubric among its sources. Raises LabError."""
    from mrlab_ros.classroom.run import of_rubric

    rubric = read_rubric(sources / RUBRIC, beside=True)
    scene = scene_of(rubric.scene, share.directory())
    return of_rubric(rubric, scene, Options(), Bounds(), pages=pages)


def hold(source: Path, target: Path) -> None:
    """Let the files of a folder be those of another one; no byte is copied."""
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for file in source.iterdir():
        os.link(file, target / file.name)


def said(**values: Any) -> None:
    """Print a line for the desk."""
    print(json.dumps(values), flush=True)


def main() -> None:
    """Run as the arguments say: the folder, how, and the form of the export."""
    try:
        notes = work(Path(sys.argv[1]), sys.argv[2], sys.argv[3])
    except LabError as error:
        said(problem=plain(error.diagnostic))
    else:
        said(ended=True, notes=plain(notes))


if __name__ == "__main__":
    main()
