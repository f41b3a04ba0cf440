"""The shipped set-ups of RViz and Foxglove show what the frames node publishes, as it does."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import yaml

from mrlab_ros.core.recording.topics import LAB_TOPICS, Topics

ROOT = Path(__file__).parents[2]
SOURCES = "\n".join(path.read_text() for path in (ROOT / "mrlab_ros/nodes/frames").glob("*.py"))
SHOWN = {
    "/robot_description",
    "/markers/objects",
    "/markers/surfaces",
    "/markers/robots",
    "/markers/contacts",
}


def test_rviz_shows_all_and_asks_for_latched_topics_as_latched() -> None:
    document = yaml.safe_load((ROOT / "config/mrlab.rviz").read_text())
    manager = document["Visualization Manager"]
    topics: dict[str, dict[str, Any]] = {}
    for display in manager["Displays"]:
        topic = display.get("Topic") or display.get("Description Topic")
        if topic:
            topics[topic["Value"]] = topic
    assert set(topics) == SHOWN
    for name, topic in topics.items():
        latched = name != "/markers/contacts"
        assert topic["Durability Policy"] == ("Transient Local" if latched else "Volatile"), name
    assert manager["Global Options"]["Fixed Frame"] == "world"
    model = next(d for d in manager["Displays"] if d["Class"].endswith("/RobotModel"))
    assert model["TF Prefix"] == "", "the links are named as their frames"


def test_foxglove_shows_all() -> None:
    document = json.loads((ROOT / "config/mrlab_foxglove.json").read_text())
    panel = document["configById"]["3D!mrlab"]
    assert {name for name, topic in panel["topics"].items() if topic["visible"]} == SHOWN
    assert panel["followTf"] == "world"
    # The meshes are in the frames of their links, z up; Foxglove turns them by default.
    assert panel["scene"]["meshUpAxis"] == "z_up"

    def panels(layout: Any) -> set[str]:
        if isinstance(layout, str):
            return {layout}
        return panels(layout["first"]) | panels(layout["second"])

    assert panels(document["layout"]) == set(document["configById"])


def test_the_node_publishes_what_is_shown_and_bags_hold_it() -> None:
    recorded = Topics(LAB_TOPICS)
    for name in (*SHOWN, "/tf", "/tf_static"):
        assert f'"{name}"' in SOURCES, name
        assert name in recorded, name
