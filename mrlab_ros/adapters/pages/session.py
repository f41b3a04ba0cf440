"""A page about a recorded session, made of the bag alone."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.bags.motion import mesh_files, read_motion
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.session import read_session
from mrlab_ros.adapters.pages import ingredients
from mrlab_ros.core.recording.report import SessionReport
from mrlab_ros.core.show import static
from mrlab_ros.core.show.page import page
from mrlab_ros.core.show.session import session


def session_page(bag: Bag, share: Path, report: SessionReport | None = None) -> str:
    """Return one HTML file that shows what a bag recorded.

    share: folder with the built pages. report: of the bag, where it was read already.
    """
    said = report or read_session(bag)
    motion = read_motion(bag)
    title = bag.path.name
    document = session(title, said, motion)
    with mesh_files(bag, share) as resolve:
        meshes = ingredients.meshes_of((robot["urdf"] for robot in document["robots"]), resolve)
        objects = {thing["mesh"] for thing in document["objects"] if thing["mesh"]}
        meshes |= ingredients.small(objects, resolve)
    return page(title, static.session(document), document, meshes, ingredients.code(share))
