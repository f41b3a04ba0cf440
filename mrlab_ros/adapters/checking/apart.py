"""Looks for the smallest wait that keeps two robots of a rehearsal apart."""

from __future__ import annotations

from collections.abc import Callable

from mrlab_ros.adapters.checking.stage import Stage
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.pairs import smallest_delay
from mrlab_ros.core.checking.rehearsed import Course
from mrlab_ros.core.physics.engine import Kind

STEP = 0.1  # s, between two delays that are tried, and between the poses that are compared
MARGIN = 0.02  # m, beside what is allowed: the poses between two samples are not compared


def smallest_waits(
    stage: Stage,
    robots: tuple[CheckedRobot, CheckedRobot],
    courses: tuple[Course, Course],
    closest: float,
) -> list[tuple[int, float]]:
    """Return which of two robots waits (0 or 1) and how long, s; the shortest wait first.

    What they hold is not looked at: a rehearsal with the wait has the last word.
    """
    ways = tuple(
        _sampled(course, len(r.model.joints)) for r, course in zip(robots, courses, strict=True)
    )
    with stage.arms(robots) as engine:

        def clear(first: int, second: int) -> bool:
            for robot, way, at in zip(robots, ways, (first, second), strict=True):
                engine.move_arm(robot.name, way[at], [0.0] * len(way[at]))
            limit = closest + MARGIN
            return engine.nearest(robots[0].name, Kind.ROBOT, robots[1].name, limit) is None

        def swapped(function: Callable[[int, int], bool]) -> Callable[[int, int], bool]:
            return lambda i, j: function(j, i)

        found = []
        for waiting, asked in ((1, clear), (0, swapped(clear))):
            moves, waits = len(ways[1 - waiting]), len(ways[waiting])
            delay = smallest_delay(moves, waits, asked, moves)
            if delay is not None:
                found.append((waiting, delay * STEP))
    return sorted(found, key=lambda each: each[1])


def _sampled(course: Course, joints: int) -> list[list[float]]:
    """Return the joint positions of a course every STEP s."""
    samples, next_time = [], 0.0
    for time, values in zip(course.times, course.values, strict=True):
        if time >= next_time - 1e-9:
            samples.append(values[:joints])
            next_time += STEP
    return samples or [course.values[0][:joints]]
