"""Checks a cell: all members on their timeline, each pair of robots, and waits that part them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes import files as scene_files
from mrlab_ros.app.check.diagnostics import (
    MEMBER_FILE_MISSING,
    MEMBER_FILE_NOT_BESIDE,
    MEMBER_NOT_IN_SCENE,
    MEMBER_REFUSED,
    MEMBER_WITHOUT_MOTION,
    NOT_ONE_SYSTEM,
    PLACES_NOT_KNOWN,
    PLAYS_BACKWARDS,
    ROBOTS_TWICE,
)
from mrlab_ros.app.check.stage import Played, Stage, first_link
from mrlab_ros.app.convert import (
    Wanted,
    convert_files,
    converted,
    held_to_robot,
    is_trajectory_file,
    of_trajectory_file,
)
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, of_text, plain
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.diagnostics import (
    IN_CELL,
    NO_WAIT_HELPS,
    WAIT_CLEARS,
    WAIT_CLEARS_TWO,
    WAIT_NOT_ENOUGH,
)
from mrlab_ros.core.checking.evidence import clearances
from mrlab_ros.core.checking.motion import CheckedRobot, MotionFigures
from mrlab_ros.core.checking.pairs import Delay, Pair, pairs_of, smallest_delay, wait_frame
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.checking.rehearsal_record import Course
from mrlab_ros.core.checking.report import CheckReport, RobotReport, conditions, in_order
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.physics.engine import Kind
from mrlab_ros.core.scene import document as scene_document
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.systems.cell_file import MemberEntry, SystemEntry
from mrlab_ros.core.systems.timeline import Mode
from mrlab_ros.core.systems.waits import parse
from mrlab_ros.core.trajectory.trajectory import Channels, Trajectory

# A file, the model that it is for, and its end effector, empty: none
Motion = tuple[Path, str, str]
Convert = Callable[[Path, str, str, Options, RobotLibrary], ConversionResult]

# Waits that are rehearsed before the search gives up.
MOST_REHEARSED = 3


@dataclass(frozen=True, eq=False)
class Cell:
    """A cell that can be rehearsed: its robots, their motions, and the rest of the scene."""

    title: str
    system: SystemEntry
    scene: SceneDocument
    robots: list[CheckedRobot]
    results: Mapping[str, ConversionResult]
    trajectories: Mapping[str, Trajectory]

    def actors(self, extra: Mapping[str, str]) -> list[Actor]:
        """Return the robots as they play. extra: a wait more, by robot."""
        members = {member.robot: member for member in self.system.members}
        order = [member.robot for member in self.system.members]
        actors = []
        for robot in self.robots:
            member = members.get(robot.name)
            if member is None:
                actors.append(Actor(robot.name, robot.model.home, first_link=first_link(robot)))
                continue
            texts = [*member.waits, *([extra[robot.name]] if robot.name in extra else [])]
            turn = order.index(robot.name)
            before = order[turn - 1] if turn and self.system.mode is Mode.SEQUENTIAL else ""
            actors.append(
                Actor(
                    robot.name,
                    robot.model.home,
                    self.trajectories[robot.name],
                    after=before,
                    dwell=members[before].dwell if before else 0.0,
                    waits=tuple(parse(text) for text in texts),
                    first_link=first_link(robot),
                )
            )
        return actors


def read(file: Path, scene: SceneDocument, named: str) -> tuple[SystemEntry, SceneDocument]:
    """Return the system of a cell file and the scene of its robots.

    scene: that of --scene, `named` so; a file that has robots of its own needs none. Raises
    LabError where it is not known where a robot stands.
    """
    content = scene_files.content(file)
    if isinstance(content, dict) and content.get("robots"):
        if named:
            raise Misuse(ROBOTS_TWICE(scene=named, file=file.name))
        scene = scene_document.parse(content, file.name)
        systems = scene.systems
    else:
        systems = scene_document.parse_cell(content, file.name)
        if not named:
            command = f"mrlab check {for_shell([str(file)])} --scene handover"
            raise Misuse(PLACES_NOT_KNOWN(file=file.name, fixes=(Fix(command=command),)))
    if len(systems) != 1:
        names = [system.name for system in systems]
        raise BadInput(NOT_ONE_SYSTEM(file=file.name, count=len(systems), names=names))
    there = [robot.name for robot in scene.robots]
    for member in systems[0].members:
        if member.robot not in there:
            raise BadInput(
                MEMBER_NOT_IN_SCENE(
                    robot=member.robot,
                    scene=named or None,
                    file=None if named else file.name,
                    robots=there,
                )
            )
    return systems[0], scene


def load(
    file: Path,
    system: SystemEntry,
    scene: SceneDocument,
    stage: Stage,
    options: Options,
    convert: Convert = converted,
    *,
    enclosed: bool = False,
) -> Cell:
    """Convert the motions of all members; files are beside the cell. Raises LabError.

    enclosed: no path leads out of the cell's folder.
    convert: reads a motion; the one that starts a process for it starts several at once.
    """
    robots = [stage.robot(r.name, r.model, r.end_effector, r.pose) for r in scene.robots]
    by_name = {robot.name: robot for robot in robots}
    loaded = {robot.name: robot.trajectory for robot in scene.robots}
    keys: dict[str, Motion] = {}
    for member in system.members:
        robot = by_name[member.robot]
        path = _path(file, member, loaded[member.robot], enclosed=enclosed)
        keys[member.robot] = (path, robot.model.id, robot.end_effector)
    wanted = list(dict.fromkeys(keys.values()))
    if convert is converted:
        results = _converted(wanted, stage, options)
    else:
        results = {key: convert(*key, options, stage.library) for key in wanted}
    results = {
        key: held_to_robot(found, stage.library) if is_trajectory_file(key[0]) else found
        for key, found in results.items()
    }
    found = {name: results[key] for name, key in keys.items()}
    trajectories = {}
    for name, result in found.items():
        if result.trajectory is None:
            why = next((d for d in result.diagnostics if d.refuses), of_text(result.message))
            path, model, _ = keys[name]
            command = f"mrlab check {for_shell([str(path)])} --robot {model}"
            raise BadInput(
                MEMBER_REFUSED(
                    robot=name, file=result.file, why=why, fixes=(Fix(command=command),)
                )
            )
        trajectories[name] = _at_rate(result.trajectory, system.rate)
    return Cell(system.name or file.stem, system, scene, robots, found, trajectories)


def _converted(
    motions: Sequence[Motion], stage: Stage, options: Options
) -> dict[Motion, ConversionResult]:
    """Convert motions in processes of their own, several at once."""
    wanted: dict[Motion, Wanted] = {}
    results: dict[Motion, ConversionResult] = {}
    for key in motions:
        path, model, end_effector = key
        given = of_trajectory_file(path)
        if given is not None:
            results[key] = given
        else:
            robot = stage.library.model(model)
            wanted[key] = Wanted(path, robot, options, end_effector or None)
    return results | dict(zip(wanted, convert_files(list(wanted.values())), strict=True))


def _path(file: Path, member: MemberEntry, loaded: str, *, enclosed: bool) -> Path:
    name = member.trajectory or loaded
    if not name:
        raise BadInput(MEMBER_WITHOUT_MOTION(file=file.name, robot=member.robot))
    path = file.parent / name
    if enclosed and not (_beside(path, file.parent) and path.is_file()):
        raise BadInput(MEMBER_FILE_NOT_BESIDE(trajectory=name, robot=member.robot, file=file.name))
    if not path.is_file():
        raise BadInput(
            MEMBER_FILE_MISSING(trajectory=name, robot=member.robot, folder=str(file.parent))
        )
    return path


def _beside(path: Path, folder: Path) -> bool:
    """Return whether a path, links followed, stays in a folder."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def _at_rate(trajectory: Trajectory, rate: float) -> Trajectory:
    """Return a trajectory played at `rate`; raise Misuse where that is backwards."""
    if rate < 0:
        raise Misuse(PLAYS_BACKWARDS(rate=rate))
    if rate == 1.0:
        return trajectory
    channels = Channels(trajectory.channels.velocities * rate, trajectory.channels.effort_proxy)
    return replace(trajectory, frame_rate=trajectory.frame_rate * rate, channels=channels)


def rehearse(cell: Cell, stage: Stage, closest: float) -> tuple[Played, list[Pair], Delay | None]:
    """Play the cell; where two robots conflict, look for the smallest wait that resolves it."""
    played = stage.rehearse(cell.robots, cell.actors({}), cell.scene)
    pairs = pairs_of(played.recorded, closest)
    first = pairs[0] if pairs and pairs[0].conflict is not None else None
    if first is None:
        return played, pairs, None
    return played, pairs, _resolved(cell, stage, played, first, closest)


def _resolved(
    cell: Cell, stage: Stage, played: Played, first: Pair, closest: float
) -> Delay | None:
    by_name = {robot.name: robot for robot in cell.robots}
    names = (first.robot, first.other)
    recorded = played.recorded
    waits = smallest_waits(
        stage,
        (by_name[names[0]], by_name[names[1]]),
        (recorded.robots[names[0]], recorded.robots[names[1]]),
        closest,
    )
    waits = [w for w in waits if names[w[0]] in cell.trajectories]
    best: Delay | None = None
    for who, seconds in waits[:MOST_REHEARSED]:
        robot, other = names[who], names[1 - who]
        if other not in cell.trajectories:
            continue
        t = cell.trajectories[other]
        frame = wait_frame(seconds, recorded.starts, robot, other, t.frame_rate, t.frame_count)
        text = f"frame 0: after {other}.frame {frame}"
        again = stage.rehearse(cell.robots, cell.actors({robot: text}), cell.scene, drawn=False)
        after = pairs_of(again.recorded, closest)
        clears = (
            all(p.conflict is None for p in after if {p.robot, p.other} == {robot, other})
            and not again.recorded.stuck
        )
        delay = Delay(
            robot, other, frame, seconds, text, clears, not any(p.touches for p in after)
        )
        if clears:
            return delay
        best = best or delay
    return best


def report_of(
    cell: Cell,
    played: Played,
    pairs: list[Pair],
    delay: Delay | None,
    inputs: Mapping[str, Any],
    closest: float,
) -> tuple[CheckReport, dict[str, tuple[Trajectory, MotionFigures]]]:
    """Return the report on a cell, and the motions with their figures by robot."""
    motions = {
        robot.name: (t, motion.figures_of(t, robot))
        for robot in cell.robots
        if (t := cell.trajectories.get(robot.name)) is not None
    }
    recorded = played.recorded
    found: list[Diagnostic] = []
    for name, (_, figures) in motions.items():
        start = recorded.starts.get(name, 0.0)
        own = motion.motion_findings(figures, name)
        found += [_later(f, start) for f in own]
    resolved = resolution(delay, pairs)
    advice = {frozenset((pairs[0].robot, pairs[0].other)): resolved} if resolved else {}
    found += motion.physics_findings(recorded, played.graspable, closest, advice)
    findings = in_order(found)
    scene = IN_CELL(robots=len(motions))
    robots = [
        RobotReport(
            r.name,
            r.model.id,
            r.end_effector,
            motions[r.name][0].id,
            vars(motions[r.name][0].source),
            {
                **motions[r.name][1].plain(),
                "starts": recorded.starts.get(r.name),
                "ends": recorded.ends.get(r.name),
                "waited": recorded.waited.get(r.name, 0.0),
            },
            motion.joint_rows(motions[r.name][1].joints),
            conditions(
                motions[r.name][1].joints,
                [f for f in findings if f.robot == r.name],
                rehearsed=True,
                scene=scene,
            ),
        )
        for r in cell.robots
        if r.name in motions
    ]
    extras = {
        "system": {"name": cell.system.name, "mode": cell.system.mode.name.lower()},
        "pairs": [vars(pair) for pair in pairs],
        "wait": vars(delay) if delay is not None else None,
        "resolution": plain(resolved) if resolved is not None else None,
    }
    report = CheckReport(
        cell.title, inputs, robots, findings, recorded.duration, clearances(recorded),
        tuple(recorded.grasps), (), extras,
    )  # fmt: skip
    return report, motions


def _later(found: Diagnostic, start: float) -> Diagnostic:
    """Return a finding of a motion at its time on the cell's timeline."""
    times = {"time": found.time, "end": found.end}
    return found.with_values(**{k: t + start for k, t in times.items() if t is not None})


def resolution(delay: Delay | None, pairs: list[Pair]) -> Diagnostic | None:
    """Return how the first conflict of two robots is resolved; None: there is no conflict."""
    if not pairs or pairs[0].conflict is None:
        return None
    if delay is None:
        return NO_WAIT_HELPS()
    code = WAIT_CLEARS if delay.all_clear else WAIT_CLEARS_TWO
    return (code if delay.clears else WAIT_NOT_ENOUGH)(
        robot=delay.robot, other=delay.other, seconds=delay.seconds, frame=delay.frame
    )


STEP = 0.1  # s, between two delays that are tried, and between the poses that are compared
MARGIN = 0.02  # m, beside what is allowed: the poses between two samples are not compared


def smallest_waits(
    stage: Stage,
    robots: tuple[CheckedRobot, CheckedRobot],
    courses: tuple[Course, Course],
    closest: float,
) -> list[tuple[int, float]]:
    """Return which of two robots waits (0 or 1) and how long, s; the shortest wait first.

    What they hold is not looked at: a rehearsal with the wait has the last word.
    """
    ways = tuple(
        _sampled(course, len(r.model.joints)) for r, course in zip(robots, courses, strict=True)
    )
    with stage.arms(robots) as engine:

        def clear(first: int, second: int) -> bool:
            for robot, way, at in zip(robots, ways, (first, second), strict=True):
                engine.move_arm(robot.name, way[at], [0.0] * len(way[at]))
            limit = closest + MARGIN
            return engine.nearest(robots[0].name, Kind.ROBOT, robots[1].name, limit) is None

        def swapped(function: Callable[[int, int], bool]) -> Callable[[int, int], bool]:
            return lambda i, j: function(j, i)

        found = []
        for waiting, asked in ((1, clear), (0, swapped(clear))):
            moves, waits = len(ways[1 - waiting]), len(ways[waiting])
            delay = smallest_delay(moves, waits, asked, moves)
            if delay is not None:
                found.append((waiting, delay * STEP))
    return sorted(found, key=lambda each: each[1])


def _sampled(course: Course, joints: int) -> list[list[float]]:
    """Return the joint positions of a course every STEP s."""
    samples, next_time = [], 0.0
    for time, values in zip(course.times, course.values, strict=True):
        if time >= next_time - 1e-9:
            samples.append(values[:joints])
            next_time += STEP
    return samples or [course.values[0][:joints]]
