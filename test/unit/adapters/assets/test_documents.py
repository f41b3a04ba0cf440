"""What the documents about robots say, as JSON."""

from __future__ import annotations

import json

from mrlab_ros.adapters import share
from mrlab_ros.adapters.assets import documents
from mrlab_ros.adapters.assets.files import AssetFiles
from mrlab_ros.adapters.robots.library import RobotLibrary


def test_every_shipped_robot_and_end_effector_is_in_the_document() -> None:
    library = RobotLibrary(share.directory() / "robots")
    files = AssetFiles(share.directory(), library)
    read = json.loads(json.dumps(documents.robots(library, files)))
    assert [robot["id"] for robot in read["robots"]] == list(library.ids())
    assert [each["id"] for each in read["end_effectors"]] == list(library.end_effectors())
    assert read["problems"] == []
    followers = [
        joint["mimic"]
        for each in read["end_effectors"]
        for joint in each["joints"]
        if joint["mimic"] is not None
    ]
    assert followers
    assert all(set(each) == {"joint", "multiplier", "offset"} for each in followers)
