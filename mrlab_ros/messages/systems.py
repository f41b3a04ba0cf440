"""Robot systems, their members and the orders between them as messages and back."""

from __future__ import annotations

from collections.abc import Iterable

from mrlab_msgs import msg

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.diagnostics import BAD_COMMAND
from mrlab_ros.core.systems.members import Command, Loaded, Order, Reply
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.systems.states import SystemState
from mrlab_ros.core.systems.timeline import Member
from mrlab_ros.core.systems.waits import parse
from mrlab_ros.messages.playback import clock_to_message
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header, time_from_message, time_to_message


def system_to_message(system: RobotSystem, shifted_ns: int = 0) -> msg.RobotSystem:
    """shifted_ns: by how much stamps are ahead of instants."""
    playing = system.state is SystemState.PLAYING
    return msg.RobotSystem(
        name=system.name,
        members=[
            msg.SystemMember(
                robot=m.robot,
                trajectory_id=m.trajectory_id,
                start=m.start,
                duration=m.duration,
                dwell=m.dwell,
                state=m.playback_state.value,
                position=m.position,
                waits=[wait.text for wait in m.waits],
                waiting_for=m.waiting_for.text if playing and m.waiting_for else "",
            )
            for m in system.members.values()
        ],
        mode=system.mode.value,
        policy=system.policy.value,
        state=system.state.value,
        label=system.state.name,
        **told(system.message),
        clock=clock_to_message(system.clock, shifted_ns),
        duration=system.duration,
        rate=system.rate,
        loop=system.loop,
    )


def systems_to_message(
    now_ns: int,
    systems: Iterable[RobotSystem],
    lab: str = "",
    holder: str = "",
    shifted_ns: int = 0,
) -> msg.RobotSystems:
    """Return the systems at the instant `now_ns`.

    lab: the id of the lab; holder: the coordinator that holds the claims. shifted_ns: by how much
    stamps are ahead of instants.
    """
    return msg.RobotSystems(
        header=make_header(now_ns + shifted_ns),
        systems=[system_to_message(system, shifted_ns) for system in systems],
        lab=lab,
        holder=holder,
    )


def member_to_message(robot: str, trajectory_id: str) -> msg.SystemMember:
    """Return a member that waits for nothing, as a request to create a system names it."""
    return msg.SystemMember(robot=robot, trajectory_id=trajectory_id)


def member_from_message(message: msg.SystemMember) -> Member:
    """Return a member of a system to be created; raise BadInput for a wait that is none."""
    waits = tuple(map(parse, message.waits))
    return Member(message.robot, message.trajectory_id, float(message.dwell), waits)


def order_to_message(order: Order, shifted_ns: int = 0) -> msg.DriveOrder:
    """shifted_ns: by how much stamps are ahead of instants."""
    return msg.DriveOrder(
        robot=order.robot,
        command=order.command.value,
        stamp=time_to_message(order.stamp_ns + shifted_ns if order.stamp_ns else 0),
        position=order.position,
        rate=order.rate,
        until=order.until or 0.0,
    )


def order_from_message(message: msg.DriveOrder) -> Order:
    """Return an order; raise BadInput for an unknown command."""
    try:
        command = Command(message.command)
    except ValueError:
        raise BadInput(BAD_COMMAND(command=message.command)) from None
    return Order(
        message.robot,
        command,
        time_from_message(message.stamp),
        message.position,
        message.rate,
        message.until or None,
    )


def reply_to_message(robot: str, playback: Playback, duration: float) -> msg.DriveReply:
    """Return what a member replies to an order. duration: s that its staging takes."""
    trajectory = playback.trajectory
    return msg.DriveReply(
        robot=robot,
        state=playback.state.value,
        position=playback.clock.position,
        duration=duration,
        trajectory_id=trajectory.id if trajectory else "",
        trajectory_duration=trajectory.duration if trajectory else 0.0,
        frame_rate=trajectory.frame_rate if trajectory else 0.0,
    )


def reply_from_message(message: msg.DriveReply, stamp_ns: int) -> Reply:
    """stamp_ns: when the order was carried out."""
    return Reply(State(message.state), message.position, message.duration, stamp_ns)


def loaded_from_message(message: msg.DriveReply, stamp_ns: int) -> Loaded:
    """stamp_ns: when the member was claimed."""
    return Loaded(
        message.trajectory_id,
        message.trajectory_duration,
        message.frame_rate,
        stamp_ns,
        State(message.state),
        message.position,
    )
