"""The state of the recorder as a message."""

from __future__ import annotations

from mrlab_msgs import msg

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header


def recorder_state_to_message(
    now_ns: int,
    state: int,
    said: Diagnostic | None,
    *,
    bag: str = "",
    position: float = 0.0,
    duration: float = 0.0,
    rate: float = 1.0,
    messages: int = 0,
    size: int = 0,
) -> msg.RecorderState:
    """state: a value of RecorderState.msg. said: the trouble. position, duration: s.

    size: bytes of the bag.
    """
    return msg.RecorderState(
        header=make_header(now_ns),
        state=state,
        **told(said),
        bag=bag,
        position=position,
        duration=duration,
        rate=rate,
        messages=messages,
        bytes=size,
    )
