"""The work of `mrlab convert`: a batch of files, or a message, to results and files.

Where `mrlab convert` writes files and pictures; what cannot be written ends no batch.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import orjson

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.whole_file import named_output
from mrlab_ros.adapters.workspaces.diagnostics import MISSING
from mrlab_ros.adapters.workspaces.reader import Limits, MiB, in_memory
from mrlab_ros.adapters.workspaces.results import Task, refused, unexpected
from mrlab_ros.app.convert import SUFFIXES, Input, convert_all, input_of
from mrlab_ros.commands import output
from mrlab_ros.commands.convert import report
from mrlab_ros.commands.convert.diagnostics import (
    FILES_OR_TOPIC,
    FOLDER_NOT_WRITABLE,
    FOLDER_WITHOUT_FILES,
    LIMIT_OUT_OF_RANGE,
    NOT_WRITTEN,
    ONE_PICTURE,
    TARGET_THERE,
    WOULD_REPLACE_INPUT,
)
from mrlab_ros.commands.convert.options import convert_words
from mrlab_ros.commands.convert.outcomes import BADNESS, exit_code
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse, WrongUsage
from mrlab_ros.core.base.foreign_text import file_name
from mrlab_ros.core.base.machine import remedy
from mrlab_ros.core.conversion.convert import ConversionResult, id_from
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, Options
from mrlab_ros.core.robots.model import RobotModel

PICTURES = (".png", ".svg", ".html")


def check_free(targets: Iterable[Path], inputs: Iterable[Path], *, force: bool) -> None:
    """Raise Misuse where writing `targets` would replace an input, or any file without `force`."""
    there = [path for path in targets if path.exists()]
    # not Path.resolve, which raises for a loop of links
    read = set(map(os.path.realpath, inputs))
    for path in there:
        if os.path.realpath(path) in read:
            raise Misuse(WOULD_REPLACE_INPUT(file=str(path)))
    if there and not force:
        raise Misuse(TARGET_THERE(file=str(there[0]), more=len(there) - 1 or None))


class Targets:
    """The folders of a batch, and what could not be written into them."""

    def __init__(self, out: Path | None, plot: Path | None, count: int) -> None:
        """Make the folders for `count` inputs.

        Raises BadInput where nothing can be written there, Misuse where several inputs have one
        picture.
        """
        self._problems: list[tuple[str, str, str | None]] = []
        folders = {"out": out}
        if plot is not None:
            is_picture = plot.suffix in PICTURES
            if is_picture and count > 1:
                raise WrongUsage(ONE_PICTURE(file=str(plot), count=count))
            folders["plot"] = plot.parent if is_picture else plot
        for option, folder in folders.items():
            if folder is not None:
                _make(option, folder)

    @contextlib.contextmanager
    def writing(self) -> Iterator[None]:
        """Keep what goes wrong while something is written for `report`."""
        try:
            yield
        except OSError as error:
            why = error.strerror or str(error)
            self._problems.append((why, str(error.filename or ""), remedy(error)))

    def report(self) -> bool:
        """Say on stderr what was not written; return whether there was anything."""
        for (why, file, helps), count in Counter(self._problems).items():
            times = count if count > 1 else None
            print(NOT_WRITTEN(times=times, error=why, file=file, remedy=helps), file=sys.stderr)
        return bool(self._problems)


def _make(option: str, folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise BadInput(
            FOLDER_NOT_WRITABLE(option=option, folder=str(folder), error=error.strerror)
        ) from None


MANY_PLOTS = 8  # from so many on, processes that draw are worth their start
LEAST_MEMORY, LEAST_TIME, MOST_LIMIT = 64, 0.1, 1_000_000  # MiB, s, either


@dataclass(frozen=True)
class Request:
    """The arguments of the command.

    force: replace files that exist. memory: MiB; timeout, time_limit: s.
    """

    files: list[Path]
    topic: str
    timeout: float
    robot: str
    options: Options
    end_effector: str
    out: Path | None
    to: str
    force: bool
    plot: Path | None
    as_json: bool
    memory: int
    time_limit: float
    row_limit: int


def run(request: Request) -> int:
    """Convert everything and return the exit code of the worst; raise BadInput or Misuse.

    Raises WrongUsage where an argument cannot be one.
    """
    _check(request)
    if request.files and request.topic:  # of the bags
        request = replace(request, options=replace(request.options, variable=request.topic))
    library = RobotLibrary(share.directory() / "robots")
    with _arguments():
        model = library.model(request.robot)
        if request.end_effector:
            library.description(request.robot, request.end_effector)
        writer = formats.writer(request.to)
        request.options.checked_rate()
        request.options.factor()
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    results: list[ConversionResult] = []
    taken: set[str] = set()
    limits = Limits(memory=request.memory * MiB, time=request.time_limit, rows=request.row_limit)
    inputs = _inputs(request)
    targets = Targets(request.out, request.plot, len(inputs))
    tasks = [
        Task(
            file=source.name,
            options=request.options,
            robot=model,
            coefficients=coefficients,
            end_effector=request.end_effector or None,
            trajectory_id=_unused(id_from(source.name), taken),
            created_ns=time.time_ns(),
            default_frame_rate=DEFAULT_FRAME_RATE,
            read_as=source.read_as,
        )
        for source in inputs
    ]
    written_later = [
        path
        for task in tasks
        for path in (
            request.out and formats.path(request.to, task.trajectory_id, request.out),
            request.plot and _plot_path(request.plot, task.trajectory_id),
        )
        if path is not None
    ]
    check_free(written_later, _files(request.files), force=request.force)
    with _plotter(len(inputs) if request.plot else 0, targets) as plot:
        converted = convert_all(inputs, tasks, limits)
        for source, task, result in _with_progress(converted, len(inputs), request):
            written = None
            try:
                if request.out is not None and result.trajectory is not None:
                    with targets.writing():
                        written = writer(result.trajectory, request.out)
                if request.plot is not None:
                    plot(result, model, _plot_path(request.plot, task.trajectory_id))
                _say(source, result, written, request)
            except BrokenPipeError:
                raise
            except Exception as error:
                # one file does not end a batch
                if output.Settings.debug:
                    traceback.print_exc()
                why = error.diagnostic if isinstance(error, LabError) else None
                result = refused(task.file, why or unexpected(task.file, error))
                _say(source, result, None, request)
            results.append(result)
    if len(results) > 1 and not request.as_json:
        report.summarise(results)
    unwritten = 1 if targets.report() else 0
    return max(unwritten, *map(exit_code, results), key=BADNESS.index)


def _say(source: Input, result: ConversionResult, written: Path | None, request: Request) -> None:
    """Print what became of a file."""
    if request.as_json:
        line = orjson.dumps(report.record(file_name(source.given), result, written))
        print(line.decode(), flush=True)
    if result.said.code == MISSING.code:
        output.say_problem(result.said)
        return
    if request.as_json:
        return
    words = convert_words(source.given, request.robot, request.end_effector)
    report.show(result, written, words, request.options)


@contextlib.contextmanager
def _arguments() -> Iterator[None]:
    """Raise an argument that is refused as wrong usage."""
    try:
        yield
    except (BadInput, Misuse) as error:
        raise WrongUsage(error.diagnostic) from None


def _check(request: Request) -> None:
    """Raise WrongUsage where a limit cannot be one."""
    for option, value, least, unit in (
        ("memory", request.memory, LEAST_MEMORY, "MiB"),
        ("time-limit", request.time_limit, LEAST_TIME, "s"),
        ("timeout", request.timeout, 0, "s"),
    ):
        if not least <= value <= MOST_LIMIT:
            raise WrongUsage(
                LIMIT_OUT_OF_RANGE(
                    option=option, value=float(value), least=least, most=MOST_LIMIT, unit=unit
                )
            )


Plotter = Callable[[ConversionResult, RobotModel, Path], None]


@contextlib.contextmanager
def _plotter(count: int, targets: Targets) -> Iterator[Plotter]:
    """Yield what draws a result: at once where there are few, else in processes beside this."""

    def plot_now(result: ConversionResult, robot: RobotModel, path: Path) -> None:
        with targets.writing():
            _plot(result, robot, path)

    if count < MANY_PLOTS:
        yield plot_now
        return
    workers = max(2, os.cpu_count() or 1)
    with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
        drawn: list[Future[None]] = []

        def plot(result: ConversionResult, robot: RobotModel, path: Path) -> None:
            drawn.append(pool.submit(_plot, result, robot, path))

        yield plot
        for future in drawn:
            with targets.writing():
                future.result()


def _with_progress(
    converted: Iterator[tuple[Input, Task, ConversionResult]], count: int, request: Request
) -> Iterator[tuple[Input, Task, ConversionResult]]:
    """Yield the results, with a bar where there are several and stdout is a terminal."""
    if count < 2 or request.as_json or not sys.stderr.isatty():
        yield from converted
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        console=output.console(stderr=True),
        transient=True,
    )
    with bar:
        yield from bar.track(converted, total=count, description="Converting")


def _inputs(request: Request) -> list[Input]:
    """Return what is to be converted: the files, or the message that a topic brings."""
    if not request.files and not request.topic:
        raise WrongUsage(FILES_OR_TOPIC())
    if request.files:
        return [_input(path) for path in _files(request.files)]
    from mrlab_ros.commands.convert.topic import receive  # rclpy, which files do not need

    message = receive(request.topic, request.timeout)
    read_as = f"{request.topic}.cdr"
    return [Input(request.topic, request.topic, read_as, partial(in_memory, message))]


def _input(path: Path) -> Input:
    if os.path.isdir(path):
        return replace(input_of(path), open=partial(_without_files, path))
    return input_of(path)


@contextlib.contextmanager
def _without_files(folder: Path) -> Iterator[int]:
    """Refuse a folder, as an input that cannot be opened."""
    raise BadInput(FOLDER_WITHOUT_FILES(folder=str(folder), suffixes=list(SUFFIXES)))
    yield


def _files(given: Iterable[Path]) -> list[Path]:
    """Return the files that are given, and those in the folders; a folder without any as it is."""
    return [file for path in given for file in list(expanded([path])) or [path]]


def expanded(files: Iterable[Path]) -> Iterable[Path]:
    """Yield the files; of a folder, the workspaces in it, in order."""
    for path in files:
        if os.path.isdir(path):  # not Path.is_dir, which raises for a name that is too long
            inside = [p for p in sorted(path.rglob("*")) if p.name.lower().endswith(SUFFIXES)]
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
    """Draw what was converted, or the matrix that was refused, where one was found.

    A path that ends in .html becomes a page that shows the motion in 3D.
    """
    if path.suffix == ".html":
        _write_page(result, robot.id, path)
        return
    if result.trajectory is not None:
        formats.plot(result.trajectory, robot, path)
        return
    shown = result.preview or next((c.preview for c in result.candidates), None)
    if shown is not None:
        formats.plot_refused(shown, result.diagnostics, result.file, robot, path)


def _write_page(result: ConversionResult, robot: str, path: Path) -> None:
    from mrlab_ros.app.show.motion import motion_page

    tool = result.trajectory.end_effector if result.trajectory is not None else None
    folder = share.directory()
    text = motion_page(result, robot, tool, RobotLibrary(folder / "robots"), folder)
    path.parent.mkdir(parents=True, exist_ok=True)
    with named_output(path) as file:
        file.write(text.encode())


def _plot_path(plot: Path, trajectory_id: str) -> Path:
    return plot if plot.suffix in PICTURES else plot / f"{trajectory_id}.png"
