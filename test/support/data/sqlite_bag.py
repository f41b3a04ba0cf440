"""Copies a bag of the lab as rosbag2's sqlite3 plugin would have recorded it."""

from __future__ import annotations

from pathlib import Path

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer

from mrlab_ros.adapters.bags.reader import Bag


def as_sqlite(bag: Bag, folder: Path) -> Path:
    """Write the messages of `bag` to the new folder `folder`; its attachments are left out."""
    definitions = bag.definitions()
    with Writer(folder, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connections = {
            topic.name: writer.add_connection(
                topic.name,
                topic.type,
                msgdef=definitions[topic.type],
                rihs01=topic.type_hash or "RIHS01_0",
                offered_qos_profiles=[_latched()] if topic.latched else [],
            )
            for topic in bag.topics.values()
        }
        for message in bag.messages():
            writer.write(connections[message.topic], message.log_time_ns, message.data)
    return folder


def _latched() -> Qos:
    never = QosTime(2147483647, 4294967295)
    return Qos(
        QosHistory.KEEP_LAST,
        1,
        QosReliability.RELIABLE,
        QosDurability.TRANSIENT_LOCAL,
        never,
        never,
        QosLiveliness.AUTOMATIC,
        never,
        False,
    )
