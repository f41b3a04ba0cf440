"""The figures of the physics: the shipped file holds the defaults of the records."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import yaml
from refusals import refused

from mrlab_ros.core.base.diagnostics import AN_INTEGER
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.physics.settings import Settings

SHIPPED = Path(__file__).parents[4] / "config" / "physics.yaml"


def test_the_shipped_file_names_every_figure_with_its_default():
    values = yaml.safe_load(SHIPPED.read_text())
    assert list(values) == list(asdict(Settings()))
    assert Settings.from_mapping(values) == Settings()


def test_figures_that_were_set_in_code_are_checked_too():
    with refused(AN_INTEGER, BadInput):
        Settings(max_objects=0)
