"""The shipped set-ups of RViz and Foxglove show what the frames node publishes, as it does."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml

from mrlab_ros.core.bridge.rules import parse
from mrlab_ros.core.recording.topics import LAB_TOPICS, Topics
from mrlab_ros.messages.qos import message_class

ROOT = Path(__file__).parents[2]
LAYOUTS = sorted((ROOT / "config" / "foxglove").glob("*.json"))
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


@pytest.mark.parametrize("file", LAYOUTS, ids=lambda file: file.stem)
def test_a_layout_of_foxglove_shows_what_there_is(file: Path) -> None:
    document = json.loads(file.read_text())
    assert set(document) == {
        "configById", "globalVariables", "userNodes", "playbackConfig", "layout",
    }  # fmt: skip
    (panel,) = [each for name, each in document["configById"].items() if name.startswith("3D!")]
    assert {name for name, topic in panel["topics"].items() if topic["visible"]} == SHOWN
    assert panel["followTf"] == "world"
    # The meshes are in the frames of their links, z up; Foxglove turns them by default.
    assert panel["scene"]["meshUpAxis"] == "z_up"

    def panels(layout: Any) -> set[str]:
        if isinstance(layout, str):
            return {layout}
        assert layout["direction"] in ("row", "column")
        return panels(layout["first"]) | panels(layout["second"])

    assert panels(document["layout"]) == set(document["configById"])


@pytest.mark.parametrize("file", LAYOUTS, ids=lambda file: file.stem)
def test_each_path_of_a_layout_is_a_field_of_its_topic(file: Path) -> None:
    rules = parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text())).topics
    panels = json.loads(file.read_text())["configById"].values()
    paths = [each["value"] for panel in panels for each in panel.get("paths", ())]
    paths += [
        panel[key] for panel in panels for key in ("topicPath", "topicToRender") if key in panel
    ]
    assert paths
    for path in paths:
        topic, *fields = path.split(".")
        rule = next(each for each in rules if each.pattern.fullmatch(topic))
        assert topic in Topics(LAB_TOPICS), path
        kind = rule.type
        for field in fields:
            name, bracket, _ = field.partition("[")
            found = message_class(kind).get_fields_and_field_types()[name]
            assert bool(bracket) == found.startswith("sequence<"), path
            kind = found.removeprefix("sequence<").removesuffix(">").replace("/", "/msg/")
        assert not fields or "/" not in kind, f"{path} is no number, but {kind}"


def test_the_node_publishes_what_is_shown_and_bags_hold_it() -> None:
    recorded = Topics(LAB_TOPICS)
    for name in (*SHOWN, "/tf", "/tf_static"):
        assert f'"{name}"' in SOURCES, name
        assert name in recorded, name
