"""The metadata.yaml of a bag: rosbag2's document of version 9, as ROS 2 Jazzy writes it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.diagnostics import (
    METADATA_TOO_NEW,
    METADATA_WITHOUT_FILES,
    NO_METADATA,
    OTHER_STORAGE,
    RECORDING_GAP,
    RECORDING_GAP_UNKNOWN,
    importing,
    repairing,
)

VERSION = 9
ROOT = "rosbag2_bagfile_information"
# The metadata record in a file that the recorder began after a time in which it did not run.
GAP = "mrlab_gap"
# rosbag2's start of a bag without messages.
NEVER_NS = 2**63 - 1
POLICIES = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown"),
    "durability": ("system_default", "transient_local", "volatile", "unknown"),
    "liveliness": ("system_default", "automatic", "manual_by_node", "manual_by_topic", "unknown"),
}


@dataclass(frozen=True)
class QosProfile:
    """The quality of service that one publisher offered. Policies by rosbag2's names; times ns."""

    history: str = "unknown"
    depth: int = 0
    reliability: str = "reliable"
    durability: str = "volatile"
    deadline_ns: int = NEVER_NS
    lifespan_ns: int = NEVER_NS
    liveliness: str = "automatic"
    lease_ns: int = NEVER_NS

    def document(self) -> dict[str, Any]:
        return {
            "history": self.history,
            "depth": self.depth,
            "reliability": self.reliability,
            "durability": self.durability,
            "deadline": _time(self.deadline_ns),
            "lifespan": _time(self.lifespan_ns),
            "liveliness": self.liveliness,
            "liveliness_lease_duration": _time(self.lease_ns),
            "avoid_ros_namespace_conventions": False,
        }


def quality_from(document: Mapping[str, Any]) -> QosProfile:
    """Read a profile that `QosProfile.document` or any rosbag2 wrote; policies may be numbers."""

    def policy(name: str) -> str:
        value = document.get(name, "unknown")
        known = POLICIES[name]
        if isinstance(value, int):
            return known[value] if 0 <= value < len(known) else "unknown"
        return str(value)

    return QosProfile(
        history=policy("history"),
        depth=int(document.get("depth", 0)),
        reliability=policy("reliability"),
        durability=policy("durability"),
        deadline_ns=_nanoseconds(document.get("deadline")),
        lifespan_ns=_nanoseconds(document.get("lifespan")),
        liveliness=policy("liveliness"),
        lease_ns=_nanoseconds(document.get("liveliness_lease_duration")),
    )


@dataclass(frozen=True)
class Gap:
    """A time in which the recorder did not run, ns since the epoch."""

    from_ns: int
    until_ns: int

    @property
    def duration(self) -> float:
        """How long it lasted, s."""
        return (self.until_ns - self.from_ns) / SECOND

    def said(self, start_ns: int) -> Diagnostic:
        """Return what is said of it. start_ns: of the bag."""
        time = (self.from_ns - start_ns) / SECOND
        # A clock that was set back meanwhile does not say how long it lasted.
        if not self.duration:
            return RECORDING_GAP_UNKNOWN(time=time)
        return RECORDING_GAP(time=time, missing=self.duration)

    def note(self) -> dict[str, str]:
        """Return the metadata record of it."""
        return {"from_ns": str(self.from_ns), "until_ns": str(self.until_ns)}

    @classmethod
    def read(cls, note: Mapping[str, str]) -> Gap:
        """Return what note() was made of."""
        return cls(int(note["from_ns"]), int(note["until_ns"]))


@dataclass
class Topic:
    """A topic of a bag. type_hash is RIHS01_...; qualities are one a publisher."""

    name: str
    type: str
    qualities: tuple[QosProfile, ...] = ()
    type_hash: str = ""
    messages: int = 0

    @property
    def latched(self) -> bool:
        return bool(self.qualities) and all(
            q.durability == "transient_local" for q in self.qualities
        )

    @property
    def reliable(self) -> bool:
        return all(q.reliability != "best_effort" for q in self.qualities)


@dataclass
class FileInformation:
    """One file of a bag; times in ns since the epoch, of its first and last message."""

    path: str
    start_ns: int = NEVER_NS
    end_ns: int = 0
    messages: int = 0

    def count(self, log_time_ns: int) -> None:
        """Take note of one message more."""
        self.start_ns = min(self.start_ns, log_time_ns)
        self.end_ns = max(self.end_ns, log_time_ns)
        self.messages += 1

    def document(self) -> dict[str, Any]:
        return {
            "path": self.path,
            "starting_time": {"nanoseconds_since_epoch": self.start_ns},
            "duration": {"nanoseconds": max(self.end_ns - self.start_ns, 0)},
            "message_count": self.messages,
        }


@dataclass
class BagFacts:
    """All that metadata.yaml says."""

    topics: list[Topic] = field(default_factory=list)
    parts: list[FileInformation] = field(default_factory=list)
    custom: dict[str, str] = field(default_factory=dict)
    ros_distro: str = "jazzy"

    @property
    def messages(self) -> int:
        return sum(part.messages for part in self.parts)

    @property
    def start_ns(self) -> int:
        return min((part.start_ns for part in self.parts), default=NEVER_NS)

    @property
    def end_ns(self) -> int:
        return max((part.end_ns for part in self.parts), default=0)

    @property
    def duration_ns(self) -> int:
        return max(self.end_ns - self.start_ns, 0)

    def document(self) -> dict[str, Any]:
        """Return the document, ready for YAML."""
        return {
            ROOT: {
                "version": VERSION,
                "storage_identifier": "mcap",
                "duration": {"nanoseconds": self.duration_ns},
                "starting_time": {"nanoseconds_since_epoch": self.start_ns},
                "message_count": self.messages,
                "topics_with_message_count": [
                    {
                        "topic_metadata": {
                            "name": topic.name,
                            "type": topic.type,
                            "serialization_format": "cdr",
                            "offered_qos_profiles": [q.document() for q in topic.qualities],
                            "type_description_hash": topic.type_hash,
                        },
                        "message_count": topic.messages,
                    }
                    for topic in self.topics
                ],
                "compression_format": "",
                "compression_mode": "",
                "relative_file_paths": [part.path for part in self.parts],
                "files": [part.document() for part in self.parts],
                "custom_data": dict(self.custom) or None,
                "ros_distro": self.ros_distro,
            }
        }


def paths_in(document: object, name: str) -> list[str]:
    """Return the files that the metadata called `name` lists, oldest first.

    Raises BadInput where it is not a bag's, is of a later version or of another storage.
    """
    folder = name.rpartition("/")[0] or "."
    facts = document.get(ROOT) if isinstance(document, Mapping) else None
    if not isinstance(facts, Mapping):
        raise BadInput(NO_METADATA(file=name, field=ROOT, fixes=repairing(folder)))
    version, storage = facts.get("version"), facts.get("storage_identifier")
    if not isinstance(version, int) or version > VERSION:
        raise BadInput(METADATA_TOO_NEW(file=name, version=str(version), known=VERSION))
    compression = facts.get("compression_format")
    if storage != "mcap" or compression:
        raise BadInput(
            OTHER_STORAGE(
                file=name,
                storage=str(storage),
                compression=str(compression) if compression else None,
                fixes=importing(folder),
            )
        )
    paths = facts.get("relative_file_paths")
    if not isinstance(paths, Sequence) or not all(isinstance(path, str) for path in paths):
        raise BadInput(METADATA_WITHOUT_FILES(file=name, fixes=repairing(folder)))
    return list(paths)


def _nanoseconds(document: Any) -> int:
    if not isinstance(document, Mapping):
        return NEVER_NS
    return int(document.get("sec", 0)) * SECOND + int(document.get("nsec", 0))


def _time(nanoseconds: int) -> dict[str, int]:
    return {"sec": nanoseconds // SECOND, "nsec": nanoseconds % SECOND}
