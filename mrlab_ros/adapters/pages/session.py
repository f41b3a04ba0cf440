"""A page about a recorded session, made of the bag alone."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from mrlab_ros.adapters.bags.motion import mesh_files, read_motion
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.session import read_session
from mrlab_ros.adapters.pages import ingredients
from mrlab_ros.core.recording.report import SessionReport
from mrlab_ros.core.show.page import page
from mrlab_ros.core.show.session import session
from mrlab_ros.core.show.session_body import session_body


def session_page(bag: Bag, share: Path, report: SessionReport | None = None) -> str:
    """Return one HTML file that shows what a bag recorded.

    share: folder with the built pages. report: of the bag, where it was read already.
    """
    said = report or read_session(bag)
    motion = read_motion(bag)
    title = bag.path.name
    document = session(title, said, motion)
    began = ""
    if bag.message_count:
        began = datetime.fromtimestamp(bag.start_ns / 1e9).strftime("%Y-%m-%d %H:%M:%S")
    with mesh_files(bag, share) as resolve:
        meshes = ingredients.meshes_of((robot["urdf"] for robot in document["robots"]), resolve)
        objects = {thing["mesh"] for thing in document["objects"] if thing["mesh"]}
        meshes |= ingredients.small(objects, resolve)
    body = session_body(title, document, said, began)
    return page(title, body, document, meshes, ingredients.code(share))
