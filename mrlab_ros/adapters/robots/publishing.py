"""Robots' URDFs as they are published: links named as their frames, for RViz, Foxglove, MoveIt."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.core.robots.frames import WORLD, frame_name, joint_name

DECLARATION = '<?xml version="1.0"?>\n'


def published(text: str, robot: str) -> str:
    """Return a robot's URDF with its links named as their frames; the joints keep their names."""
    root = urdf.parse(text, f"the URDF of {robot}")
    for link in root.iterfind("link"):
        link.set("name", frame_name(robot, link.get("name", "")))
    for path in ("joint/parent", "joint/child", "hose/end"):
        for end in root.iterfind(path):
            end.set("link", frame_name(robot, end.get("link", "")))
    return f"{DECLARATION}{ET.tostring(root, encoding='unicode')}\n"


def together(descriptions: Mapping[str, str]) -> str:
    """Return one URDF of all robots of the lab, so that one display shows them all.

    descriptions: by robot its published URDF. Each base hangs at `world` by a floating joint:
    /tf_static says where it stands. Joints and materials are named by robot, too, since one URDF
    must not name two alike; joints as /joint_states has them.
    """
    lab = ET.Element("robot", name="lab")
    ET.SubElement(lab, "link", name=WORLD)
    for robot, text in descriptions.items():
        root = urdf.parse(text, f"the URDF of {robot}")
        base = urdf.frames(root, f"the URDF of {robot}").root
        stand = ET.SubElement(lab, "joint", name=joint_name(robot, "base"), type="floating")
        ET.SubElement(stand, "parent", link=WORLD)
        ET.SubElement(stand, "child", link=base)
        attributes = (
            *((element, "name") for element in root if element.tag in ("joint", "material")),
            *((element, "joint") for element in root.iterfind("joint/mimic")),
            *((element, "name") for element in root.iterfind("link/visual/material")),
        )
        for element, attribute in attributes:
            named = joint_name if element.tag in ("joint", "mimic") else frame_name
            element.set(attribute, named(robot, element.get(attribute, "")))
        lab.extend(e for e in root if e.tag in ("link", "joint", "material"))
    return f"{DECLARATION}{ET.tostring(lab, encoding='unicode')}\n"
