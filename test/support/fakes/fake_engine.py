"""An engine without physics for tests of the world: arms are points that touch spheres."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mrlab_ros.core.base.geometry import Pose, Vector
from mrlab_ros.core.physics.engine import (
    Arm,
    Body,
    BodyState,
    Finger,
    FingerState,
    Hit,
    Kind,
    LinkPairs,
    Near,
    Touch,
)

FINGERS = (
    Finger("left_joint", "left", 0.0, 0.04, 0.08, 20.0),
    Finger("right_joint", "right", 0.0, 0.04, 0.08, 20.0),
)


class FakeEngine:
    """An arm's only moving link, `tip`, is at (q0, q1, 0.5) beside its base; objects are spheres
    of RADIUS that stay where they are put. Fingers run freely up to `block`.
    """

    RADIUS = 0.05

    def __init__(self, *, fingers: bool = False) -> None:
        self.fitted = FINGERS if fingers else ()
        self.calls: list[str] = []
        self.time = 0.0
        self.arms: dict[str, dict] = {}
        self.motions: dict[str, BodyState] = {}
        self.surfaces: dict[str, float] = {}
        self.held: dict[str, tuple[str, Vector]] = {}
        self.block = 0.04
        self.pinched = ""

    def add_arm(
        self, name: str, urdf: str, joints: tuple[str, ...], pose: Pose, apart: LinkPairs
    ) -> Arm:
        count = len(self.fitted)
        self.arms[name] = {
            "pose": pose, "q": (0.0, 0.0), "v": (0.0, 0.0),
            "fingers": [0.0] * count, "drive": [0.0] * count,
        }  # fmt: skip
        links = frozenset(f.link for f in self.fitted)
        return Arm(
            self.fitted,
            "tip",
            links | {"tip"},
            frozenset({"base"}),
            (1.0,) * len(joints),
            "tip",
            links | {"tip"},
            100.0,
        )

    def place_arm(self, name: str, pose: Pose) -> None:
        self.arms[name]["pose"] = pose

    def remove_arm(self, name: str) -> None:
        del self.arms[name]

    def move_arm(
        self,
        name: str,
        positions: Sequence[float],
        velocities: Sequence[float],
        *,
        jumped: bool = False,
    ) -> None:
        self.arms[name].update(q=positions, v=velocities)
        self.calls.append("move")

    def speed(self, name: str) -> float:
        return float(np.linalg.norm(self.arms[name]["v"]))

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        self.arms[name]["drive"] = list(velocities)

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        self.arms[name]["fingers"] = list(positions)

    def settle(self, name: str, thing: str) -> None: ...

    def fingers(self, name: str) -> tuple[FingerState, ...]:
        return tuple(FingerState(p, 1.0) for p in self.arms[name]["fingers"])

    def link(self, arm: str, link: str) -> BodyState:
        a = self.arms[arm]
        x, y, z = a["pose"].position
        q, v = a["q"], a["v"]
        place = (x + float(q[0]), y + float(q[1]), z + 0.5)
        return BodyState(Pose(place), (float(v[0]), float(v[1]), 0.0))

    def _gap(self, arm: str, other: str) -> float:
        a, b = self.link(arm, "tip").pose.position, self.object(other).pose.position
        return float(np.linalg.norm(np.subtract(a, b))) - self.RADIUS

    def _holds(self, arm: str, name: str) -> bool:
        return name in self.held and self.held[name][0] == arm

    def touches(self, name: str) -> list[Touch]:
        tip = self.link(name, "tip").pose.position
        found = [
            Touch(
                "tip", Kind.OBJECT, o, "", tip, (1.0, 0.0, 0.0), -self._gap(name, o), 0.1, "", 1.0
            )
            for o in self.motions
            if self._gap(name, o) <= 0 and o != self.pinched and not self._holds(name, o)
        ]
        found += [
            Touch("tip", Kind.SURFACE, s, "", tip, (1.0, 0.0, 0.0), tip[0] - x, 0.1)
            for s, x in self.surfaces.items()
            if tip[0] >= x
        ]
        pinched = self.pinched and not self._holds(name, self.pinched)
        if pinched and self.arms[name]["fingers"] == [self.block] * len(self.fitted):
            for finger, side in zip(self.fitted, (1.0, -1.0), strict=True):
                found.append(
                    Touch(
                        finger.link, Kind.OBJECT, self.pinched, "", tip, (0, side, 0), 0, 0.1, "",
                        1.0,
                    )
                )  # fmt: skip
        return found

    def distance(self, arm: str, kind: Kind, other: str, limit: float) -> float:
        if kind is Kind.SURFACE and other in self.surfaces:
            return min(self.surfaces[other] - self.link(arm, "tip").pose.position[0], limit)
        if kind is Kind.OBJECT and other in self.motions:
            return min(self._gap(arm, other), limit)
        return limit

    def nearest(
        self,
        arm: str,
        kind: Kind,
        other: str,
        limit: float,
        without: frozenset[str] = frozenset(),
    ) -> Near | None:
        distance = self.distance(arm, kind, other, limit)
        return Near(distance, "tip") if distance < limit else None

    def add_object(self, name: str, body: Body, motion: BodyState) -> None:
        self.motions[name] = motion

    def remove_object(self, name: str) -> None:
        del self.motions[name]

    def object(self, name: str) -> BodyState:
        if name in self.held:
            arm, offset = self.held[name]
            hand = self.link(arm, "tip")
            place = tuple(float(v) for v in np.add(hand.pose.position, offset))
            return BodyState(Pose(place), hand.linear)  # type: ignore[arg-type]
        return self.motions[name]

    def objects(self) -> dict[str, BodyState]:
        return {name: self.object(name) for name in self.motions}

    def set_object(self, name: str, motion: BodyState) -> None:
        self.motions[name] = motion

    def add_surface(self, name: str, body: Body, pose: Pose) -> None:
        # A wall across x at the pose; the floor is nowhere near.
        if name != "floor":
            self.surfaces[name] = pose.position[0]

    def remove_surface(self, name: str) -> None:
        self.surfaces.pop(name, None)

    def hold(self, arm: str, link: str, name: str, mass: float) -> None:
        offset = np.subtract(self.object(name).pose.position, self.link(arm, "tip").pose.position)
        self.held[name] = (arm, tuple(offset))

    def slide(self, name: str, way: Vector) -> None:
        arm, offset = self.held[name]
        self.held[name] = (arm, tuple(np.add(offset, way)))

    def rays(
        self, name: str, starts: Sequence[Vector], ends: Sequence[Vector]
    ) -> list[Hit | None]:
        return [Hit(0.5, (0.0, 0.0, -1.0)) for _ in starts]

    def release(self, name: str) -> None:
        self.motions[name] = self.object(name)
        del self.held[name]

    def squeezed(self, arm: str, name: str, normal: Vector) -> Vector:
        return (0.0, 0.0, 0.0)

    def let_pass(self, arm: str, name: str, passes: bool) -> None:
        self.calls.append(f"let_pass {arm} {name} {passes}")

    def below(self, point: Vector) -> float | None:
        return 0.0

    def overlapping(self, low: Vector, high: Vector) -> set[str]:
        return {
            name
            for name in self.motions
            if all(
                a - self.RADIUS < p < b + self.RADIUS
                for a, p, b in zip(low, self.object(name).pose.position, high, strict=True)
            )
        }

    def step(self, duration: float) -> None:
        self.calls.append("step")
        self.time += duration
        for arm in self.arms.values():
            arm["fingers"] = [
                min(max(p + v * duration, 0.0), self.block)
                for p, v in zip(arm["fingers"], arm["drive"], strict=True)
            ]

    def close(self) -> None:
        self.calls.append("close")
