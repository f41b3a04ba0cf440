"""`mrlab export`: a motion or a recorded session for another viewer."""

from __future__ import annotations

import tempfile
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands.convert.options import ModelOfFile, ToolOfFile, with_options
from mrlab_ros.commands.diagnostics import EXPORTED
from mrlab_ros.commands.output import AsJson, say
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from mrlab_ros.core.recording.recorded_motion import RecordedMotion


class To(str, Enum):
    """What can be written."""

    rrd = "rrd"


@with_options
def export(
    options: Options,
    file: Annotated[
        Path, typer.Argument(help="Workspace, table, trajectory file, or recorded bag.")
    ],
    robot: ModelOfFile = "",
    end_effector: ToolOfFile = "",
    to: Annotated[To, typer.Option(help="rrd: robots that move, and curves, for Rerun.")] = To.rrd,
    output: Annotated[
        Path | None,
        typer.Option("--out", "--output", "-o", help="The file; none: FILE with .rrd, here."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Write FILE for Rerun's viewer: robots in 3D, their joints, objects, over the time in s.

    It needs the package rerun-sdk beside the lab. Ends as mrlab convert where a file is refused.
    """
    from mrlab_ros.adapters import rerun_file, share
    from mrlab_ros.adapters.robots.library import RobotLibrary
    from mrlab_ros.adapters.whole_file import named_output

    rerun_file.sdk()  # before a long session is read
    path = output or Path(f"{file.name.split('.')[0] or 'motion'}.{to.value}")
    library = RobotLibrary(share.directory() / "robots")
    motion = _recorded(file) or _converted(file, robot, end_effector, options, library)
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder, named_output(path) as target:
        rerun_file.write(motion, library, Path(folder, "made.rrd"))
        target.write(Path(folder, "made.rrd").read_bytes())
    said = EXPORTED(file=str(path), size=path.stat().st_size, robots=sorted(motion.robots))
    say(said, as_json=as_json, file=str(path.resolve()))


def _converted(
    file: Path, robot: str, end_effector: str, options: Options, library: Any
) -> RecordedMotion:
    """Return the motion of a file; end as mrlab convert does where it is refused."""
    from mrlab_ros.adapters.rerun_file import motion_of
    from mrlab_ros.app.convert import converted
    from mrlab_ros.commands.convert import report
    from mrlab_ros.commands.convert.options import convert_words
    from mrlab_ros.commands.convert.outcomes import exit_code

    result = converted(file, robot, end_effector, options, library)
    if result.trajectory is None:
        words = ["mrlab", "export", *convert_words(file, robot, end_effector)[2:]]
        report.show(result, None, words, options)
        raise typer.Exit(exit_code(result))
    return motion_of(result.trajectory)


def _recorded(file: Path) -> RecordedMotion | None:
    """Return what moved in a session, or None: it is another file, or a bag of a mere motion."""
    from mrlab_ros.adapters.rerun_file import of_plain
    from mrlab_ros.commands import sandboxed
    from mrlab_ros.commands.show import bag_at

    path = bag_at(file)
    if path is None:
        return None
    found = sandboxed.run(session_motion, str(path), name=path.name, read=[path])
    return None if found is None else of_plain(found)


def session_motion(bag: str) -> dict[str, Any] | None:
    """Return what moved in a session as JSON has it; None: the bag holds a mere motion."""
    from mrlab_ros.adapters.bags.motion import read_motion
    from mrlab_ros.adapters.rerun_file import plain
    from mrlab_ros.commands.bag import opened

    found = opened(bag)
    lab = any(topic.type == "mrlab_msgs/msg/Robots" for topic in found.topics.values())
    return plain(read_motion(found)) if lab else None
