"""Trajectories, candidates and diagnostics as messages and back."""

from __future__ import annotations

import array
import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np
from mrlab_msgs import msg, srv
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, of_record
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.conversion.candidates import Candidate, Preview
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.trajectory.document import Frames, warnings_of
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages.texts import values_to_message
from mrlab_ros.messages.time import time_from_message, time_to_message


def diagnostic_to_message(diagnostic: Diagnostic) -> msg.Diagnostic:
    return msg.Diagnostic(
        severity=int(diagnostic.severity),
        code=diagnostic.code,
        message=diagnostic.message,
        remedy=diagnostic.remedy,
        variable=diagnostic.variable,
        where=diagnostic.where,
        first_row=diagnostic.first_row,
        last_row=diagnostic.last_row,
        joint=diagnostic.joint,
        value=_number(diagnostic.value),
        limit=_number(diagnostic.limit),
        unit=diagnostic.unit,
        values=values_to_message(diagnostic.values),
        fixes=[msg.Fix(**vars(fix)) for fix in diagnostic.fixes],
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def diagnostic_from_message(message: msg.Diagnostic) -> Diagnostic:
    return of_record(message)


def info_to_message(trajectory: Trajectory) -> msg.TrajectoryInfo:
    return msg.TrajectoryInfo(
        id=trajectory.id,
        robot_model=trajectory.robot_model,
        end_effector=trajectory.end_effector or "",
        source_file=trajectory.source.file,
        source_variable=trajectory.source.variable,
        source_sha256=trajectory.source.sha256,
        created=time_to_message(trajectory.created_ns),
        frame_rate=trajectory.frame_rate,
        frame_count=trajectory.frame_count,
        duration=trajectory.duration,
        has_gripper=trajectory.gripper is not None,
        owner=trajectory.owner,
        version=trajectory.version,
        shared=trajectory.shared,
        warnings=[diagnostic_to_message(d) for d in trajectory.warnings],
    )


def catalogue_to_message(infos: list[msg.TrajectoryInfo], total: int) -> msg.TrajectoryCatalogue:
    return msg.TrajectoryCatalogue(trajectories=infos, total=total)


def _array(kind: str, values: NDArray[Any] | None) -> array.array[Any]:
    """Return the values, row by row, as rclpy takes them without a Python object for each."""
    content = array.array(kind)
    if values is not None:
        rows = np.ascontiguousarray(values, dtype=np.dtype(kind))
        content.frombytes(rows.reshape(-1).view(np.uint8).data)
    return content


def trajectory_to_message(
    trajectory: Trajectory, begin: int = 0, count: int = 0
) -> msg.Trajectory:
    """Return the message with `count` frames from `begin` on; count 0: all from there on."""
    part = slice(begin, begin + count if count else None)
    gripper, channels = trajectory.gripper, trajectory.channels
    return msg.Trajectory(
        info=info_to_message(trajectory),
        joint_names=list(trajectory.joint_names),
        positions=_array("d", trajectory.positions[part]),
        velocities=_array("d", channels.velocities[part]),
        effort_proxy=_array("d", channels.effort_proxy[part]),
        gripper=_array("B", None if gripper is None else gripper[part]),
    )


def frames_to_message(frames: Frames) -> msg.Trajectory:
    """Return the message with these frames of a stored trajectory."""
    return msg.Trajectory(
        info=info_from_head(frames.head),
        joint_names=list(frames.head["joint_names"]),
        positions=_array("d", frames.positions),
        velocities=_array("d", frames.velocities),
        effort_proxy=_array("d", frames.effort_proxy),
        gripper=_array("B", frames.gripper),
    )


def trajectory_from_message(message: msg.Trajectory) -> Trajectory:
    """Return the trajectory that the message carries; raise BadInput where it is none."""
    info, names = message.info, tuple(message.joint_names)

    def matrix(values: array.array[float]) -> Array:
        flat: NDArray[np.float64] = np.array(values, dtype=np.float64)
        return flat.reshape(-1, len(names)) if names and flat.size % len(names) == 0 else flat

    positions = matrix(message.positions)
    return Trajectory(
        id=info.id,
        robot_model=info.robot_model,
        end_effector=info.end_effector or None,
        joint_names=names,
        frame_rate=info.frame_rate,
        positions=positions,
        gripper=np.array(message.gripper, dtype=np.bool_) if info.has_gripper else None,
        channels=Channels(matrix(message.velocities), matrix(message.effort_proxy)),
        source=Source(info.source_file, info.source_variable, info.source_sha256),
        created_ns=time_from_message(info.created),
        warnings=tuple(diagnostic_from_message(d) for d in info.warnings),
        owner=info.owner,
        version=info.version,
        shared=info.shared,
    )


def candidate_to_message(candidate: Candidate) -> msg.Candidate:
    rows, columns = candidate.shape
    return msg.Candidate(
        variable=candidate.path,
        rows=rows,
        columns=columns,
        minimum=candidate.minimum,
        maximum=candidate.maximum,
        score=candidate.score,
        reasons=[diagnostic_to_message(each) for each in candidate.reasons],
        preview=preview_to_message(candidate.preview),
    )


def preview_to_message(preview: Preview) -> msg.Preview:
    return msg.Preview(
        variable=preview.variable,
        rows=array.array("I", preview.rows.astype(np.uint32).tobytes()),
        columns=preview.values.shape[1],
        values=array.array("f", np.ascontiguousarray(preview.values, np.float32).tobytes()),
    )


def options_from_request(request: srv.ConvertTrajectory.Request) -> Options:
    """Return what a request of ConvertTrajectory asks for."""
    return Options(**{field.name: getattr(request, field.name) for field in fields(Options)})


def info_from_head(head: Mapping[str, Any]) -> msg.TrajectoryInfo:
    """Return the catalogue's entry from the metadata of a trajectory file or of the store."""
    return msg.TrajectoryInfo(
        id=head["id"],
        robot_model=head["robot_model"],
        end_effector=head["end_effector"] or "",
        source_file=head["source"]["file"],
        source_variable=head["source"]["variable"],
        source_sha256=head["source"]["sha256"],
        created=time_to_message(head["created_ns"]),
        frame_rate=float(head["frame_rate"]),
        frame_count=head["frame_count"],
        duration=(head["frame_count"] - 1) / head["frame_rate"],
        has_gripper=head["has_gripper"],
        owner=head.get("owner", ""),
        version=head.get("version", 1),
        shared=head.get("shared", True),
        warnings=[diagnostic_to_message(d) for d in warnings_of(head)],
    )


def trajectory_without_frames(head: Mapping[str, Any]) -> msg.Trajectory:
    """Return the message of a trajectory's head alone: info and joint names, no frames."""
    return msg.Trajectory(info=info_from_head(head), joint_names=list(head["joint_names"]))


def preview_from_message(message: msg.Preview) -> Preview:
    values: NDArray[np.float32] = np.array(message.values, np.float32)
    rows: NDArray[np.uint32] = np.array(message.rows, np.uint32)
    return Preview(message.variable, rows, values.reshape(len(rows), -1))


def candidate_from_message(message: msg.Candidate) -> Candidate:
    return Candidate(
        message.variable,
        (message.rows, message.columns),
        message.score,
        tuple(map(diagnostic_from_message, message.reasons)),
        message.minimum,
        message.maximum,
        preview_from_message(message.preview),
    )


def result_from_response(file: str, response: srv.ConvertTrajectory.Response) -> ConversionResult:
    """Return what a response of ConvertTrajectory says of a file that was not taken."""
    return ConversionResult(
        file,
        Outcome(response.outcome),
        None,
        tuple(map(candidate_from_message, response.candidates)),
        tuple(map(diagnostic_from_message, response.diagnostics)),
        preview_from_message(response.preview) if response.preview.variable else None,
    )
