"""Writes URDF text from the figures of a robot.yaml or an end_effector.yaml."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any
from xml.sax.saxutils import quoteattr

# What a frame without a body weighs, kg and kg*m^2: engines take 1 kg for one that states nothing.
FRAME = {"mass": 1e-6, "com": [0.0, 0.0, 0.0], "inertia": [1e-9, 0.0, 0.0, 1e-9, 0.0, 1e-9]}


@dataclass(frozen=True)
class LinkFiles:
    """The mesh files of one link, by name inside the model's meshes/ folder."""

    visual: str | None = None
    collision: tuple[str, ...] = field(default=())


def _numbers(values: Sequence[float]) -> str:
    return " ".join(repr(float(value) + 0.0) for value in values)


def _mesh(tag: str, uri: str) -> list[str]:
    return [
        f"    <{tag}>",
        f"      <geometry><mesh filename={quoteattr(uri)}/></geometry>",
        f"    </{tag}>",
    ]


def _link(
    name: str,
    inertial: dict[str, Any] | None,
    boxes: Sequence[dict[str, Any]],
    files: LinkFiles,
    folder: str,
) -> list[str]:
    inertial = inertial or FRAME
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    tensor = " ".join(
        f'{n}="{float(v)!r}"' for n, v in zip(names, inertial["inertia"], strict=True)
    )
    lines = [
        f"  <link name={quoteattr(name)}>",
        "    <inertial>",
        f'      <origin xyz="{_numbers(inertial["com"])}" rpy="0 0 0"/>',
        f'      <mass value="{float(inertial["mass"])!r}"/>',
        f"      <inertia {tensor}/>",
        "    </inertial>",
    ]
    if files.visual:
        lines += _mesh("visual", f"{folder}/{files.visual}")
    for box in boxes:
        lines += [
            "    <collision>",
            f'      <origin xyz="{_numbers(box["xyz"])}" rpy="0 0 0"/>',
            f'      <geometry><box size="{_numbers(box["size"])}"/></geometry>',
            "    </collision>",
        ]
    for file in files.collision:
        lines += _mesh("collision", f"{folder}/{file}")
    return [*lines, "  </link>"]


def _joint(joint: dict[str, Any]) -> list[str]:
    lines = [
        f"  <joint name={quoteattr(joint['name'])} type={quoteattr(joint['type'])}>",
        f"    <parent link={quoteattr(joint['parent'])}/>",
        f"    <child link={quoteattr(joint['child'])}/>",
        f'    <origin xyz="{_numbers(joint["xyz"])}" rpy="{_numbers(joint["rpy"])}"/>',
    ]
    if joint["type"] != "fixed":
        # URDF wants a number where the effort is unknown; 0 is what the vendors' files write.
        effort = 0.0 if joint["effort"] is None else joint["effort"]
        lines += [
            f'    <axis xyz="{_numbers(joint["axis"])}"/>',
            f'    <limit lower="{joint["lower"]!r}" upper="{joint["upper"]!r}" '
            f'effort="{effort!r}" velocity="{joint["velocity"]!r}"/>',
        ]
    if "mimic" in joint:
        lines.append(f'    <mimic joint={quoteattr(joint["mimic"])} multiplier="1" offset="0"/>')
    return [*lines, "  </joint>"]


def urdf(figures: dict[str, Any], files: dict[str, LinkFiles], uri: str) -> str:
    """Return the URDF of a model; its meshes lie in the folder that `uri` names."""
    joints: list[dict[str, Any]] = figures["joints"]
    inertials: dict[str, Any] = figures["inertials"]
    names = [joints[0]["parent"]] if joints else list(inertials)
    names += [joint["child"] for joint in joints]
    lines = [
        '<?xml version="1.0"?>',
        "<!-- Written by scripts/bodies/generate.py. -->",
        f"<robot name={quoteattr(figures['id'])}>",
    ]
    boxes: dict[str, Any] = figures.get("boxes", {})
    for name in names:
        own = files.get(name, LinkFiles())
        lines += _link(name, inertials.get(name), boxes.get(name, ()), own, uri)
    for joint in joints:
        lines += _joint(joint)
    return "\n".join([*lines, "</robot>", ""])
