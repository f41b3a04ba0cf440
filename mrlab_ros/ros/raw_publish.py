"""Publishes CDR without the checks of rclpy's publisher, which take as long as the publishing."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.publisher import Publisher


def raw_publish(publisher: Publisher) -> Callable[[bytes], None]:
    """Return what publishes the CDR of a message; end its use before the publisher's node."""
    return publisher.handle.publish_raw  # type: ignore[no-any-return]
