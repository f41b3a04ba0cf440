"""What a description says to those that draw it: packed levels of detail, and hoses that bend.

Both are elements beside the links, which readers of URDF skip:

    <level_of_detail near="package://.../ur5e/lod/near.glb" far="package://.../ur5e/lod/far.glb"/>
    <hose radius="0.02" length="0.9">
      <end link="link_1" xyz="0 0 0" direction="0 0 1"/>
      <end link="link_3" xyz="0 0 0" direction="1 0 0"/>
    </hose>
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

LEVELS = ("near", "far")


def levels(folder: Path, uri: str) -> list[ET.Element]:
    """Return the packed levels of a model's folder; none where one is missing.

    uri: of the folder. They stand for all meshes below <uri>/meshes/, which is not named: clients
    fetch whatever a description names as package://.
    """
    if not all((folder / "lod" / f"{name}.glb").is_file() for name in LEVELS):
        return []
    files = {name: f"{uri}/lod/{name}.glb" for name in LEVELS}
    return [ET.Element("level_of_detail", files)]


def hoses(facts: Mapping[str, Any]) -> list[ET.Element]:
    """Return the hoses of a robot.yaml: `hoses`, each with radius, length and two ends."""
    found = []
    for stated in facts.get("hoses", ()):
        hose = ET.Element(
            "hose", radius=repr(float(stated["radius"])), length=repr(float(stated["length"]))
        )
        for end in stated["ends"]:
            ET.SubElement(
                hose,
                "end",
                link=str(end["link"]),
                xyz=_numbers(end["xyz"]),
                direction=_numbers(end["direction"]),
            )
        found.append(hose)
    return found


def added(text: str, elements: Iterable[ET.Element]) -> str:
    """Return a URDF with elements beside its links."""
    lines = [f"  {ET.tostring(element, encoding='unicode')}\n" for element in elements]
    head, end, rest = text.rpartition("</robot>")
    return f"{head}{''.join(lines)}{end}{rest}"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
