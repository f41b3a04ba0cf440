"""YAML files: numbers as ROS reads them, mistakes named."""

from __future__ import annotations

from pathlib import Path

import pytest

from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.errors import BadInput


def read(folder: Path, text: str, **options: bool) -> object:
    path = folder / "file.yaml"
    path.write_text(text)
    return read_yaml(path, **options)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e3", 1000.0),
        ("-1.5E-2", -0.015),
        (".5e1", 5.0),
        ("1.0e+3", 1000.0),
        ("7766e92afcfd71c0", "7766e92afcfd71c0"),
        ("'1e3'", "1e3"),
        ("e3", "e3"),
    ],
)
def test_an_exponent_makes_a_number(tmp_path: Path, text: str, value: object) -> None:
    assert read(tmp_path, f"x: {text}") == {"x": value}


def test_an_empty_file_is_a_mapping_only_where_it_may_be(tmp_path: Path) -> None:
    assert read(tmp_path, "# nothing", empty=True) == {}
    with pytest.raises(BadInput, match="expected a YAML mapping"):
        read(tmp_path, "# nothing")


@pytest.mark.parametrize(("text", "says"), [("x: [", "cannot be read"), ("[1]", "holds list")])
def test_what_is_no_mapping_is_named(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(BadInput, match=says):
        read(tmp_path, text)
