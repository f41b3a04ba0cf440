"""Objects along a timeline: what a run passed is kept, and a seek back to there restores it."""

from __future__ import annotations

from collections.abc import Mapping

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp import GraspEvent
from mrlab_ros.core.physics.grippers import Hands
from mrlab_ros.core.physics.simulated_robot import Playing, Robot
from mrlab_ros.core.physics.snapshots import ObjectSnapshot, Snapshot
from mrlab_ros.core.physics.world_state import Stage
from mrlab_ros.core.playback.states import State

# A restored snapshot waits this long for the arm's own jump, ns.
RESTORE_WAIT_NS = SECOND // 10


class Rewind:
    """Keeps and restores the objects of the stage for the runs of its robots."""

    def __init__(self, stage: Stage, hands: Hands) -> None:
        self._stage = stage
        self._engine = stage.engine
        self._hands = hands

    def follow(self, robot: Robot, before: Playing) -> None:
        """See whether the robot's playback, which was `before`, was sought or begins anew."""
        playing = robot.playing
        if playing.trajectory_id != before.trajectory_id:
            robot.snapshots.clear()
            return
        sought = before.sought(playing)
        if sought:
            snapshot = robot.snapshots.at(playing.clock.position)
            if snapshot is not None:
                robot.pending = (self._stage.now_ns + RESTORE_WAIT_NS, snapshot)
        if playing.state is State.PLAYING and (sought or before.state is not State.PLAYING):
            robot.snapshots.cut(playing.clock.position)

    def record(self, now_ns: int, motions: Mapping[str, BodyState]) -> None:
        """Keep what the objects are like for every robot whose run is due for it.

        motions: of all objects that can move. What is kept is shared by all these robots.
        """
        kept: dict[str, ObjectSnapshot] = {}
        for robot in self._stage.robots.values():
            if robot.playing.state is not State.PLAYING or robot.pending is not None:
                continue
            position = robot.playing.position(robot.stream.shown_ns(now_ns))
            if robot.snapshots.wants(position):
                kept = kept or self._kept(motions)
                robot.snapshots.add(Snapshot(position, kept, robot.closed))

    def _kept(self, motions: Mapping[str, BodyState]) -> dict[str, ObjectSnapshot]:
        kept = {}
        for name, motion in motions.items():
            held_by = self._stage.objects[name].held_by
            holder = self._stage.robots.get(held_by)
            kept[name] = ObjectSnapshot(motion, held_by, holder.in_hand if holder else None)
        return kept

    def restore(self, robot: Robot, now_ns: int) -> None:
        """Put the objects back to where they were when the run passed the sought place."""
        if robot.pending is None or now_ns < robot.pending[0]:
            return
        snapshot, robot.pending = robot.pending[1], None
        if robot.held and robot.held not in snapshot.held_by(robot.name):
            self._hands.let_go(robot)
            robot.fire(GraspEvent.LOST)
        for name, kept in snapshot.objects.items():
            thing = self._stage.objects.get(name)
            if thing is None or thing.held_by not in ("", robot.name):
                continue
            holder = self._stage.robots.get(kept.held_by)
            if holder is None or kept.in_hand is None:
                if not kept.held_by and not thing.held_by:
                    self._engine.set_object(name, kept.motion)
            elif holder is robot or (holder.closed and not holder.held):
                # Sought with others, a robot gives back what it took from one of them.
                self._hands.put_in_hand(holder, thing, kept.in_hand)
        robot.closed = snapshot.closed
        if not robot.held:
            robot.fire(GraspEvent.OPEN)
            if snapshot.closed:
                robot.fire(GraspEvent.CLOSE)
                robot.closing_since_ns = now_ns
            robot.watch.reset()
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self._hands.tell(robot)
