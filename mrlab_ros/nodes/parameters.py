"""The parameters of the lab's nodes: one record each. docs/parameters.md is made from them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.checks import (
    FLAG,
    TEXT,
    Choice,
    Integer,
    Number,
    Text,
    Texts,
    above,
    between,
)
from mrlab_ros.core.base.names import NAME
from mrlab_ros.core.base.records import field
from mrlab_ros.core.bridge.rules import FULL_NAME, PREFIX
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, MOST_ROWS
from mrlab_ros.core.recording.topics import LAB_TOPICS

RATE = Number(above(0, 100), "Hz")
SIZE = Integer(between(1, 1_048_576), "MiB")
ROBOTS = Texts(Text(NAME, "a name such as ur5e"), skip_empty=True)
# In `listen`: the bridge chooses the endpoints.
AUTOMATIC = "auto"
ENDPOINT = r"[a-z][a-z-]*/.+"
ENDPOINT_EXAMPLE = "protocol/address:port such as tcp/127.0.0.1:7447"
LISTEN = Texts(
    Text(re.compile(f"{AUTOMATIC}|{ENDPOINT}"), f"{ENDPOINT_EXAMPLE}, or {AUTOMATIC}"),
    skip_empty=True,
)
CONNECT = Texts(Text(re.compile(ENDPOINT), ENDPOINT_EXAMPLE), skip_empty=True)


def _state_dir(about: str) -> Any:
    return field(TEXT, about, "")


def _lab_id() -> Any:
    return field(
        TEXT, "Id of this lab, which mrlab up chooses: messages of another one are ignored.", ""
    )


@dataclass(frozen=True)
class ConverterParameters:
    state_dir: str = _state_dir(
        "Folder for the store and for trajectories fetched from one; empty: ~/.local/share/mrlab."
    )
    store: str = field(
        TEXT,
        "Object store of uploads and trajectories: a folder, or an URL such as s3://bucket/lab; "
        "empty: the folder store in state_dir.",
        "",
    )
    versions_kept: int = field(
        Integer(between(1, 1000)), "Versions of a trajectory that are kept.", 10, changeable=True
    )
    quota: int = field(
        Integer(between(0, 1_048_576), "MiB"),
        "Size of one user's trajectories; 0: no limit.",
        2048,
        changeable=True,
    )
    trash_time: float = field(
        Number(above(0, 3650), "d"),
        "How long a deleted trajectory can be brought back.",
        30.0,
        changeable=True,
    )
    upload_time: float = field(
        Number(above(0, 3650), "d"),
        "How long uploads and unpublished drafts are kept.",
        7.0,
        changeable=True,
    )
    default_frame_rate: float = field(
        Number(above(0, 100_000), "Hz"),
        "Frame rate of a file that does not give one.",
        DEFAULT_FRAME_RATE,
        changeable=True,
    )
    time_limit: float = field(
        Number(above(0, 3600), "s"), "Time for reading one file.", 20.0, changeable=True
    )
    memory_limit: int = field(
        Integer(between(64, 1_048_576), "MiB"),
        "Memory of the process that reads one file.",
        1024,
        changeable=True,
    )
    output_limit: int = field(SIZE, "Size of the content of one file.", 1024, changeable=True)
    file_size_limit: int = field(SIZE, "Size of one file.", 1024, changeable=True)
    row_limit: int = field(
        Integer(between(2, 1_000_000_000), "rows"),
        "Samples of one trajectory.",
        MOST_ROWS,
        changeable=True,
    )


@dataclass(frozen=True)
class LabParameters:
    state_dir: str = _state_dir(
        "Folder for the scene; empty: the scene is lost when the node ends."
    )
    lab_id: str = _lab_id()
    robots: tuple[str, ...] = field(
        ROBOTS,
        "Models of the robots to spawn at the start, such as [ur5e, kuka_kr3_r540], where no "
        "scene is restored.",
        (),
    )


@dataclass(frozen=True)
class CoordinatorParameters:
    state_dir: str = _state_dir(
        "Folder for the journal of systems; empty: they are lost when the node ends."
    )
    lab_id: str = _lab_id()


@dataclass(frozen=True)
class PlaybackParameters:
    state_dir: str = _state_dir(
        "Folder for the journal of what robots have loaded and where they stand; empty: it is "
        "lost when the node ends."
    )
    lab_id: str = _lab_id()
    standing_rate: float = field(
        Number(between(0, 100), "Hz"),
        "How often a robot that does not move repeats its joint state; 0: never.",
        2.0,
        changeable=True,
    )
    telemetry_rate: float = field(
        RATE, "How often the telemetry of a moving robot is published.", 10.0, changeable=True
    )
    robots: tuple[str, ...] = field(
        ROBOTS, "Names of the robots that this process plays; empty: all.", ()
    )
    direct: bool = field(
        FLAG,
        "Put joint states on zenoh itself where the bridge grants it, not through the bridge.",
        True,
    )
    socket: str = field(
        TEXT, "The bridge's Unix socket, to which they go; empty: through the bridge.", ""
    )
    prefix: str = field(PREFIX, "What every key begins with, as the bridge has it.", "")
    velocity_share: float = field(
        Number(above(0, 1)),
        "Share of each joint's velocity limit in the motion to a trajectory's first frame.",
        0.5,
        name="staging.velocity_share",
        changeable=True,
    )
    acceleration: float = field(
        Number(above(0, 1000), "rad/s^2"),
        "Acceleration limit of each joint in that motion.",
        6.0,
        name="staging.acceleration",
        changeable=True,
    )
    jerk: float = field(
        Number(above(0, 100_000), "rad/s^3"),
        "Jerk limit of each joint in that motion.",
        30.0,
        name="staging.jerk",
        changeable=True,
    )


@dataclass(frozen=True)
class PhysicsParameters:
    state_dir: str = _state_dir(
        "Folder for objects and surfaces; empty: they are lost when the node ends. Saved scenes "
        "belong to the node lab."
    )
    lab_id: str = _lab_id()


@dataclass(frozen=True)
class FramesParameters:
    lab_id: str = _lab_id()
    rate: float = field(
        Number(between(1, 200), "Hz"),
        "How often the frames of moving robots are published on /tf; a 3D panel draws at 30.",
        30.0,
    )
    marker_rate: float = field(
        Number(between(0, 60), "Hz"),
        "How often the markers of what moves are published at most; 0: no markers.",
        10.0,
    )


@dataclass(frozen=True)
class RecorderParameters:
    lab_id: str = field(
        TEXT,
        "Id of this lab, which mrlab up chooses: a recording ends with its lab, not with its "
        "process.",
        "",
    )
    state_dir: str = _state_dir(
        "Folder for the journal of the recording; empty: a recorder that is restarted does not "
        "continue it."
    )
    bag_dir: str = field(
        TEXT,
        "Folder of bags that are named without one; empty: ~/.local/share/mrlab/bags.",
        "",
        changeable=True,
    )
    topics: tuple[str, ...] = field(
        Texts(FULL_NAME, skip_empty=True),
        "Topics to record where the request names none.",
        LAB_TOPICS,
        changeable=True,
    )
    split_size: int = field(
        Integer(between(0, 1_000_000), "MB"),
        "Size at which a recording continues in a new file; 0: never. The index of the open file "
        "is in memory: about 100 MB an hour for fifty robots.",
        256,
        changeable=True,
    )


@dataclass(frozen=True)
class BridgeParameters:
    lab_id: str = _lab_id()
    state_dir: str = _state_dir(
        "Folder of the orders for a recorder that does not run; empty: none is kept."
    )
    allow_list: str = field(TEXT, "YAML file with the rules; empty: config/bridge.yaml.", "")
    prefix: str = field(PREFIX, "What every key begins with.", "")
    mode: str = field(
        Choice({mode: mode for mode in ("peer", "client", "router")}), "zenoh's mode.", "peer"
    )
    listen: tuple[str, ...] = field(
        LISTEN,
        f"Endpoints to listen on; {AUTOMATIC}: tcp/127.0.0.1:7447, with keys tls/0.0.0.0:7447, "
        "with keys and connect none.",
        (AUTOMATIC,),
    )
    connect: tuple[str, ...] = field(
        CONNECT, "Endpoints to connect to; with keys those of a secured router.", ()
    )
    keys: str = field(
        TEXT,
        "Keys folder: only its people may connect, over TLS, each in their role; empty: no keys.",
        "",
    )
    socket: str = field(
        TEXT,
        "Unix socket on which programs of this machine connect with all rights; who may is up to "
        "its folder's permissions; empty: none. Not with a router or passwords.",
        "",
    )
    lease: float = field(
        Number(between(0, 3600), "s"),
        "Time after which a silent link counts as broken; 0: 1.5 beyond this machine, 10 within.",
        0.0,
    )
    sessions_each: int = field(
        Integer(between(1, 1000), "sessions"),
        "With keys: sessions that one person may have at a time.",
        10,
    )
    guest_rate: float = field(
        Number(between(1, 1e9), "B/s"),
        "With keys: bytes a second that a person who is no instructor may send, all sessions "
        "together; who sends more is disconnected for 30 s.",
        65_536.0,
    )
    guest_burst: float = field(
        Number(between(65_536, 1e9), "bytes"),
        "With keys: bytes that such a person may send at once.",
        1_048_576.0,
    )
    insecure: bool = field(FLAG, "Allow listening beyond this machine without encryption.", False)
    zenoh_config: str = field(
        TEXT,
        "zenoh configuration file (json5) in place of mode, listen, connect, insecure, keys and "
        "lease.",
        "",
    )
    discovery_period: float = field(
        Number(between(0.01, 60), "s"),
        "Time between two checks for new topics and services while the graph changes.",
        0.2,
        changeable=True,
    )


# By the node's name in the graph.
NODES: dict[str, type[Any]] = {
    "converter": ConverterParameters,
    "lab": LabParameters,
    "coordinator": CoordinatorParameters,
    "playback_host": PlaybackParameters,
    "physics": PhysicsParameters,
    "recorder": RecorderParameters,
    "frames": FramesParameters,
    "bridge": BridgeParameters,
}
ALL = tuple(NODES.values())
