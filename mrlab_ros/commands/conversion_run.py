"""What `mrlab convert` does: a batch of files to results, tables, JSON lines and files."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import orjson
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
from rich.table import Table

from mrlab_ros import share
from mrlab_ros.adapters import trajectory_formats
from mrlab_ros.adapters.matfile_reader import Limits, MiB, WorkspaceReader
from mrlab_ros.adapters.robot_library import RobotLibrary
from mrlab_ros.conversion import (
    ConversionResult,
    Outcome,
    convert_file,
    id_from,
    load_coefficients,
)
from mrlab_ros.core.diagnostics import Severity
from mrlab_ros.core.discovery import SPARK_WIDTH
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.selection import Options

EXIT_CODES = {Outcome.ACCEPTED: 0, Outcome.REJECTED: 1, Outcome.AMBIGUOUS: 2}
# the worst of a batch: a refusal, then a choice that is open
BADNESS = (0, 2, 1)
COLOURS = {Severity.INFO: "dim", Severity.WARNING: "yellow", Severity.ERROR: "bold red"}
SUFFIXES = (".mat", ".mat.gz", ".csv", ".npz")


@dataclass(frozen=True)
class Request:
    """The arguments of the command. memory: MiB; time_limit: s."""

    files: list[Path]
    robot: str
    options: Options
    end_effector: str
    out: Path | None
    to: str
    plot: Path | None
    as_json: bool
    memory: int
    time_limit: float


def run(request: Request) -> int:
    """Convert all files and return the exit code of the worst; raise BadInput."""
    library = RobotLibrary(share.directory() / "robots")
    model = library.model(request.robot)
    if request.end_effector:
        library.description(request.robot, request.end_effector)
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    writer = trajectory_formats.writer(request.to)
    paths = list(_expand(request.files))
    console = Console()
    results: list[ConversionResult] = []
    taken: set[str] = set()
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        console=Console(stderr=True),
        transient=True,
        disable=len(paths) < 2 or request.as_json or not sys.stderr.isatty(),
    )
    limits = Limits(memory=request.memory * MiB, time=request.time_limit)
    with WorkspaceReader(limits) as reader, bar:
        for path in bar.track(paths, description="Converting"):
            trajectory_id = _unused(id_from(path.name), taken)
            result = convert_file(
                path,
                request.options,
                model,
                reader=reader,
                coefficients=coefficients,
                end_effector=request.end_effector or None,
                trajectory_id=trajectory_id,
                created_ns=time.time_ns(),
            )
            results.append(result)
            written = None
            if request.out is not None and result.trajectory is not None:
                request.out.mkdir(parents=True, exist_ok=True)
                written = writer(result.trajectory, request.out, coefficients)
            if request.plot is not None and result.trajectory is not None:
                picture = _plot_path(request.plot, trajectory_id)
                trajectory_formats.plot(result.trajectory, model, picture)
            if request.as_json:
                sys.stdout.write(orjson.dumps(record(path, result, written)).decode() + "\n")
                sys.stdout.flush()
            else:
                _show(console, result, written)
    if len(results) > 1 and not request.as_json:
        _summarise(console, results)
    return max((EXIT_CODES[r.outcome] for r in results), key=BADNESS.index)


def _expand(files: Iterable[Path]) -> Iterable[Path]:
    """Yield the files; of a folder, the workspaces in it, in order."""
    for path in files:
        if path.is_dir():
            inside = [p for p in sorted(path.rglob("*")) if p.name.lower().endswith(SUFFIXES)]
            if not inside:
                raise BadInput(
                    f"the folder '{path}' holds no {', '.join(SUFFIXES)} file; give the folder "
                    "with the workspaces"
                )
            yield from inside
        else:
            yield path


def _unused(name: str, taken: set[str]) -> str:
    """Return `name`, numbered where a file of this batch has it already."""
    unused, number = name, 1
    while unused in taken:
        number += 1
        unused = f"{name[:120]}-{number}"
    taken.add(unused)
    return unused


def _plot_path(plot: Path, trajectory_id: str) -> Path:
    return plot if plot.suffix in (".png", ".svg") else plot / f"{trajectory_id}.png"


def record(path: Path, result: ConversionResult, written: Path | None) -> dict[str, Any]:
    """Return what --json prints for a file."""
    t = result.trajectory
    gripper = t is not None and t.gripper is not None
    return {
        "file": str(path),
        "outcome": result.outcome.name.lower(),
        "variable": t.source.variable if t else None,
        "shape": [t.frame_count, len(t.joint_names) + gripper] if t else None,
        "has_gripper": gripper if t else None,
        "frame_rate": t.frame_rate if t else None,
        "candidates": [
            {
                "variable": c.path,
                "shape": list(c.variable.shape),
                "score": c.score,
                "why": c.why,
                "minimum": c.minimum,
                "maximum": c.maximum,
                "sparkline": c.sparkline(),
            }
            for c in result.candidates
        ],
        "diagnostics": [
            {
                "code": d.code,
                "severity": d.severity.name.lower(),
                "message": d.message,
                "remedy": d.remedy,
                "variable": d.variable,
                "where": d.where,
            }
            for d in result.diagnostics
        ],
        "message": result.message,
        "trajectory": str(written) if written else None,
    }


def _show(console: Console, result: ConversionResult, written: Path | None) -> None:
    colour = {0: "green", 1: "red", 2: "yellow"}[EXIT_CODES[result.outcome]]
    name = result.outcome.name.lower()
    console.print(f"[{colour}]{name}[/]", end="  ")
    console.print(
        result.message if result.trajectory else result.file, markup=False, highlight=False
    )
    for d in result.diagnostics:
        label = f"  {d.severity.name.lower()} {d.code}: "
        console.print(label + d.message, style=COLOURS[d.severity], markup=False, highlight=False)
        if d.remedy:
            console.print(f"      {d.remedy}", markup=False, highlight=False)
    if result.candidates:
        console.print(_choices(result))
    if written:
        console.print(f"  written to {written}", markup=False, highlight=False)


def _choices(result: ConversionResult) -> Table:
    table = Table("--variable", "size", "from", "to", box=None)
    table.add_column("course", no_wrap=True, min_width=SPARK_WIDTH)
    table.add_column("score")
    table.add_column("why")
    for c in result.candidates:
        table.add_row(
            c.path,
            c.variable.size,
            f"{c.minimum:.3g}",
            f"{c.maximum:.3g}",
            c.sparkline(),
            f"{c.score:.2f}",
            c.why,
        )
    return table


def _summarise(console: Console, results: list[ConversionResult]) -> None:
    table = Table("file", "outcome", "variable", "frames", "Hz", "finding", box=None)
    for r in results:
        t = r.trajectory
        codes = ", ".join(dict.fromkeys(d.code for d in r.diagnostics if d.severity > 0))
        table.add_row(
            r.file,
            r.outcome.name.lower(),
            t.source.variable if t else "",
            str(t.frame_count) if t else "",
            f"{t.frame_rate:g}" if t else "",
            codes,
        )
    console.print()
    console.print(table)
