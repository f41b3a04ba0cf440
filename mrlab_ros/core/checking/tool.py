"""How near a motion comes to singularities, by the conditioning of the arm's Jacobian."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.checking.diagnostics import NEAR_SINGULARITY
from mrlab_ros.core.robots.model import KinematicChain

# 1/condition below this counts as nearly singular: a straight way of the tool there needs a joint
# that turns fifty times as fast as elsewhere.
NEARLY_SINGULAR = 0.02
# Frames that are looked at; of a longer motion every k-th.
MOST_FRAMES = 4000


@dataclass(frozen=True, eq=False)
class Dexterity:
    """times: (M,) s. conditioning: (M,) 1/condition number, 0 singular to 1. tool: (M, 3) m."""

    times: Array
    conditioning: Array
    tool: Array


def jacobian(chain: KinematicChain, positions: Array) -> Array:
    """Return the geometric Jacobian of the chain's tip in its base, (N, 6, J): m and rad.

    Its column of a turning joint is (z x (p - o), z), of a sliding one (z, 0) (Siciliano et al.,
    Robotics: Modelling, Planning and Control, 2009, section 3.1).
    """
    poses = chain.links(positions)
    tip = poses[chain.link_names[-1]][:, :3, 3]
    columns = []
    for segment in chain.segments:
        if segment.axis is None:
            continue
        pose = poses[segment.link]
        axis = pose[:, :3, :3] @ np.asarray(segment.axis)
        if segment.prismatic:
            columns.append(np.concatenate([axis, np.zeros_like(axis)], axis=1))
        else:
            arm = tip - pose[:, :3, 3]
            columns.append(np.concatenate([np.cross(axis, arm), axis], axis=1))
    return np.stack(columns, axis=2)


def conditioning(chain: KinematicChain, positions: Array, reach: float) -> Array:
    """Return 1/condition number of the Jacobian, (N,): 0 at a singularity, at most 1.

    Its ways are divided by `reach`, m, so that they compare with angles (Salisbury and Craig,
    Int. J. Robotics Research 1(1), 1982; Angeles, Fundamentals of Robotic Mechanical Systems,
    2014, section 5.8).
    """
    whole = jacobian(chain, positions)
    whole[:, :3] /= reach
    values = np.linalg.svd(whole, compute_uv=False)
    result: Array = values[:, -1] / np.maximum(values[:, 0], 1e-12)
    return result


def dexterity_of(
    chain: KinematicChain, positions: Array, frame_rate: float, reach: float
) -> Dexterity:
    """Return the conditioning along a motion; positions: (N, J) rad."""
    step = -(-len(positions) // MOST_FRAMES)
    kept = np.unique(np.append(np.arange(0, len(positions), step), len(positions) - 1))
    chosen = positions[kept]
    return Dexterity(
        kept / frame_rate,
        conditioning(chain, chosen, reach),
        chain.tool0(chosen)[:, :3, 3],
    )


def findings_of(dexterity: Dexterity, robot: str) -> list[Diagnostic]:
    """Return one finding for each part of the motion that is nearly singular."""
    below = np.concatenate(([False], dexterity.conditioning < NEARLY_SINGULAR, [False]))
    edges = np.flatnonzero(np.diff(below.astype(np.int8))).reshape(-1, 2)
    found = []
    for begin, end in edges:
        least = int(begin + dexterity.conditioning[begin:end].argmin())
        value = round(float(dexterity.conditioning[least]), 4)
        found.append(
            NEAR_SINGULARITY(
                robot=robot,
                time=float(dexterity.times[begin]),
                end=float(dexterity.times[end - 1]),
                value=value,
                limit=NEARLY_SINGULAR,
                unit="",
            )
        )
    return found
