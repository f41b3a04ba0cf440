"""Plans the steps from what the lab holds to what a document describes: the one restore.

A saved scene replaces all that is there. After a restart or a replay only what is missing comes
back. Nothing here acts: the lab node checks a plan's document, then runs its steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.scene.diagnostics import (
    ADD_OBJECTS,
    CONTENTS_LEFT_OUT,
    CREATE_SYSTEM,
    DISSOLVE_SYSTEMS,
    GO_TO_PLACE,
    GRIP_OBJECTS,
    LOAD_TRAJECTORY,
    LOADED_IN_PART,
    NO_TRAJECTORY_NAMED,
    POSITION_BEYOND,
    REMOVE_ROBOTS,
    SET_CONTENTS,
    SPAWN_ROBOTS,
    STEP_FAILED,
    TRAJECTORY_NOT_FITTING,
)
from mrlab_ros.core.scene.document import (
    ObjectEntry,
    Place,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.core.systems.members import Loaded
from mrlab_ros.core.systems.timeline import Member, Timeline
from mrlab_ros.core.systems.waits import parse as parse_wait


@dataclass(frozen=True)
class Present:
    """The contents of the lab. loaded: by robot the trajectory that its playback has loaded, empty
    for none; a robot whose playback is unknown is left out. physics: whether it runs. objects: by
    name who holds each, empty for nobody."""

    robots: frozenset[str] = frozenset()
    loaded: Mapping[str, str] = field(default_factory=dict)
    systems: frozenset[str] = frozenset()
    physics: bool = False
    objects: Mapping[str, str] = field(default_factory=dict)

    @property
    def names(self) -> frozenset[str]:
        """The names that are taken."""
        return self.robots | self.systems | self.objects.keys()


@dataclass(frozen=True)
class GoTo:
    """Say that the lab stands in another place."""

    place: Place

    @property
    def said(self) -> Diagnostic:
        return GO_TO_PLACE(place=self.place.name or self.place.id)


@dataclass(frozen=True)
class DissolveSystems:
    """Dissolve systems; their robots stay."""

    names: tuple[str, ...]

    @property
    def said(self) -> Diagnostic:
        return DISSOLVE_SYSTEMS(systems=[*self.names])


@dataclass(frozen=True)
class RemoveRobots:
    """Remove them, and wait until their playbacks and their arms in physics are gone."""

    names: tuple[str, ...]

    @property
    def said(self) -> Diagnostic:
        return REMOVE_ROBOTS(robots=[*self.names])


@dataclass(frozen=True)
class SetObjects:
    """Replace all objects and surfaces; physics lets robots hold theirs as they come."""

    objects: tuple[ObjectEntry, ...]
    surfaces: tuple[Surface, ...]

    @property
    def said(self) -> Diagnostic:
        return SET_CONTENTS(objects=len(self.objects), surfaces=len(self.surfaces))


@dataclass(frozen=True)
class AddObjects:
    """Put objects beside those that are there; robots that held one hold it again."""

    objects: tuple[ObjectEntry, ...]

    @property
    def said(self) -> Diagnostic:
        return ADD_OBJECTS(objects=[thing.name for thing in self.objects])


@dataclass(frozen=True)
class SpawnRobots:
    """Spawn robots where their entries place them."""

    robots: tuple[RobotEntry, ...]

    @property
    def said(self) -> Diagnostic:
        return SPAWN_ROBOTS(robots=[robot.name for robot in self.robots])


@dataclass(frozen=True)
class LoadTrajectory:
    """Load a robot's trajectory, with its rate, loop and position."""

    robot: RobotEntry

    @property
    def said(self) -> Diagnostic:
        return LOAD_TRAJECTORY(trajectory=self.robot.trajectory, robot=self.robot.name)


@dataclass(frozen=True)
class CreateSystem:
    """Create a system whose members all name their trajectories; set its rate and position."""

    system: SystemEntry

    @property
    def said(self) -> Diagnostic:
        return CREATE_SYSTEM(system=self.system.name)


@dataclass(frozen=True)
class AwaitGrasps:
    """Wait until physics announces that the robots hold their objects."""

    objects: tuple[ObjectEntry, ...]

    @property
    def said(self) -> Diagnostic:
        holders = [thing.held_by for thing in self.objects]
        return GRIP_OBJECTS(robots=holders, objects=[thing.name for thing in self.objects])


@dataclass(frozen=True)
class Grip:
    """Put objects of the scene back into the hands that held them."""

    objects: tuple[ObjectEntry, ...]

    @property
    def said(self) -> Diagnostic:
        return AwaitGrasps(self.objects).said


Step = (
    GoTo
    | DissolveSystems
    | RemoveRobots
    | SetObjects
    | AddObjects
    | SpawnRobots
    | LoadTrajectory
    | CreateSystem
    | AwaitGrasps
    | Grip
)


def plan_scene(wanted: SceneDocument, present: Present) -> tuple[Step, ...]:
    """Return the steps that replace all that is there by what the document says."""
    steps: list[Step] = [GoTo(wanted.place)] if wanted.place is not None else []
    if present.systems:
        steps.append(DissolveSystems(tuple(sorted(present.systems))))
    if present.robots:
        steps.append(RemoveRobots(tuple(sorted(present.robots))))
    if present.physics:
        # Before the robots come: fingers can only close on what is there.
        steps.append(SetObjects(wanted.objects, wanted.surfaces))
    steps += plan_return(wanted, Present())
    held = tuple(thing for thing in wanted.objects if thing.held_by)
    if held and present.physics:
        steps.append(AwaitGrasps(held))
    return tuple(steps)


def plan_return(wanted: SceneDocument, present: Present) -> tuple[Step, ...]:
    """Return the steps that bring back what is missing, and leave alone what is there.

    Objects and surfaces are not part of it: physics brings back its own.
    """
    steps: list[Step] = []
    missing = tuple(robot for robot in wanted.robots if robot.name not in present.robots)
    if missing:
        steps.append(SpawnRobots(missing))
    # The trajectory of a member is its system's to load, and the position the system's to seek.
    steps += [
        LoadTrajectory(robot)
        for robot in wanted.robots
        if robot.trajectory
        and robot.name not in wanted.driven
        and not present.loaded.get(robot.name)
    ]
    steps += [
        CreateSystem(_complete(system, wanted.robots))
        for system in wanted.systems
        if system.name not in present.systems
    ]
    return tuple(steps)


def left_out(wanted: SceneDocument, present: Present) -> Diagnostic | None:
    """Return what the lab cannot bring back; None: nothing."""
    if present.physics or not (wanted.objects or wanted.surfaces):
        return None
    return CONTENTS_LEFT_OUT(objects=len(wanted.objects), surfaces=len(wanted.surfaces))


def with_pending(scene: SceneDocument, pending: SceneDocument) -> SceneDocument:
    """Return the scene with what is about to be restored in it, in place of what is not yet."""
    robots = {robot.name: robot for robot in pending.robots}
    restored = []
    for robot in scene.robots:
        before = robots.get(robot.name)
        if before is not None:
            robot = replace(
                robot,
                trajectory=before.trajectory,
                at=before.at,
                rate=before.rate,
                loop=before.loop,
            )
        restored.append(robot)
    names = {system.name for system in scene.systems}
    systems = [system for system in pending.systems if system.name not in names]
    return replace(scene, robots=tuple(restored), systems=(*scene.systems, *systems))


def self_contained(scene: SceneDocument) -> SceneDocument:
    """Return the scene without what names robots that are not in it.

    Its parts come from several nodes: a robot may leave between two of them.
    """
    robots = {robot.name for robot in scene.robots}
    return replace(
        scene,
        objects=tuple(
            thing if thing.held_by in robots else replace(thing, held_by="", in_hand=None)
            for thing in scene.objects
        ),
        systems=tuple(
            system
            for system in scene.systems
            if all(member.robot in robots for member in system.members)
        ),
    )


def run(
    steps: Sequence[Step], execute: Callable[[Step], None], failed: Code = LOADED_IN_PART
) -> None:
    """Run the steps in order; raise LabError, `failed`, that names what was done and what not."""
    for i, step in enumerate(steps):
        try:
            execute(step)
        except LabError as error:
            raise LabError(
                failed(
                    why=STEP_FAILED(step=step.said, why=error.diagnostic),
                    done=[each.said for each in steps[:i]],
                    rest=[each.said for each in steps[i + 1 :]],
                )
            ) from error


def check_trajectories(
    wanted: SceneDocument, catalogue: Callable[[RobotEntry], Sequence[Loaded]]
) -> None:
    """Raise BadInput where a robot or a system cannot have the trajectories it names.

    catalogue: returns the trajectories that fit a robot with its end effector.
    """
    fitting: dict[str, Mapping[str, Loaded]] = {}
    robots = {robot.name: robot for robot in wanted.robots}

    def fits(name: str, trajectory: str) -> Loaded:
        if name not in fitting:
            fitting[name] = {t.trajectory_id: t for t in catalogue(robots[name])}
        if trajectory not in fitting[name]:
            known = [*fitting[name]]
            raise BadInput(TRAJECTORY_NOT_FITTING(robot=name, trajectory=trajectory, known=known))
        return fitting[name][trajectory]

    for robot in wanted.robots:
        if robot.trajectory and robot.name not in wanted.driven:
            loaded = fits(robot.name, robot.trajectory)
            if robot.at > loaded.duration:
                raise BadInput(
                    POSITION_BEYOND(
                        robot=robot.name,
                        trajectory=robot.trajectory,
                        position=robot.at,
                        duration=loaded.duration,
                        most=math.floor(loaded.duration * 1000) / 1000,
                    )
                )
    for system in wanted.systems:
        members = []
        for m in _complete(system, wanted.robots).members:
            if not m.trajectory:
                raise BadInput(NO_TRAJECTORY_NAMED(system=system.name, robot=m.robot))
            waits = tuple(map(parse_wait, m.waits))
            loaded = fits(m.robot, m.trajectory)
            members.append(
                Member(
                    m.robot,
                    m.trajectory,
                    m.dwell,
                    waits,
                    duration=loaded.duration,
                    frame_rate=loaded.frame_rate,
                )
            )
        Timeline(members, system.mode).check_waits()


def _complete(system: SystemEntry, robots: Sequence[RobotEntry]) -> SystemEntry:
    """Return the system whose members play what their robots have where they name nothing."""
    loaded = {robot.name: robot.trajectory for robot in robots}
    members = [
        replace(member, trajectory=member.trajectory or loaded.get(member.robot, ""))
        for member in system.members
    ]
    return replace(system, members=tuple(members))
