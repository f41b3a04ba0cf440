"""What `mrlab convert` does: a batch of files, or a message, to results and files."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import orjson
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import export
from mrlab_ros.adapters.trajectories.coefficients import load_coefficients
from mrlab_ros.adapters.workspaces.reader import Limits, MiB, WorkspaceReader
from mrlab_ros.commands.convert import report
from mrlab_ros.core.conversion.convert import (
    ConversionResult,
    Outcome,
    convert,
    id_from,
)
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.workspace import Workspace
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.ros import share

EXIT_CODES = {Outcome.ACCEPTED: 0, Outcome.REJECTED: 1, Outcome.AMBIGUOUS: 2}
# the worst of a batch: a refusal, then a choice that is open
BADNESS = (0, 2, 1)
SUFFIXES = (".mat", ".mat.gz", ".csv", ".npz", ".mcap", ".db3")


@dataclass(frozen=True)
class Request:
    """The arguments of the command. memory: MiB; timeout, time_limit: s."""

    files: list[Path]
    topic: str
    timeout: float
    robot: str
    options: Options
    end_effector: str
    out: Path | None
    to: str
    plot: Path | None
    as_json: bool
    memory: int
    time_limit: float


@dataclass(frozen=True)
class Input:
    """Something to convert. given: what the person wrote; name: without folder."""

    given: str
    name: str
    read: Callable[[], Workspace]


def run(request: Request) -> int:
    """Convert everything and return the exit code of the worst; raise BadInput or Misuse."""
    library = RobotLibrary(share.directory() / "robots")
    model = library.model(request.robot)
    if request.end_effector:
        library.description(request.robot, request.end_effector)
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    writer = export.writer(request.to)
    results: list[ConversionResult] = []
    taken: set[str] = set()
    limits = Limits(memory=request.memory * MiB, time=request.time_limit)
    with WorkspaceReader(limits) as reader:
        for source in _with_progress(_inputs(request, reader), request):
            trajectory_id = _unused(id_from(source.name), taken)
            result = convert(
                source.name,
                source.read,
                request.options,
                model,
                coefficients,
                end_effector=request.end_effector or None,
                trajectory_id=trajectory_id,
                created_ns=time.time_ns(),
            )
            results.append(result)
            written = None
            if request.out is not None and result.trajectory is not None:
                request.out.mkdir(parents=True, exist_ok=True)
                written = writer(result.trajectory, request.out)
            if request.plot is not None:
                _plot(result, model, _plot_path(request.plot, trajectory_id))
            if request.as_json:
                line = orjson.dumps(report.record(source.given, result, written))
                print(line.decode(), flush=True)
            else:
                report.show(result, written)
    if len(results) > 1 and not request.as_json:
        report.summarise(results)
    return max((EXIT_CODES[r.outcome] for r in results), key=BADNESS.index)


def _with_progress(inputs: list[Input], request: Request) -> Iterator[Input]:
    """Yield the inputs, with a bar where there are several and a person looks on."""
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        console=Console(stderr=True),
        transient=True,
        disable=len(inputs) < 2 or request.as_json or not sys.stderr.isatty(),
    )
    with bar:
        yield from bar.track(inputs, description="Converting")


def _inputs(request: Request, reader: WorkspaceReader) -> list[Input]:
    """Return what is to be converted: the files, or the message that a topic brings."""
    if bool(request.files) is bool(request.topic):
        raise Misuse("expected files or --topic, one of them: mrlab convert run.mat --robot ur5e")
    if not request.topic:
        return [
            Input(str(path), path.name, partial(reader.read_file, path))
            for path in _expand(request.files)
        ]
    from mrlab_ros.commands.convert import topic as convert_topic  # rclpy, which files do not need

    message = convert_topic.receive(request.topic, request.timeout)
    read = partial(reader.read_bytes, message, f"{request.topic}.cdr")
    return [Input(request.topic, request.topic, read)]


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


def _plot(result: ConversionResult, robot: RobotModel, path: Path) -> None:
    """Draw what was converted, or the matrix that was refused, where one was found."""
    if result.trajectory is not None:
        export.plot(result.trajectory, robot, path)
        return
    shown = result.preview or next((c.preview for c in result.candidates), None)
    if shown is not None:
        export.plot_refused(shown, result.diagnostics, result.file, robot, path)


def _plot_path(plot: Path, trajectory_id: str) -> Path:
    return plot if plot.suffix in (".png", ".svg") else plot / f"{trajectory_id}.png"
