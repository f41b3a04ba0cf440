"""Entries of a scene document from messages and as requests.

The robots of the scene as messages.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from mrlab_msgs import msg, srv
from std_msgs.msg import String

from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.document import MemberEntry, ObjectEntry, RobotEntry, SystemEntry
from mrlab_ros.core.scene.robots import PlacedRobot
from mrlab_ros.core.systems.members import Loaded
from mrlab_ros.core.systems.states import Policy, SystemState
from mrlab_ros.core.systems.timeline import Mode
from mrlab_ros.messages.poses import pose_from_message, pose_to_message
from mrlab_ros.messages.time import make_header, time_from_message


def robot_to_message(robot: PlacedRobot) -> msg.Robot:
    return msg.Robot(
        name=robot.name,
        model=robot.model,
        end_effector=robot.end_effector or "",
        pose=pose_to_message(robot.pose),
        joint_names=list(robot.joint_names),
    )


def robots_to_message(now_ns: int, robots: Iterable[PlacedRobot], lab: str = "") -> msg.Robots:
    """lab: the id of the lab they stand in; empty: unknown."""
    return msg.Robots(
        header=make_header(now_ns, "world"),
        robots=[robot_to_message(robot) for robot in robots],
        lab=lab,
    )


def text_to_message(text: str) -> String:
    """Return a text, such as a robot's URDF, as a message."""
    return String(data=text)


# In these states a position is part of what comes back; one that is READY begins at the start.
STANDING = (State.PLAYING, State.PAUSED, State.COLLISION_HALT)
SYSTEM_STANDING = (SystemState.PLAYING, SystemState.PAUSED, SystemState.COLLISION_HALT)


def robot_entry(robot: PlacedRobot, state: msg.PlaybackState | None, now_ns: int) -> RobotEntry:
    """Return a robot with what its playback has loaded; state: None where that is unknown."""
    entry = RobotEntry(robot.name, robot.model, robot.end_effector or "", robot.pose)
    # Without a version it is in no catalogue: somebody else's goal, or a stream.
    if state is None or not state.trajectory_version:
        return entry
    standing = State(state.state) in STANDING
    return RobotEntry(
        entry.name,
        entry.model,
        entry.end_effector,
        entry.pose,
        state.trajectory_id,
        _position(state.clock, state.duration, now_ns) if standing else 0.0,
        state.rate,
        state.loop,
    )


def system_entry(system: msg.RobotSystem, now_ns: int) -> SystemEntry:
    """Return a system with its position at `now_ns`."""
    standing = SystemState(system.state) in SYSTEM_STANDING
    return SystemEntry(
        system.name,
        tuple(
            MemberEntry(m.robot, m.trajectory_id, m.dwell, tuple(m.waits)) for m in system.members
        ),
        Mode(system.mode),
        Policy(system.policy),
        system.loop,
        system.rate,
        _position(system.clock, system.duration, now_ns) if standing else 0.0,
    )


def _position(clock: msg.PlaybackClock, duration: float, now_ns: int) -> float:
    pair = PlaybackClock(time_from_message(clock.stamp), clock.position, clock.rate)
    return min(max(pair.at(now_ns), 0.0), duration)


def create_system_request(system: SystemEntry) -> srv.CreateSystem.Request:
    return srv.CreateSystem.Request(
        name=system.name,
        members=[
            msg.SystemMember(
                robot=m.robot, trajectory_id=m.trajectory, dwell=m.dwell, waits=list(m.waits)
            )
            for m in system.members
        ],
        mode=system.mode.value,
        policy=system.policy.value,
        loop=system.loop,
    )


def placement_to_message(thing: ObjectEntry) -> msg.ObjectPlacement:
    placement = msg.ObjectPlacement(
        name=thing.name,
        type=thing.type,
        pose=pose_to_message(thing.pose),
        automatic=thing.automatic,
        held_by=thing.held_by,
    )
    if thing.in_hand is not None:
        placement.in_hand = pose_to_message(thing.in_hand)
    return placement


def placement_from_message(message: msg.ObjectPlacement) -> ObjectEntry:
    """Return an object's entry; raise BadInput where a pose is none."""
    return ObjectEntry(
        message.name,
        message.type,
        pose_from_message(message.pose),
        message.automatic,
        message.held_by,
        pose_from_message(message.in_hand) if message.held_by else None,
    )


def placements_from_messages(messages: Iterable[msg.ObjectPlacement]) -> tuple[ObjectEntry, ...]:
    return tuple(map(placement_from_message, messages))


def things_of_scene(
    things: Iterable[msg.SceneObject], robots: Collection[str]
) -> tuple[ObjectEntry, ...]:
    """Return objects as they are; the hand of a person holds none: it lets go."""
    return tuple(
        ObjectEntry(
            thing.name,
            thing.type,
            pose_from_message(thing.pose),
            held_by=thing.held_by if thing.held_by in robots else "",
        )
        for thing in things
    )


def loaded_from_messages(messages: Sequence[msg.TrajectoryInfo]) -> list[Loaded]:
    """Return what a playback would have loaded of each trajectory of a catalogue."""
    return [Loaded(info.id, info.duration, info.frame_rate) for info in messages]
