"""The work of `mrlab rubric`: lint, mark, print."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.classroom import trials, words
from mrlab_ros.classroom.mark import (
    compared,
    ground_of,
    mark_file,
    read_rubric,
    reference_of,
    setting_of,
)
from mrlab_ros.classroom.rubrics import document
from mrlab_ros.classroom.rubrics.marking import Flaw, flaws_of, flaws_of_reference, flaws_of_trials
from mrlab_ros.classroom.rubrics.marking import mark as marks_of
from mrlab_ros.classroom.rubrics.measures import FAMILIES
from mrlab_ros.commands.check import run as check
from mrlab_ros.commands.check.diagnostics import NO_PAGE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.options import Options

SCHEMA = "mrlab.marks.1"
FULL, LOST = 0, 1


def lint(path: Path, options: Options, *, as_json: bool) -> int:
    """Print the flaws of a rubric and return the exit code; raise LabError."""
    rubric = read_rubric(path)
    folder = share.directory()
    setting = setting_of(rubric, Stage(folder, RobotLibrary(folder / "robots")), folder, options)
    flaws = flaws_of(rubric, ground_of(rubric, setting))
    marks = None
    made: Sequence[trials.Trial] = ()
    try:
        reference = reference_of(rubric, setting)
    except BadInput as error:
        flaws.append(Flaw(error.diagnostic))
    else:
        if reference is not None:
            marks = marks_of(rubric, reference.checked, reference.checked)
            flaws += flaws_of_reference(rubric, marks)
            made = trials.trials(rubric, setting, reference, marks)
            if made:
                wrong = (t for t in made if t.name not in (trials.REFERENCE, trials.A_DAY_LATE))
                standing, *others = (trial.marks for trial in wrong)
                flaws += flaws_of_trials(rubric, standing, others)
    if as_json:
        said = {
            "rubric": rubric.name,
            "points": rubric.points,
            "flaws": [flaw.plain() for flaw in flaws],
            "reference": marks.plain() if marks else None,
            "trials": [{"name": t.name, "points": t.marks.points} for t in made],
        }
        print(json.dumps(said))
    else:
        words.flaws(rubric, flaws, marks)
        words.trials(rubric, made)
    return LOST if any(flaw.found.refuses for flaw in flaws) else FULL


def mark(
    file: Path,
    path: Path,
    options: Options,
    out: Path | None,
    *,
    report: bool,
    public: bool,
    as_json: bool,
) -> int:
    """Print what a file gets, write its page, and return the exit code; raise LabError."""
    rubric = read_rubric(path)
    folder = share.directory()
    setting = setting_of(rubric, Stage(folder, RobotLibrary(folder / "robots")), folder, options)
    reference = reference_of(rubric, setting) if compared(rubric) else None
    found, marks = mark_file(file, rubric, setting, reference)
    shown = marks.public() if public else marks
    if as_json:
        said = {
            "schema": SCHEMA,
            "file": file.name,
            "rubric": rubric.name,
            **shown.plain(),
            "check": found.checked.document["hash"],
        }
        if report:
            said["report"] = found.checked.document
        print(json.dumps(said))
    else:
        if report and found.holds_motion:
            given = ["mrlab", "rubric", "mark", str(file), "--rubric", str(path)]
            check.show(found.checked.report, found.checked.document, given, options)
            print()
        words.marks(file, rubric, shown, found.checked)
    if out is not None and found.played is not None:
        from mrlab_ros.app.show.check import write_page

        size = write_page(out, found, setting.stage, folder, shown.plain())
        if not as_json:
            print(f"{out} ({size / 1e6:.2f} MB)")
    elif out is not None and not as_json:
        print(NO_PAGE())
    return LOST if marks.lost else FULL


def measures() -> str:
    """Return all forms of `expect` as JSON."""
    return json.dumps(
        [
            {
                "family": family,
                "expect": form.text,
                "about": form.about,
                "partial": form.rules,
                "poses": form.poses,
            }
            for family, forms in FAMILIES.items()
            for form in forms
        ]
    )


def example(*, as_json: bool = False) -> str:
    """Return the text of the example, or what it holds as JSON, with its reference as a path that
    holds from every folder; raise BadInput where it is not installed."""
    path = share.directory() / "examples" / "rubrics" / "pick_and_place.yaml"
    rubric = read_rubric(path)
    reference = str(Path(rubric.reference).resolve())
    if as_json:
        return json.dumps({**document.plain(rubric), "reference": reference})
    named = str(Path(rubric.reference).relative_to(path.parent))
    written = json.dumps(reference, ensure_ascii=False)
    return path.read_text(encoding="utf-8").replace(named, written)
