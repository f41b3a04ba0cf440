"""The converter's answer, as it comes over zenoh, in core objects and as fields of JSON."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, of_record, plain
from mrlab_ros.core.conversion.preview import Preview

OUTCOMES = ("rejected", "accepted", "ambiguous")


def diagnostics_of(answer: Any) -> tuple[Diagnostic, ...]:
    """Return the findings of a response of ConvertTrajectory."""
    return tuple(of_record(each) for each in answer.diagnostics)


def preview_of(message: Any) -> Preview | None:
    """Return the rows of a message of Preview; None where it holds none."""
    columns = int(message.columns)
    if not columns or not len(message.rows):
        return None
    values = np.asarray(message.values, dtype=np.float32).reshape(-1, columns)
    return Preview(message.variable, np.asarray(message.rows, dtype=np.uint32), values)


def preview_fields(message: Any) -> dict[str, Any]:
    """Return the fields of answers.Preview."""
    return {
        "variable": message.variable,
        "rows": [int(row) for row in message.rows],
        "columns": int(message.columns),
        "values": [finite(value) for value in message.values],
    }


def candidate_fields(message: Any) -> dict[str, Any]:
    """Return the fields of answers.Candidate."""
    return {
        "variable": message.variable,
        "rows": int(message.rows),
        "columns": int(message.columns),
        "minimum": finite(message.minimum),
        "maximum": finite(message.maximum),
        "score": finite(message.score) or 0.0,
        "reasons": [plain(of_record(each)) for each in message.reasons],
        "preview": preview_fields(message.preview),
    }


def head_of(info: Any) -> dict[str, Any]:
    """Return the metadata of a trajectory from a message of TrajectoryInfo, its warnings left out.

    The findings of the whole answer hold the warnings too.
    """
    return {
        "id": info.id,
        "robot_model": info.robot_model,
        "end_effector": info.end_effector,
        "source": {
            "file": info.source_file,
            "variable": info.source_variable,
            "sha256": info.source_sha256,
        },
        "created_ns": int(info.created.sec) * 1_000_000_000 + int(info.created.nanosec),
        "frame_rate": float(info.frame_rate),
        "frame_count": int(info.frame_count),
        "has_gripper": bool(info.has_gripper),
        "warnings": [],
    }


def finite(value: Any) -> float | None:
    """Return a number, None where it is NaN or infinite."""
    number = float(value)
    return number if math.isfinite(number) else None


def said(answer: Any) -> Diagnostic:
    """Return what a response says; its values stay texts, as the wire has them."""
    values = {each.key: each.value for each in answer.values}
    return Diagnostic(answer.code, Severity.ERROR, answer.message, values=values)
