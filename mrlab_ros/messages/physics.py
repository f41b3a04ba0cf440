"""Messages of the physics to the core's objects and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from geometry_msgs.msg import Point, Twist, Vector3
from mrlab_msgs import msg
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA

from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, Vector, checked_vector
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.engine import BodyState, Kind, Shape
from mrlab_ros.core.physics.grasp.load import Load
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world_state import (
    CollisionChanged,
    Contact,
    GraspChanged,
    ObjectRemoved,
    SceneObject,
)
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.diagnostics import SURFACE_HALF_TRIANGLE, SURFACE_WITHOUT_NAME
from mrlab_ros.core.scene.placement import Support, Thing, support_of
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.messages.poses import pose_from_message, pose_to_message
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header, time_from_message, time_to_message

WORLD = "world"
PRIMITIVES = {
    Shape.BOX: SolidPrimitive.BOX,
    Shape.CYLINDER: SolidPrimitive.CYLINDER,
    Shape.SPHERE: SolidPrimitive.SPHERE,
}


def playing_from_message(message: msg.PlaybackState, shifted_ns: int) -> Playing:
    """shifted_ns: by how much the message's stamps are ahead of instants."""
    clock = message.clock
    return Playing(
        State(message.state),
        message.trajectory_id,
        PlaybackClock(time_from_message(clock.stamp) - shifted_ns, clock.position, clock.rate),
        message.frame,
        message.frame_count,
        message.frame_rate,
        message.duration,
        time_from_message(message.header.stamp) - shifted_ns,
    )


def program_from_message(message: msg.GraspTargets) -> GripperProgram:
    return GripperProgram(
        tuple(target.time for target in message.targets),
        tuple(target.close for target in message.targets),
        tuple(pose_from_message(target.tool0) for target in message.targets),
    )


def velocity_from_message(message: Vector3) -> Vector:
    """Return a velocity; raise BadInput where it is not finite."""
    return checked_vector((message.x, message.y, message.z), "velocity")


def contact_to_message(contact: Contact, shifted_ns: int) -> msg.Contact:
    """shifted_ns: by how much stamps are ahead of instants, here and below."""
    touch = contact.touch
    return msg.Contact(
        stamp=time_to_message(contact.stamp_ns + shifted_ns),
        robot=contact.robot,
        link=touch.link,
        held=touch.held,
        kind=touch.kind.value,
        other=contact.robot if touch.kind is Kind.SELF else touch.other,
        other_link=touch.other_link,
        point=_point(touch.point),
        normal=_vector(touch.normal),
        depth=touch.depth,
        impulse=touch.impulse,
        frame=contact.frame,
    )


def contacts_to_message(now_ns: int, contacts: Iterable[Contact], shifted_ns: int) -> msg.Contacts:
    return msg.Contacts(
        header=make_header(now_ns + shifted_ns, WORLD),
        contacts=[contact_to_message(contact, shifted_ns) for contact in contacts],
    )


def objects_to_message(now_ns: int, objects: list[msg.SceneObject]) -> msg.SceneObjects:
    return msg.SceneObjects(header=make_header(now_ns, WORLD), objects=objects)


def surfaces_to_message(now_ns: int, surfaces: Iterable[Surface]) -> msg.Surfaces:
    return msg.Surfaces(
        header=make_header(now_ns, WORLD), surfaces=[surface_to_message(s) for s in surfaces]
    )


def overlaps_to_message(now_ns: int, found: Iterable[tuple[str, Surface]]) -> msg.Overlaps:
    """found: the robots, each with a surface that it stands in."""
    return msg.Overlaps(
        header=make_header(now_ns, WORLD),
        overlaps=[msg.Overlap(robot=robot, surface=s.name, label=s.label) for robot, s in found],
    )


def collision_to_message(event: CollisionChanged, shifted_ns: int) -> msg.Collision:
    contact = event.contact
    return msg.Collision(
        header=make_header(event.stamp_ns + shifted_ns, WORLD),
        colliding=event.colliding,
        contact=contact_to_message(contact, shifted_ns) if contact else msg.Contact(),
        clearance=event.clearance,
    )


# Of a gripper that holds nothing.
NO_LOAD = Load(mass=0.0, payload=0.0, friction=0.0, friction_needed=0.0, wrist_moment=0.0)


def grasp_to_message(event: GraspChanged, fingers: list[str], shifted_ns: int) -> msg.Grasp:
    """fingers: the finger joints, in the order of the event's positions."""
    load = event.load or NO_LOAD
    return msg.Grasp(
        header=make_header(event.stamp_ns + shifted_ns, f"{event.robot}/tool0"),
        state=event.state.value,
        object=event.object,
        fingers=fingers,
        finger_positions=event.positions,
        finger_forces=event.forces,
        **told(event.reason, "reason"),
        severity=event.reason.severity if event.reason else msg.Diagnostic.INFO,
        mass=load.mass,
        payload=load.payload,
        friction=load.friction,
        friction_needed=load.friction_needed,
        slip_margin=load.slip_margin,
        wrist_moment=load.wrist_moment,
    )


def fingers_to_message(now_ns: int, robot: str, positions: Mapping[str, float]) -> JointState:
    """positions: of the finger joints by name, m or rad."""
    return JointState(
        header=make_header(now_ns, robot), name=list(positions), position=list(positions.values())
    )


def removed_to_message(event: ObjectRemoved, shifted_ns: int) -> msg.ObjectRemoved:
    return msg.ObjectRemoved(
        header=make_header(event.stamp_ns + shifted_ns, WORLD),
        name=event.name,
        type=event.type,
        **told(event.why, "reason"),
    )


def object_to_message(
    thing: SceneObject, motion: BodyState, in_tool: Pose | None = None
) -> msg.SceneObject:
    """in_tool: T_tool0_object where a robot holds it."""
    kind = thing.type
    return msg.SceneObject(
        name=thing.name,
        type=kind.id,
        pose=pose_to_message(motion.pose),
        twist=Twist(linear=_vector(motion.linear), angular=_vector(motion.angular)),
        size=_vector(kind.size),
        mass=kind.mass,
        color=_color(kind),
        mesh=kind.mesh,
        primitive=primitive_to_message(kind),
        held_by=thing.held_by,
        in_tool=pose_to_message(in_tool or Pose()),
    )


def type_to_message(kind: ObjectType) -> msg.ObjectType:
    return msg.ObjectType(
        id=kind.id,
        about=kind.about,
        size=_vector(kind.size),
        mass=kind.mass,
        color=_color(kind),
        mesh=kind.mesh,
        primitive=primitive_to_message(kind),
    )


def primitive_to_message(kind: ObjectType) -> SolidPrimitive:
    """Return the shape of an object; type 0 where it is none that a SolidPrimitive can be."""
    solid = kind.solid
    if solid is None:
        return SolidPrimitive()
    # The order of the dimensions is that of shape_msgs: height before radius.
    size = solid.size[::-1] if solid.shape is Shape.CYLINDER else solid.size
    return SolidPrimitive(type=PRIMITIVES[solid.shape], dimensions=size)


def surface_to_message(surface: Surface) -> msg.Surface:
    return msg.Surface(
        name=surface.name,
        label=surface.label,
        source=surface.source,
        pose=pose_to_message(surface.pose),
        vertices=[Point(x=x, y=y, z=z) for x, y, z in surface.vertices.tolist()],
        triangles=surface.triangles.ravel().tolist(),
    )


def surface_from_message(message: msg.Surface) -> Surface:
    """Return a surface; raise BadInput where it has no name or no whole triangles."""
    if len(message.triangles) % 3:
        raise BadInput(SURFACE_HALF_TRIANGLE(surface=message.name, count=len(message.triangles)))
    if not message.name:
        raise BadInput(SURFACE_WITHOUT_NAME())
    vertices = [(v.x, v.y, v.z) for v in message.vertices]
    return Surface(
        message.name,
        message.label,
        pose_from_message(message.pose),
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(message.triangles, dtype=np.int64).astype(np.int32).reshape(-1, 3),
        message.source,
    )


def things_from_message(objects: Iterable[msg.SceneObject]) -> tuple[Thing, ...]:
    """Return the objects that a robot must not be put into: those that nobody holds."""
    free = (thing for thing in objects if not thing.held_by)
    return tuple(Thing.of(pose_from_message(t.pose), (t.size.x, t.size.y, t.size.z)) for t in free)


def supports_from_message(message: msg.Surfaces) -> tuple[Support, ...]:
    """Return the level surfaces of a room, those that robots stand on beside the endless floor."""
    found = []
    for each in message.surfaces:
        surface = surface_from_message(each)
        support = support_of(
            surface.name,
            surface.label,
            surface.pose,
            surface.vertices,
            is_mesh=len(surface.triangles) > 0,
        )
        if support is not None:
            found.append(support)
    return tuple(found)


def _color(kind: ObjectType) -> ColorRGBA:
    r, g, b, a = kind.color
    return ColorRGBA(r=r, g=g, b=b, a=a)


def _point(v: Vector) -> Point:
    return Point(x=v[0], y=v[1], z=v[2])


def _vector(v: Any) -> Vector3:
    return Vector3(x=v[0], y=v[1], z=v[2])
