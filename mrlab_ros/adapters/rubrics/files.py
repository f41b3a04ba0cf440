"""Rubrics as YAML files: what scenes and references are called in them is beside them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from mrlab_ros.adapters.yaml_files import read_with_lines
from mrlab_ros.core.rubrics import document
from mrlab_ros.core.rubrics.rubric import Rubric

SCENES = (".yaml", ".yml", ".json")


def read(path: Path) -> Rubric:
    """Return the rubric in a file, its reference and the file of its scene as paths from here.

    Raises BadInput that names every mistake with its line.
    """
    content, lines = read_with_lines(path)
    rubric = document.parse(content, str(path), lines)
    scene = rubric.scene
    if scene and (Path(scene).suffix in SCENES or "/" in scene):
        scene = str(path.parent / scene)
    reference = str(path.parent / rubric.reference) if rubric.reference else ""
    return replace(rubric, name=rubric.name or path.stem, scene=scene, reference=reference)
