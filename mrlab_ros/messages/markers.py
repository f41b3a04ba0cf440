"""The lab as markers, for RViz, Foxglove and other 3D panels.

A marker keeps its namespace and id while the thing is there, and is deleted with it. Stamps are 0,
which displays read as "the newest transform": what hangs at a link moves with it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, Quaternion, Vector3
from geometry_msgs.msg import Pose as PoseMessage
from mrlab_msgs import msg
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.frames import WORLD, frame_name
from mrlab_ros.messages.time import make_header

# A contact is shown this long, ns.
CONTACT_NS = 300_000_000
# The endless floor is drawn as a square of this edge, m.
FLOOR_SIZE = 10.0
# Edge lengths, widths and sizes of letters, m.
POINT_SIZE = 0.02
LINE_WIDTH = 0.004
ARROW = (0.006, 0.012, 0.0)
ARROW_LENGTH = 0.1
TEXT_HEIGHT = 0.06
# Above what a text belongs to, m.
TEXT_ABOVE = 0.12

RED = (0.85, 0.1, 0.15, 1.0)
ORANGE = (0.95, 0.55, 0.1, 1.0)
GREEN = (0.1, 0.65, 0.4, 1.0)
BLUE = (0.1, 0.4, 0.85, 1.0)
GREY = (0.6, 0.62, 0.65, 0.5)
WHITE = (0.95, 0.95, 0.95, 1.0)

Colour = tuple[float, float, float, float]


def array(markers: Iterable[Marker]) -> MarkerArray:
    """Return markers as one message."""
    return MarkerArray(markers=list(markers))


def without(before: Iterable[Marker], now: Iterable[Marker]) -> list[Marker]:
    """Return markers that delete what was shown before and is not shown now."""
    kept = {(marker.ns, marker.id) for marker in now}
    gone = [m for m in before if m.action == Marker.ADD and (m.ns, m.id) not in kept]
    return [
        Marker(header=m.header, ns=m.ns, id=m.id, type=m.type, action=Marker.DELETE) for m in gone
    ]


def object_marker(thing: msg.SceneObject) -> Marker:
    """Return an object as its mesh, or as its shape; without either as its bounding box."""
    marker = _marker(WORLD, f"objects/{thing.name}", Marker.CUBE, _colour_of(thing.color))
    marker.pose = thing.pose
    marker.scale = thing.size
    if thing.mesh:
        marker.type = Marker.MESH_RESOURCE
        marker.mesh_resource = thing.mesh
        marker.mesh_use_embedded_materials = True
        # RViz tints a mesh with the marker's colour unless that is 0.
        marker.color = ColorRGBA()
        marker.scale = Vector3(x=1.0, y=1.0, z=1.0)
    elif thing.primitive.type == SolidPrimitive.CYLINDER:
        marker.type = Marker.CYLINDER
    elif thing.primitive.type == SolidPrimitive.SPHERE:
        marker.type = Marker.SPHERE
    return marker


def surface_marker(surface: msg.Surface) -> Marker:
    """Return a surface of the room as triangles; the endless floor as a large thin square."""
    marker = _marker(WORLD, f"surfaces/{surface.name}", Marker.TRIANGLE_LIST, GREY)
    marker.pose = surface.pose
    if not surface.vertices:
        marker.type = Marker.CUBE
        marker.scale = Vector3(x=FLOOR_SIZE, y=FLOOR_SIZE, z=0.001)
        marker.pose.position.z -= 0.001
        marker.color.a = 0.15
        return marker
    marker.scale = Vector3(x=1.0, y=1.0, z=1.0)
    corners = surface.triangles or _fan(len(surface.vertices))
    marker.points = [surface.vertices[i] for i in corners if i < len(surface.vertices)]
    return marker


def contact_markers(contacts: Sequence[msg.Contact]) -> list[Marker]:
    """Return the contacts of a physics step: where, and which way they push; they fade soon."""
    found = []
    for number, contact in enumerate(contacts):
        at, normal = contact.point, contact.normal
        push = _marker(WORLD, "contacts", Marker.ARROW, ORANGE, number)
        push.scale = _vector(ARROW)
        push.points = [
            at,
            Point(
                x=at.x + ARROW_LENGTH * normal.x,
                y=at.y + ARROW_LENGTH * normal.y,
                z=at.z + ARROW_LENGTH * normal.z,
            ),
        ]
        push.lifetime = Duration(nanosec=CONTACT_NS)
        found.append(push)
    return found


def collision_marker(robot: str, message: msg.Collision) -> Marker | None:
    """Return where a robot collides; None where it is clear."""
    if not message.colliding:
        return None
    marker = _marker(WORLD, f"{robot}/collision", Marker.SPHERE, RED)
    marker.pose.position = message.contact.point
    marker.scale = _vector((2 * POINT_SIZE,) * 3)
    return marker


def path_marker(robot: str, base: str, points: Array) -> Marker:
    """Return the path of a robot's tool: points (N, 3) m in its base's frame."""
    marker = _marker(base, f"{robot}/path", Marker.LINE_STRIP, BLUE)
    marker.scale.x = LINE_WIDTH
    marker.points = [Point(x=x, y=y, z=z) for x, y, z in np.asarray(points).tolist()]
    return marker


def target_markers(robot: str, message: msg.GraspTargets) -> list[Marker]:
    """Return where the loaded trajectory closes (green) and opens (orange) the gripper."""
    found = []
    for number, target in enumerate(message.targets):
        colour = GREEN if target.close else ORANGE
        marker = _marker(
            message.header.frame_id, f"{robot}/targets", Marker.SPHERE, colour, number
        )
        marker.pose = target.tool0
        marker.scale = _vector((POINT_SIZE,) * 3)
        found.append(marker)
    return found


def state_marker(robot: str, base: str, text: str, height: float) -> Marker:
    """Return a text over a robot, `height` m above its base."""
    marker = _marker(base, f"{robot}/state", Marker.TEXT_VIEW_FACING, WHITE)
    marker.text = text
    marker.scale.z = TEXT_HEIGHT
    marker.pose.position.z = height
    return marker


def grasp_marker(robot: str, message: msg.Grasp) -> Marker | None:
    """Return what a gripper holds as a text at its tool; None where it holds nothing."""
    if message.state != msg.Grasp.HOLDING:
        return None
    tool = frame_name(robot, "tool0")
    marker = _marker(tool, f"{robot}/grasp", Marker.TEXT_VIEW_FACING, GREEN)
    marker.text = f"holds {message.object}"
    marker.scale.z = TEXT_HEIGHT / 2
    marker.pose.position.z = -TEXT_ABOVE
    return marker


def _marker(frame: str, namespace: str, kind: int, colour: Colour, number: int = 0) -> Marker:
    r, g, b, a = colour
    return Marker(
        header=make_header(0, frame),
        ns=namespace,
        id=number,
        type=kind,
        action=Marker.ADD,
        frame_locked=True,
        color=ColorRGBA(r=r, g=g, b=b, a=a),
        pose=PoseMessage(orientation=Quaternion(w=1.0)),
    )


def _colour_of(colour: ColorRGBA) -> Colour:
    return colour.r, colour.g, colour.b, colour.a


def _vector(values: Sequence[float]) -> Vector3:
    x, y, z = values
    return Vector3(x=x, y=y, z=z)


def _fan(count: int) -> list[int]:
    """Return the corners of the triangles of a convex outline."""
    return [corner for i in range(1, count - 1) for corner in (0, i, i + 1)]
