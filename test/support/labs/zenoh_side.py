"""The other end of the bridge: zenoh sessions and processes that know nothing of the graph."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import zenoh
from child_process import start_child
from sensor_msgs.msg import JointState

CLIENTS = Path(__file__).parents[3] / "examples" / "clients" / "python"
JOINTS = "ur5e_1/joint_states"
STATISTICS = "@mrlab/bridge/statistics"


def connect(*endpoints, **settings):
    """Open a client's session; settings: paths of zenoh's, with __ for a slash, and values."""
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps(endpoints))
    config.insert_json5("scouting/multicast/enabled", "false")
    for path, value in settings.items():
        config.insert_json5(path.replace("__", "/"), json.dumps(value))
    return zenoh.open(config)


def start_client(script, *arguments):
    """Start a client's script, which sees nothing of the lab's packages."""
    ours = ("PYTHONPATH", "AMENT_PREFIX_PATH", "LD_LIBRARY_PATH")
    return start_child(
        *(sys.executable, str(CLIENTS / script), *arguments),
        env={k: v for k, v in os.environ.items() if k not in ours},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def ask(session, key, payload=None):
    """Return a query's one answer as (payload, None) or (None, reason)."""
    replies = list(session.get(key, payload=payload, timeout=30.0))
    assert len(replies) == 1, f"{len(replies)} answers on {key}"
    if replies[0].ok is None:
        return None, replies[0].err.payload.to_string()
    return replies[0].ok.payload.to_bytes(), None


def statistics(session, prefix=""):
    return json.loads(ask(session, f"{prefix}{STATISTICS}")[0])


def heard(session, key, prefix=""):
    return statistics(session, prefix)["keys"].get(f"{prefix}{key}", {}).get("heard", False)


def tokens(session):
    """Return all tokens but those of the bridge's own reports."""
    found = {str(r.ok.key_expr) for r in session.liveliness().get("@/*/@ros2_lv/**") if r.ok}
    return {token for token in found if "mrlab_msgs§msg§Latency" not in token}


def joints(position):
    message = JointState(name=["shoulder"], position=[position])
    message.header.frame_id = "ur5e_1"
    return message
