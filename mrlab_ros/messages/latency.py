"""Reports of the bridge's delays as messages."""

from __future__ import annotations

from collections.abc import Iterable

from mrlab_msgs.msg import Latency, LatencyHop

from mrlab_ros.core.bridge.latency import Delays
from mrlab_ros.messages.time import make_header


def latency_to_message(
    now_ns: int, observer: str, window: float, delays: Iterable[Delays]
) -> Latency:
    """Return a report of the way from publishing in the graph to zenoh. window: s."""
    return Latency(
        header=make_header(now_ns),
        observer=observer,
        window=window,
        hops=[
            LatencyHop(
                hop=LatencyHop.PUBLISHED_TO_BRIDGED,
                topic=delay.topic,
                count=delay.count,
                p50=delay.p50,
                p95=delay.p95,
                max=delay.max,
            )
            for delay in delays
        ],
    )
