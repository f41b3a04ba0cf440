"""The facts of `mrlab status`, ready for JSON: SI units, null where nothing is known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mrlab_ros.client.follow import Follower

# From where to where, in the order of LatencyHop's constants.
HOPS = (("published", "bridged"), ("bridged", "received"), ("published", "received"))


def robot_facts(robot: Any, follower: Follower) -> dict[str, Any]:
    state, position = follower.state, robot.pose.position
    known = follower.watch.value is not None
    moving = bool(follower.errors)
    return {
        "name": robot.name,
        "model": robot.model,
        "end_effector": robot.end_effector,
        "position": [position.x, position.y, position.z],
        "state": state.label if known else None,
        **said_of(state),
        "trajectory": state.trajectory_id or None,
        "frame": follower.frame,
        "frame_count": state.frame_count,
        "duration": state.duration,
        "rate": state.rate,
        "system": state.system or None,
        "deadline_error": follower.errors[-1] if moving else None,
        "deadline_error_max": follower.error_max if moving else None,
        "frames_lost": follower.frames_lost,
    }


def said_of(state: Any) -> dict[str, Any]:
    """Return what a state says: its text, its code, and the values by name."""
    values = {each.key: each.value for each in state.values}
    return {"message": state.message, "code": state.code, "values": values}


def recorder_facts(state: Any) -> dict[str, Any] | None:
    if state is None:
        return None
    return {
        "state": ("STOPPED", "RECORDING", "REPLAYING", "PAUSED")[state.state],
        "bag": state.bag or None,
        "position": state.position,
        "duration": state.duration,
        "rate": state.rate,
        "messages": state.messages,
        **said_of(state),
    }


def latency_facts(observer: str, report: Any) -> dict[str, Any]:
    return {
        "observer": observer,
        "window": report.window,
        "clock_error": report.clock_error,
        "hops": [
            {
                "from": HOPS[hop.hop][0],
                "to": HOPS[hop.hop][1],
                "topic": hop.topic or None,
                "count": hop.count,
                "p50": hop.p50,
                "p95": hop.p95,
                "max": hop.max,
            }
            for hop in report.hops
            if hop.hop < len(HOPS)
        ],
    }
