"""Writes motions for Rerun's viewer, where its SDK is installed: it is no part of the lab."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW, RERUN_MISSING
from mrlab_ros.adapters.robots import exporting
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.recorded_motion import (
    RecordedMotion,
    RecordedObject,
    RecordedRobot,
    Track,
)
from mrlab_ros.core.robots.frames import WORLD
from mrlab_ros.core.trajectory.trajectory import Trajectory

STANDING = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
SPHERE, CYLINDER = 2, 3  # of shape_msgs/SolidPrimitive


def sdk() -> Any:
    """Return Rerun's SDK; raise Misuse where it is not installed."""
    try:
        return import_module("rerun")
    except ImportError as error:
        raise Misuse(RERUN_MISSING(problem=str(error))) from None


def motion_of(trajectory: Trajectory) -> RecordedMotion:
    """Return a motion as a robot at the origin of the world makes it."""
    times = np.arange(trajectory.frame_count) / trajectory.frame_rate
    robot = RecordedRobot(
        model=trajectory.robot_model,
        end_effector=trajectory.end_effector or "",
        joints=list(trajectory.joint_names),
        track=Track(times.tolist(), trajectory.positions.tolist()),
        base=Track([0.0], [STANDING]),
    )
    return RecordedMotion({trajectory.robot_model: robot})


def plain(motion: RecordedMotion) -> dict[str, Any]:
    """Return a motion as JSON has it."""
    return asdict(motion)


def of_plain(found: Mapping[str, Any]) -> RecordedMotion:
    """Return the motion that plain() returned."""

    def tracks(each: Mapping[str, Any], *names: str) -> dict[str, Any]:
        return {**each, **{name: Track(**each[name]) for name in names}}

    robots = {k: RecordedRobot(**tracks(v, "track", "base")) for k, v in found["robots"].items()}
    things = {k: RecordedObject(**tracks(v, "track")) for k, v in found["objects"].items()}
    return RecordedMotion(robots, things)


def write(motion: RecordedMotion, library: RobotLibrary, path: Path) -> None:
    """Write robots, their joints and objects over the time in s into an .rrd file.

    Robots look as in the library: BadInput for a model that it does not have, and where nothing
    moves. Raises Misuse without Rerun's SDK.
    """
    rerun = sdk()
    blueprint, urdf = import_module("rerun.blueprint"), import_module("rerun.urdf")
    moved = {name: robot for name, robot in motion.robots.items() if robot.track.times}
    if not moved:
        raise BadInput(NOTHING_TO_SHOW(why=of_text("no robot has joint states")))
    into = rerun.RecordingStream("mrlab")
    into.save(str(path))
    seen = ["+ /**"]
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        for name, robot in moved.items():
            made = exporting.export(
                library, robot.model, robot.end_effector or None, Path(folder, name)
            )
            body = urdf.UrdfTree.from_file_path(
                made, entity_path_prefix=name, frame_prefix=f"{name}/"
            )
            body.log_urdf_to_recording(into)
            seen.append(f"- /{name}/{body.name}/collision_geometries/**")
            base = f"{name}/{body.root_link().name}"
            _place(rerun, into, f"{name}/base", robot.base, base)
            values = np.array(robot.track.values)
            when = [rerun.TimeColumn("time", duration=robot.track.times)]
            for joint, course in zip(robot.joints, values.T, strict=True):
                curve = rerun.Scalars.columns(scalars=course)
                rerun.send_columns(f"{name}/joints/{joint}", when, curve, recording=into)
                known = body.get_joint_by_name(joint)
                if known is not None:
                    poses = known.compute_transform_columns(course)
                    rerun.send_columns(f"{name}/poses/{joint}", when, poses, recording=into)
        for name, thing in motion.objects.items():
            frame = f"objects/{name}"
            _place(rerun, into, f"{frame}/pose", thing.track, frame)
            into.log(frame, _shape(rerun, thing.shape), static=True)
            into.log(frame, rerun.CoordinateFrame(frame), static=True)
        into.send_blueprint(
            blueprint.Blueprint(
                blueprint.Horizontal(
                    blueprint.Spatial3DView(
                        origin="/",
                        name="Robots",
                        contents=seen,
                        spatial_information=blueprint.SpatialInformation(target_frame=WORLD),
                    ),
                    blueprint.TimeSeriesView(
                        origin="/",
                        name="Joints, rad or m",
                        contents=[f"+ /{name}/joints/**" for name in moved],
                    ),
                    column_shares=[3, 2],
                )
            )
        )
        into.flush()


def _place(rerun: Any, into: Any, entity: str, track: Track, frame: str) -> None:
    """Say where a frame stands in the world over time."""
    times, values = track.times or [0.0], np.array(track.values or [STANDING])
    rerun.send_columns(
        entity,
        [rerun.TimeColumn("time", duration=times)],
        rerun.Transform3D.columns(
            translation=values[:, :3],
            quaternion=values[:, 3:],
            parent_frame=[WORLD] * len(times),
            child_frame=[frame] * len(times),
        ),
        recording=into,
    )


def _shape(rerun: Any, shape: Mapping[str, Any]) -> Any:
    """Return an object's primitive, or the box that it fills."""
    colour = [tuple(shape["color"][c] for c in "rgba")]
    kind, sides = shape["primitive"]["type"], shape["primitive"]["dimensions"]
    if kind == SPHERE:
        return rerun.Ellipsoids3D(radii=[sides[0]], colors=colour, fill_mode="solid")
    if kind == CYLINDER:
        return rerun.Cylinders3D(
            lengths=[sides[0]], radii=[sides[1]], colors=colour, fill_mode="solid"
        )
    size = [shape["size"][axis] for axis in "xyz"]
    return rerun.Boxes3D(sizes=[size], colors=colour, fill_mode="solid")
