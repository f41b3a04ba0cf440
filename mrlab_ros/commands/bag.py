"""`mrlab bag`: what is in a bag, what happened in it, and mending one. Needs no running lab."""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import asdict
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import EXTRACTED
from mrlab_ros.commands.output import AsJson, say
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.foreign_text import visible

if TYPE_CHECKING:
    from mrlab_ros.adapters.bags.courses import Reference
    from mrlab_ros.adapters.bags.reader import Bag

app = typer.Typer(help="Inspect, report and repair bags.", no_args_is_help=True)
BagArgument = Annotated[
    str,
    typer.Argument(
        help="Folder of a bag, an MCAP or .db3 file, or its name among the recorder's."
    ),
]


def path_of(bag: str) -> Path:
    """Return where a bag lies that is named by its path, or by its name in the usual folder."""
    from mrlab_ros.adapters.bags.reader import default_folder

    path = Path(bag).expanduser()
    usual = default_folder() / bag
    return usual if not path.exists() and usual.exists() else path


def opened(bag: str) -> Bag:
    """Return a bag of any kind that is named as path_of() has it."""
    from mrlab_ros.adapters.bags.other import open_bag
    from mrlab_ros.messages.definitions import definition

    return open_bag(path_of(bag), definition)


@app.command()
def info(bag: BagArgument, as_json: AsJson = False) -> None:
    """Show topics, counts, length and attachments of a bag."""
    path = path_of(bag)
    _walled(info_of, path, as_json, write=[path] if path.is_dir() else ())


def info_of(bag: str, as_json: bool) -> None:
    """Print what is in a bag."""
    from mrlab_ros.adapters.bags.repair import refresh_metadata

    found = opened(bag)
    anew = refresh_metadata(found.path)
    if as_json:
        print(json.dumps(_facts(found), indent=2))
        return
    _print(found)
    if anew:
        print("metadata.yaml was behind the files, and is written anew")


def _walled(
    function: Callable[..., Any], path: Path, *arguments: Any, write: Iterable[Path] = ()
) -> Any:
    """Do something with a bag in the sandbox; it prints here."""
    from mrlab_ros.commands import sandboxed

    return sandboxed.run(function, str(path), *arguments, name=path.name, read=[path], write=write)


@app.command()
def repair(bag: BagArgument, as_json: AsJson = False) -> None:
    """Rewrite damaged files and metadata.yaml; the originals are kept beside them.

    Of an MCAP file alone only that file is rewritten.
    """
    path = path_of(bag)
    _walled(repaired, path, as_json, write=[path if path.is_dir() else path.parent])


def repaired(path: str, as_json: bool) -> None:
    """Mend a bag, and print what was done."""
    from mrlab_ros.adapters.bags.repair import KEPT
    from mrlab_ros.adapters.bags.repair import repair as mend

    done = mend(Path(path))
    if as_json:
        print(json.dumps(plain(asdict(done))))
        return
    for trouble in done.troubles:
        print(trouble)
    if not done.files:
        print(f"the bag is whole, with {done.messages} messages; there is nothing to mend")
        return
    print(
        f"wrote {', '.join(done.files)} anew: {done.messages} messages; the originals are kept "
        f"as *{KEPT}"
    )


@app.command("import")
def import_(
    source: Annotated[
        Path, typer.Argument(help="Any ROS 2 bag: a folder, an MCAP file, or a .db3 file.")
    ],
    bag: Annotated[Path, typer.Argument(help="Folder of the new bag.")],
    robots: Annotated[
        list[str] | None,
        typer.Option(
            "--robot", help="Model whose joints the bag holds, such as ur5e; repeatable."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Make a bag of this lab of any ROS 2 bag; its joint states move a robot of the lab."""
    from mrlab_ros.commands.foreign import imported

    done = imported(source.expanduser(), bag.expanduser(), robots or [])
    say(
        done.said(str(done.folder)),
        as_json=as_json,
        bag=str(done.folder),
        messages=done.messages,
        robots=done.robots,
        skipped=done.skipped,
    )


@app.command()
def extract(
    bag: BagArgument,
    out: Annotated[
        Path | None,
        typer.Option(help="New or empty folder; none: BAG-attachments, here.", show_default=False),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Write a bag's attachments to files: URDFs, meshes, trajectories, scene, parameters."""
    from mrlab_ros.adapters.bags.extract import free

    path = path_of(bag)
    root = free(out or Path(f"{path.stem}-attachments"))
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        names = _walled(extracted, path, folder, write=[Path(folder)])
        try:
            _bring(Path(folder), root)
        except OSError:
            # half of the attachments are no use, and the next try needs an empty folder
            shutil.rmtree(root, ignore_errors=True)
            raise
    said = EXTRACTED(files=len(names), folder=str(root), names=names)
    say(said, as_json=as_json, files=names)
    if not as_json:
        print("\n".join(f"  {name}" for name in names))


def extracted(bag: str, folder: str) -> list[str]:
    """Write a bag's attachments into a folder; return their names."""
    from mrlab_ros.adapters.bags.extract import extract as write

    return write(opened(bag), Path(folder))


@app.command()
def report(
    bag: BagArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            help="A page to write, such as report.html, or a folder for report.txt, .json, .png "
            "and .html."
        ),
    ] = None,
    reference: Annotated[
        Path | None,
        typer.Option(
            help="Compare the runs with the trajectory in this file; not given: with what was "
            "played."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Report who did what, when, with what result: one row a run, technical figures last."""
    path = path_of(bag)
    compared = None
    if reference is not None:
        from mrlab_ros.commands.lab.reference import reference_of

        known = reference_of(reference, _walled(model_of, path))
        course = known.course
        compared = (known.name, known.model, course.frame_rate, course.positions.tolist())
    form = "" if out is None else "page" if out.suffix.lower() in (".html", ".htm") else "all"
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        _walled(reported, path, as_json, compared, folder, form, write=[Path(folder)])
        if out is None:
            return
        if form == "page":
            _bring(Path(folder, "report.html"), out)
            print(f"wrote {out}", file=sys.stderr)
            return
        _bring(Path(folder), out)
        print(f"wrote report.txt, .json, .png and .html to {out}", file=sys.stderr)


def _bring(made: Path, target: Path) -> None:
    """Copy a file, or a folder into another one: each file as a whole, or the one before stays."""
    from mrlab_ros.adapters.whole_file import named_output

    for path in (p for p in (made, *sorted(made.rglob("*"))) if p.is_file()):
        place = target / path.relative_to(made)
        place.parent.mkdir(parents=True, exist_ok=True)
        with path.open("rb") as source, named_output(place) as file:
            shutil.copyfileobj(source, file)


def model_of(bag: str) -> str:
    """Return the model of the first robot of a bag."""
    from mrlab_ros.adapters.bags.session import model_that_played

    return model_that_played(opened(bag))


def reported(
    bag: str,
    as_json: bool,
    compared: tuple[str, str, float, list[list[float]]] | None,
    folder: str,
    form: str,
) -> None:
    """Print the report of a bag; form: also into the folder, its `page` alone, or `all` forms.

    compared: a trajectory by its name, model, rate, Hz, and positions, rad.
    """
    from mrlab_ros.adapters.bags.session import read_session
    from mrlab_ros.core.recording.report_text import report_lines

    found = opened(bag)
    session = read_session(found, None if compared is None else _reference(*compared))
    # a name in it may hold the end of a line
    lines = [visible(_title(found)), *report_lines(session, output.with_fixes)]
    text = "\n".join(lines) + "\n"
    said = {"bag": str(found.path.resolve()), **session.facts()}
    facts = json.dumps(said, indent=2) + "\n"
    print(facts if as_json else text, end="")
    out = Path(folder)
    if form:
        from mrlab_ros.adapters import share
        from mrlab_ros.app.show.session import session_page

        page = session_page(found, share.directory(), session)
        (out / "report.html").write_text(page, encoding="utf-8")
    if form == "all":
        from mrlab_ros.adapters.bags.plot import draw

        (out / "report.txt").write_text(text)
        (out / "report.json").write_text(facts)
        draw(session, _title(found), out / "report.png")


def _reference(name: str, model: str, rate: float, positions: list[list[float]]) -> Reference:
    import numpy as np

    from mrlab_ros.adapters.bags.courses import Reference
    from mrlab_ros.core.recording.report import ReferenceTrajectory

    return Reference(name, model, ReferenceTrajectory(rate, np.array(positions)))


def _title(bag: Bag) -> str:
    return f"{bag.path.name}, {_began(bag)}" if bag.message_count else bag.path.name


def _began(bag: Bag) -> str:
    return datetime.fromtimestamp(bag.start_ns / 1e9).strftime("%Y-%m-%d %H:%M:%S")


def _facts(bag: Bag) -> dict[str, Any]:
    return {
        "path": str(bag.path),
        "start_ns": bag.start_ns,
        "duration": bag.duration,
        "messages": bag.message_count,
        "bytes": bag.size,
        "files": [path.name for path in bag.paths],
        "live": bag.live,
        "troubles": plain(bag.troubles),
        "gaps": [asdict(gap) for gap in bag.gaps()],
        "versions": bag.versions(),
        "topics": [
            {
                "name": topic.name,
                "type": topic.type,
                "messages": topic.messages,
                "latched": topic.latched,
                "type_hash": topic.type_hash,
            }
            for topic in bag.topics.values()
        ],
        "attachments": bag.attachments(),
    }


def _print(bag: Bag) -> None:
    from rich import box
    from rich.table import Table

    from mrlab_ros.adapters.bags.diagnostics import BAG_LIVE
    from mrlab_ros.core.recording.diagnostics import ENDING

    console = output.console()
    began = f"{bag.duration:.1f} s from {_began(bag)}, " if bag.message_count else ""
    console.print(
        f"{bag.path}: {began}{bag.message_count} messages, "
        f"{bag.size / 1e6:.1f} MB in {len(bag.paths)} file{'s' * (len(bag.paths) != 1)}",
        soft_wrap=True,
    )
    for trouble in [BAG_LIVE(fixes=ENDING)] if bag.live else bag.troubles:
        console.print(output.with_fixes(trouble), soft_wrap=True)
    for gap in bag.gaps():
        console.print(str(gap.said(bag.start_ns)), soft_wrap=True)
    table = Table("topic", "type", box=box.SIMPLE_HEAD)
    for column in table.columns:
        column.overflow = "fold"
    table.add_column("messages", justify="right")
    table.add_column("Hz", justify="right")
    for topic in sorted(bag.topics.values(), key=lambda topic: topic.name):
        rate = "latched" if topic.latched else f"{topic.messages / max(bag.duration, 1e-9):.1f}"
        table.add_row(visible(topic.name), visible(topic.type), str(topic.messages), rate)
    console.print(table)
    attachments = bag.attachments()
    groups: dict[str, list[int]] = {}
    for name, size in attachments.items():
        groups.setdefault(name.split("/")[0], []).append(size)
    for name, sizes in groups.items():
        console.print(f"{visible(name)}: {len(sizes)} attached, {sum(sizes) / 1e3:.0f} kB")
    for name, version in bag.versions().items():
        console.print(visible(f"{name} {version}"))
