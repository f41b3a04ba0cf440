"""YAML files: numbers as ROS reads them, mistakes named."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from refusals import refused

from mrlab_ros.adapters.diagnostics import (
    FILE_MISSING,
    FILE_UNREADABLE,
    KEY_TWICE,
    NOT_A_FILE,
    NOT_OF_FORMAT,
    NOT_UTF8,
    YAML_ALIAS,
    YAML_MAPPING,
)
from mrlab_ros.adapters.yaml_files import RosLoader, close_file, read_with_lines, read_yaml
from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.base.diagnostics import EMPTY_VALUE
from mrlab_ros.core.base.errors import BadInput


def read(folder: Path, text: str, **options: Any) -> object:
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
    with refused(EMPTY_VALUE, BadInput):
        read(tmp_path, "# nothing")


@pytest.mark.parametrize(("text", "code"), [("x: [", FILE_UNREADABLE), ("[1]", YAML_MAPPING)])
def test_what_is_no_mapping_is_named(tmp_path: Path, text: str, code: Code) -> None:
    with refused(code, BadInput):
        read(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("a: 1\nb: *a", YAML_ALIAS, {"line": 2, "alias": "a"}),
        ("a: 1\na: 2", KEY_TWICE, {"line": 2, "key": "a"}),
    ],
)
def test_what_ros_reads_otherwise_is_refused(
    tmp_path: Path, text: str, code: Code, values: dict[str, object]
) -> None:
    with refused(code, BadInput, **values):
        read(tmp_path, text, loader=RosLoader)


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("a: 1\na: 2", KEY_TWICE, {"line": 2, "key": "a"}),
        ("a:\n  - [", NOT_OF_FORMAT, {"line": 3, "format": "YAML"}),
        ("\x00", NOT_OF_FORMAT, {}),
    ],
)
def test_a_mistake_is_named_with_its_line(
    tmp_path: Path, text: str, code: Code, values: dict[str, object]
) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    with refused(code, BadInput, file=str(path), **values):
        read_with_lines(path)


def test_a_file_that_is_none_is_named(tmp_path: Path) -> None:
    (tmp_path / "notes.yaml").write_bytes(b"\xff\xfe\xfa")
    with refused(NOT_UTF8):
        read_with_lines(tmp_path / "notes.yaml")
    with refused(NOT_A_FILE, what="folder"):
        read_with_lines(tmp_path)
    with refused(FILE_MISSING, close="notes.yaml"):
        read_with_lines(tmp_path / "note.yaml")


def test_the_closest_entry_of_the_folder_is_named(tmp_path: Path) -> None:
    for name in ("quintic_ur5e.mat", "notes.txt", ".quintic_ur5.mat.swp"):
        (tmp_path / name).touch()
    assert close_file(tmp_path / "quintic_ur5.mat") == "quintic_ur5e.mat"
    assert close_file(tmp_path / "other.csv") is None
    assert close_file(tmp_path / "nowhere" / "notes.txt") is None
