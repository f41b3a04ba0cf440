"""What the name of a variable says about being joint positions; a name alone never decides.

The words were collected from workspaces in public repositories.
"""

from __future__ import annotations

import re
from enum import Enum


class Hint(Enum):
    """What a name says; the value is a person's words for it."""

    POSITIONS = "its name is one that joint positions have"
    NEUTRAL = "its name says nothing"
    DOUBTFUL = "its name is often given to something else than joint positions"
    AGAINST = "its name says that it is something else than joint positions"


def words(text: str) -> frozenset[str]:
    return frozenset(text.lower().split())


POSITIONS = words(
    "q qmatrix qmat qcombined qtraj qraw qfilt qfilter qds qlist qj qc qt qpath qs qhistory "
    "qactual qact qtarget qdes qref qmeas qsim qout qall qall qinterp qsol qik "
    "traj trajectory trajectories jointtraj jointtrajectory jointangles jointangle joints "
    "jointpositions jointposition jointpos angleexport angles jointvalues theta thetas thetalist "
    "thetares thl thr refjoint pointrecord configs robotconfigs configurations"
)
DOUBTFUL = words("qd qobs qerr qerror qerrors u v")
AGAINST = words(
    "tau torque torques i f force forces wrench ft pose poses xd xdd xe kp kd ki k j jac jacobian "
    "m dh g time tout qlim limits cpol vel velocity velocities acc accel acceleration "
    "accelerations speed jerk current currents error errors inertia gravity gains gain mask cov"
)
AGAINST_PREFIXES = ("qdd", "dq", "ddq", "dtheta", "ddtheta", "tcp", "toolvector", "tau", "torque")
AGAINST_PARTS = words(
    "torque torques force forces vel velocity velocities speed acc accel acceleration jerk "
    "error tau current tcp pose dot ddot d1 d2 d3 d4 limit limits inertia gains cartesian"
)
POSITION_PARTS = words(
    "q theta thetas joint joints traj trajectory angle angles configs waypoints pos position "
    "positions"
)
# fields that only say "the values are in here"
CONTAINER_TAIL = re.compile(r"(\.(signals|values|data|Data|Values|q_?data)(\(\d+\))?)+$")


def leaf(path: str) -> str:
    """Return the name that speaks for `path`: `out.q` of `out.q.signals(1).values`."""
    inner = CONTAINER_TAIL.sub("", path)
    return re.split(r"[.{(]", inner if inner else path)[-1] if "." in inner else inner


def parts(name: str) -> list[str]:
    """Return the lower-case words of a name: joint_Angles2 is joint, angles, 2."""
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name)
    spaced = re.sub(r"(?<=[A-Za-z]{2})(?=\d)", "_", spaced)
    return [p for p in re.split(r"[^A-Za-z0-9]+", spaced.lower()) if p]


def hint(path: str) -> Hint:
    """Return what the name of the variable at `path` says."""
    name = re.sub(r"[({][^.]*$", "", leaf(path))
    said = parts(name)
    whole = "".join(said)
    bare = whole.rstrip("0123456789")
    if bare in DOUBTFUL or said[:1] == ["qd"]:
        return Hint.DOUBTFUL
    if bare in POSITIONS:
        return Hint.POSITIONS
    if (
        bare in AGAINST
        or whole.startswith(AGAINST_PREFIXES)
        or whole.endswith("dot")
        or whole == "t"
        or (said[:1] == ["i"] and len(said) > 1)
        or AGAINST_PARTS.intersection(said)
    ):
        return Hint.AGAINST
    if POSITION_PARTS.intersection(said):
        return Hint.POSITIONS
    return Hint.NEUTRAL
