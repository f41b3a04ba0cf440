"""Scrubbing: object states are recorded along a run, and a seek back restores them."""

from __future__ import annotations

from collections.abc import Mapping

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Pose, pose_between
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.states import Grasp, GraspEvent
from mrlab_ros.core.physics.grippers import Grippers
from mrlab_ros.core.physics.simulated_robot import Playing, Robot
from mrlab_ros.core.physics.snapshots import (
    GripperSnapshot,
    HeldSnapshot,
    ObjectSnapshot,
    Snapshot,
)
from mrlab_ros.core.physics.world_state import WorldState
from mrlab_ros.core.playback.states import State

# Restoring a snapshot waits this long for the jump of the arm, ns.
RESTORE_WAIT_NS = SECOND // 10
# An object that is this close to where it was, m, and turned by as little, stays as it is: setting
# its pose would wake it.
IN_PLACE = 1e-4


class Rewind:
    """Records and restores the objects along the runs of all robots."""

    def __init__(self, state: WorldState, grippers: Grippers) -> None:
        self._world_state = state
        self._engine = state.engine
        self._grippers = grippers

    def follow(self, robot: Robot, before: Playing) -> None:
        """React to a seek or a new start of the robot's playback; `before`: its previous state."""
        playing = robot.playing
        if playing.trajectory_id != before.trajectory_id:
            robot.snapshots.clear()
            return
        sought = before.sought(playing)
        if sought:
            snapshot = robot.snapshots.at(playing.clock.position)
            if snapshot is not None:
                robot.pending = (self._world_state.now_ns + RESTORE_WAIT_NS, snapshot)
        if playing.state is State.PLAYING and (sought or before.state is not State.PLAYING):
            robot.snapshots.cut(playing.clock.position)

    def record(self, now_ns: int, motions: Mapping[str, BodyState]) -> None:
        """Record a snapshot of the objects for every robot whose run is due for one.

        motions: of all movable objects. The robots share the snapshot.
        """
        kept: dict[str, ObjectSnapshot] = {}
        for robot in self._world_state.robots.values():
            playing = robot.playing
            goes_on = playing.state is State.PLAYING and playing.clock.rate > 0
            if not goes_on or robot.pending is not None:
                continue
            position = playing.position(robot.stream.shown_ns(now_ns))
            if robot.snapshots.wants(position):
                kept = kept or self._kept(motions)
                robot.snapshots.add(Snapshot(position, kept, _gripper(robot, now_ns)))

    def _kept(self, motions: Mapping[str, BodyState]) -> dict[str, ObjectSnapshot]:
        kept = {}
        for name, motion in motions.items():
            held_by = self._world_state.objects[name].held_by
            holder = self._world_state.robots.get(held_by)
            holding = holder.holding if holder is not None else None
            if holder is None or holding is None:
                kept[name] = ObjectSnapshot(motion, held_by)
            else:
                fingers = tuple(state.position for state in self._engine.fingers(held_by))
                for_ns = self._world_state.now_ns - holder.held_since_ns
                held = HeldSnapshot(holding.in_hand, holding.grip, fingers, for_ns)
                kept[name] = ObjectSnapshot(motion, held_by, held)
        return kept

    def retrace(self, robot: Robot, now_ns: int) -> None:
        """Take the objects back along the run of a playback that goes backwards.

        Between two snapshots a free object goes straight; what the robot held is in its hand.
        """
        playing = robot.playing
        back = playing.state is State.PLAYING and playing.clock.rate < 0
        if not back or robot.pending is not None:
            return
        around = robot.snapshots.around(playing.position(robot.stream.shown_ns(now_ns)))
        if around is None:
            return
        before, after, share = around
        if robot.held and robot.held not in before.held_by(robot.name):
            self._grippers.lose(robot)
        for name, kept in before.objects.items():
            thing = self._world_state.objects.get(name)
            if thing is None or thing.held_by not in ("", robot.name) or thing.hand is not None:
                continue
            if kept.held_by == robot.name and kept.held is not None:
                if robot.held != name:
                    self._grippers.put_in_hand(robot, thing, kept.held)
            elif not kept.held_by and not thing.held_by:
                then = after.objects.get(name)
                pose = kept.motion.pose
                if then is not None and not then.held_by:
                    pose = pose_between(pose, then.motion.pose, share)
                if not _same(self._engine.object(name).pose, pose):
                    self._engine.set_object(name, BodyState(pose))

    def restore(self, robot: Robot, now_ns: int) -> None:
        """Restore the objects as they were when the run passed the position of the seek."""
        if robot.pending is None or now_ns < robot.pending[0]:
            return
        snapshot, robot.pending, robot.still_grips = robot.pending[1], None, None
        if robot.held and robot.held not in snapshot.held_by(robot.name):
            self._grippers.let_go(robot)
            robot.fire(GraspEvent.LOST)
        for name, kept in snapshot.objects.items():
            thing = self._world_state.objects.get(name)
            if thing is None or thing.held_by not in ("", robot.name):
                continue
            holder = self._world_state.robots.get(kept.held_by)
            if holder is None or kept.held is None:
                if not kept.held_by and not thing.held_by:
                    self._engine.set_object(name, kept.motion)
            elif holder is robot or (holder.closed and not holder.held):
                # In a seek of a whole system a robot gives back what it took from another one.
                self._grippers.put_in_hand(holder, thing, kept.held)
        robot.closed = snapshot.gripper.closed
        robot.takes_over = snapshot.gripper.takes_over
        if not robot.held:
            robot.fire(GraspEvent.OPEN)
            if robot.closed and self._grippers.command(robot, True):
                robot.closing_since_ns = now_ns - snapshot.gripper.for_ns
                robot.lost = snapshot.gripper.lost
                if snapshot.gripper.grasp is Grasp.EMPTY:
                    robot.fire(GraspEvent.SHUT)
            robot.watch.reset()
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self._grippers.announce(robot)


def _gripper(robot: Robot, now_ns: int) -> GripperSnapshot:
    takes_over = robot.takes_over and robot.grasp is Grasp.CLOSING
    for_ns = now_ns - robot.closing_since_ns
    return GripperSnapshot(robot.closed, for_ns, robot.grasp, takes_over, robot.lost)


def _same(a: Pose, b: Pose) -> bool:
    numbers = zip((*a.position, *a.orientation), (*b.position, *b.orientation), strict=True)
    return all(abs(x - y) <= IN_PLACE for x, y in numbers)
