"""`mrlab compare` and `mrlab capture`: what a real robot did, beside what was planned."""

from __future__ import annotations

import json
import math
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import completion, output
from mrlab_ros.commands.convert.options import convert_words
from mrlab_ros.core.base.errors import WrongUsage
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from mrlab_ros.adapters.robots.library import RobotLibrary
    from mrlab_ros.core.conversion.convert import ConversionResult
    from mrlab_ros.core.trajectory.comparison import Comparison

LONGEST_S = 3600.0
MOST_DOMAIN = 232.0
LEAST_SHOWN = math.radians(0.005)  # what is 0.00 in the table is not off
MOST_OF_IT = 0.98  # of the planned motion: where less is compared, that is said

Robot = Annotated[
    str,
    typer.Option(help="Robot that moves, such as ur5e.", autocompletion=completion.models),
]


def compare(
    planned: Annotated[Path, typer.Argument(help="The planned motion: what convert takes.")],
    measured: Annotated[Path, typer.Argument(help="The other, such as a bag of a real robot.")],
    robot: Robot,
    as_json: output.AsJson = False,
) -> None:
    """Say how late a motion is, and how far each joint is off the planned one.

    The delay is counted from the first frame of each and taken out before joints are compared.
    Ends with 0, or as mrlab convert where a file is refused.
    """
    results = [_converted(file, robot, as_json=as_json) for file in (planned, measured)]
    said = _compared(results[0], results[1], (planned.name, measured.name), None, as_json=as_json)
    if as_json:
        print(json.dumps(said))


def capture(
    topic: Annotated[str, typer.Argument(help="Topic of joint states, such as /joint_states.")],
    robot: Robot,
    seconds: Annotated[float, typer.Option(help="How long; Ctrl-C ends it before.")] = 10.0,
    out: Annotated[
        Path | None, typer.Option(help="Bag to make; not given: named by date and time.")
    ] = None,
    against: Annotated[
        str,
        typer.Option(help="The planned motion: a file, or a topic that is captured beside it."),
    ] = "",
    name: Annotated[
        str, typer.Option(help="Put the motion into the running lab's catalogue by this name.")
    ] = "",
    from_ros_domain: Annotated[
        int | None, typer.Option(help="ROS domain of the robot; not given: ROS_DOMAIN_ID.")
    ] = None,
    timeout: Annotated[float, typer.Option(help="How long to wait for the topic, s.")] = 10.0,
    as_json: output.AsJson = False,
) -> None:
    """Record a real robot's joint states into a bag, and make a motion of them.

    The bag is what every other command takes: mrlab check, show, play. Ends as mrlab convert does.
    """
    from mrlab_ros.commands.convert import topic as topics
    from mrlab_ros.commands.convert.diagnostics import LIMIT_OUT_OF_RANGE
    from mrlab_ros.commands.diagnostics import CAPTURED

    for option, value, most, unit in (
        ("seconds", seconds, LONGEST_S, "s"),
        ("timeout", timeout, LONGEST_S, "s"),
        ("from-ros-domain", float(from_ros_domain or 0), MOST_DOMAIN, ""),
    ):
        if not 0 <= value <= most:
            raise WrongUsage(
                LIMIT_OUT_OF_RANGE(option=option, value=value, least=0.0, most=most, unit=unit)
            )
    _library().model(robot)
    robots = topics.full_name(topic)
    bag = out or Path(time.strftime("capture_%Y-%m-%d_%H-%M-%S"))
    bags, planned = {robots: bag}, None
    # A path may begin as a topic does.
    if against.startswith("/") and not Path(against).exists():
        bags[topics.full_name(against)] = bag.with_name(f"{bag.name}_planned")
    elif against:
        # A wrong plan is found before the robot has moved.
        planned = _converted(Path(against), robot, as_json=as_json)
    stamps = topics.record(bags, seconds, timeout, from_ros_domain)
    facts: dict[str, Any] = {}
    for each, folder in bags.items():
        said = CAPTURED(bag=str(folder), messages=len(stamps[each]), topic=each)
        facts.setdefault("bags", []).append(str(folder))
        if not as_json:
            output.say(said, as_json=False)
    result = _converted(bag, robot, as_json=as_json, shown=not as_json)
    facts["duration"] = result.trajectory.duration if result.trajectory else 0.0
    apart = None
    if len(bags) > 1:
        planned = _converted(bags[against], robot, as_json=as_json)
        # Each motion begins at the stamp of its first message.
        apart = (stamps[robots][0] - stamps[against][0]) * 1e-9
    if planned is not None:
        facts |= _compared(planned, result, (against, robots), apart, as_json=as_json)
    if name:
        from mrlab_ros.client.lab import Lab

        with Lab() as lab:
            motion = lab.convert(bag, robot, id=name)
        facts["id"] = motion.id
        if not as_json:
            print(f"in the lab's catalogue: {motion.id}")
    if as_json:
        print(json.dumps(facts))


def _library() -> RobotLibrary:
    from mrlab_ros.adapters import share
    from mrlab_ros.adapters.robots.library import RobotLibrary

    return RobotLibrary(share.directory() / "robots")


def _converted(file: Path, robot: str, *, as_json: bool, shown: bool = False) -> ConversionResult:
    """Convert a file; end as mrlab convert does where it is refused. shown: also where not."""
    from mrlab_ros.app.convert import converted
    from mrlab_ros.commands.convert import report
    from mrlab_ros.commands.convert.outcomes import exit_code

    result = converted(file, robot, "", Options(), _library())
    if shown or result.trajectory is None:
        console = output.console(stderr=as_json)
        # What is advised writes a file: this command takes no options of a conversion.
        words = [*convert_words(file, robot), "--to", "mat", "--out", "mended"]
        report.show(result, None, words, Options(), console)
    if result.trajectory is None:
        raise typer.Exit(exit_code(result))
    return result


def _compared(
    planned: ConversionResult,
    measured: ConversionResult,
    names: tuple[str, str],
    apart: float | None,
    *,
    as_json: bool,
) -> dict[str, Any]:
    """Compare two motions, print the result, and return what --json prints of it.

    apart: s by which the measured one begins later; None: unknown.
    """
    from mrlab_ros.commands.diagnostics import COMPARED
    from mrlab_ros.core.base.diagnostic import plain
    from mrlab_ros.core.trajectory.comparison import compare as compared

    assert planned.trajectory is not None
    assert measured.trajectory is not None
    found = compared(planned.trajectory, measured.trajectory)
    delay = found.delay + (apart or 0.0)
    late, whole = round(delay, 4), planned.trajectory.duration
    joint = found.joint_names[found.worst] if found.most.max() >= LEAST_SHOWN else None
    said = COMPARED(
        planned=names[0],
        measured=names[1],
        delay=abs(late) or None,
        side="ahead" if late < 0 else "late" if late else "same",
        clock="frames" if apart is None else "stamps",
        joint=joint,
        alike=None if joint else "yes",
        compared=round(found.compared, 2) if found.compared < MOST_OF_IT * whole else None,
        whole=round(whole, 2),
    )
    if not as_json:
        _show(found)
        output.say(said, as_json=False)
    return {
        "comparison": {
            "message": str(said),
            "delay": delay,
            "compared": found.compared,
            "joints": [
                {"name": joint, "rms": rms, "most": most, "time": at}
                for joint, rms, most, at in zip(
                    found.joint_names,
                    found.rms.tolist(),
                    found.most.tolist(),
                    found.times.tolist(),
                    strict=True,
                )
            ],
            "said": plain(said),
        }
    }


def _show(found: Comparison) -> None:
    from rich.table import Table

    table = Table("joint", box=None, header_style="bold", pad_edge=False)
    for heading in ("rms", "most", "at"):
        table.add_column(heading, justify="right")
    for joint, rms, most, at in zip(
        found.joint_names, found.rms, found.most, found.times, strict=True
    ):
        table.add_row(
            joint, f"{math.degrees(rms):.2f}°", f"{math.degrees(most):.2f}°", f"{at:.2f} s"
        )
    output.console(width=output.REPORT_WIDTH).print(table)
