"""Signals derived from joint positions: velocity and effort proxy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import Number, Numbers, above, at_least
from mrlab_ros.core.base.records import field
from mrlab_ros.core.trajectory.trajectory import Channels

Array = NDArray[np.float64]

GRAVITY = 9.80665  # m/s^2, the standard value
BLOCK_ROWS = 16_384
PLACE = "config/torque_proxy.yaml"


@dataclass(frozen=True)
class ProxyCoefficients:
    """Nominal coefficients, base joint first; a robot with more joints repeats the last one."""

    inertia: tuple[float, ...] = field(
        Numbers(None, at_least(0), "kg*m^2, one per joint"), "Inertia that the joint moves."
    )
    damping: tuple[float, ...] = field(
        Numbers(None, at_least(0), "N*m*s/rad, one per joint"), "Viscous friction of the joint."
    )
    mass: tuple[float, ...] = field(
        Numbers(None, at_least(0), "kg, one per joint"), "Mass that the joint lifts."
    )
    length: tuple[float, ...] = field(
        Numbers(None, at_least(0), "m, one per joint"), "Distance from the joint to that mass."
    )
    max_acceleration: float = field(
        Number(above(0), "rad/s^2"), "Largest acceleration that enters the proxy; more is clipped."
    )

    @classmethod
    def from_mapping(cls, values: Mapping[str, Any]) -> ProxyCoefficients:
        """Build from the content of the file; raise BadInput that names all mistakes."""
        return records.read(cls, values, PLACE)

    def of_joint(self, joint: int) -> tuple[float, float, float]:
        """Return inertia, damping and m*g*l, N*m, of the joint with this index."""
        inertia, damping, mass, length = (
            values[min(joint, len(values) - 1)]
            for values in (self.inertia, self.damping, self.mass, self.length)
        )
        return inertia, damping, mass * GRAVITY * length


def derivative(values: Array, rate: float) -> Array:
    """Return d/dt of `values`, (N, J) at `rate` Hz, lightly smoothed.

    Central differences inside, one-sided at both ends; then each inner sample becomes a quarter
    of its neighbours and half of itself, which takes out the difference's own noise. Straight
    lines stay exact; a sine of angular frequency w loses (w / rate)^2 * (1/6 + 1/4) of its
    derivative, relative.
    """
    found = np.empty_like(values)
    for begin, end in _blocks(len(values)):
        found[begin:end] = _rows_of_derivative(values, rate, begin, end)
    return found


def _blocks(rows: int) -> Iterator[tuple[int, int]]:
    """Yield begin and end of blocks whose temporary arrays stay in the processor's cache."""
    for begin in range(0, rows, BLOCK_ROWS):
        yield begin, min(begin + BLOCK_ROWS, rows)


def _rows_of_derivative(values: Array, rate: float, begin: int, end: int) -> Array:
    """Return the rows `begin` to `end` of derivative(values, rate), from two rows on each side."""
    first = max(begin - 2, 0)
    values = values[first : end + 2]
    raw = np.empty_like(values)
    np.subtract(values[2:], values[:-2], out=raw[1:-1])
    raw[1:-1] *= rate / 2
    raw[0] = (values[1] - values[0]) * rate
    raw[-1] = (values[-1] - values[-2]) * rate
    smooth = raw.copy()
    smooth[1:-1] *= 0.5
    raw *= 0.25
    smooth[1:-1] += raw[:-2]
    smooth[1:-1] += raw[2:]
    return smooth[begin - first : end - first]


def derive(positions: Array, frame_rate: float, coefficients: ProxyCoefficients) -> Channels:
    """Derive the channels of `positions`, (N, J) rad at `frame_rate` Hz, N >= 2.

    The effort proxy is inertia * qdd + damping * qd + mass * g * length * sin(q) of each joint
    alone: nominal, for display, not a torque. qdd is the derivative of the velocities, clipped
    to max_acceleration on both sides; nothing else uses it, so it is not kept.
    """
    velocities = derivative(positions, frame_rate)
    effort = np.empty_like(velocities)
    limit = coefficients.max_acceleration
    joints = positions.shape[1]
    inertia, damping, weight = np.array([coefficients.of_joint(j) for j in range(joints)]).T
    for begin, end in _blocks(len(positions)):
        acceleration = _rows_of_derivative(velocities, frame_rate, begin, end)
        np.clip(acceleration, -limit, limit, out=acceleration)
        part = effort[begin:end]
        np.sin(positions[begin:end], out=part)
        part *= weight
        acceleration *= inertia
        part += acceleration
        np.multiply(velocities[begin:end], damping, out=acceleration)
        part += acceleration
    return Channels(velocities, effort)
