"""A parameter file is checked as a whole before any process starts with it."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from mrlab_ros.core.base.checks import checked
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.records import fields_of
from mrlab_ros.nodes.parameters import NODES
from mrlab_ros.processes.parameter_file import check_parameter_file

SHIPPED = Path(__file__).parents[3] / "config" / "lab.yaml"


def check(folder: Path, text: str) -> None:
    path = folder / "lab.yaml"
    path.write_text(text)
    check_parameter_file(path)


def test_the_shipped_file_names_every_parameter_with_its_default() -> None:
    check_parameter_file(SHIPPED)
    document = yaml.safe_load(SHIPPED.read_text())
    common = document.pop("/**")["ros__parameters"]
    seen = {}
    for node, section in document.items():
        values = section["ros__parameters"]
        records = {record.name: record for record in fields_of(NODES[node]).values()}
        for name, record in records.items():
            shown = values.get(name, common.get(name))
            assert shown is not None, f"{node}: {name} is not in config/lab.yaml"
            assert checked(name, shown, record.check) == record.default, f"{node}: {name}"
        seen[node] = records
    for node, kind in NODES.items():
        left = {record.name for record in fields_of(kind).values()} - set(common)
        assert node in seen or not left, f"{node} is not in config/lab.yaml"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "lab: {ros__parameters: {robots: ['']}}",
        "/lab: {ros__parameters: {robots: [ur5e]}}",
        "/**/lab: {ros__parameters: {robots: [ur5e]}}",
        "playback_host: {ros__parameters: {telemetry_rate: 5, staging: {jerk: 2.0}}}",
        "playback_host: {ros__parameters: {telemetry_rate: 1e1}}",
        "/**: {ros__parameters: {split_size: 5, use_sim_time: false}}",
        "lab: {ros__parameters: {qos_overrides: {/robots: {publisher: {depth: 2}}}}}",
    ],
)
def test_what_ros_takes_is_taken(tmp_path: Path, text: str) -> None:
    check(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("lab: 5", "lab is 5; expected a mapping with the fields ros__parameters"),
        ("lab: {robots: [ur5e]}", "lab: 'robots' is unknown; expected ros__parameters"),
        ("lab: {ros__parameters: 5}", "lab: ros__parameters is 5; expected a mapping"),
        ("labb: {ros__parameters: {}}", "no such node in the lab; .* Did you mean 'lab'"),
        ("lab: {ros__parameters: {robot: [ur5e]}}", "Did you mean 'robots'"),
        ("lab: {ros__parameters: {split_size: 5}}", "lab: 'split_size' is unknown; expected"),
        ("/**: {ros__parameters: {split_sise: 5}}", "Did you mean 'split_size'"),
        ("/**: {ros__parameters: {split_size: -5}}", "split_size is -5; expected a whole number"),
        ("playback_host: {ros__parameters: {staging: {jerk: -1}}}", "staging.jerk is -1"),
        ("lab: [", "cannot be read"),
        ("lab: &a {ros__parameters: {}}\n/lab: *a", r"is an alias, which ROS does not read"),
        ("lab: {}\nlab: {}", "'lab' is there twice"),
        ("recorder: {ros__parameters: {split_size: 1_024}}", "split_size is '1_024'; expected"),
        ("recorder: {ros__parameters: {split_size: 2026-01-01}}", "is '2026-01-01'; expected"),
        ("recorder: {ros__parameters: {split_size: 1:30}}", "is '1:30'; expected a whole"),
    ],
)
def test_a_mistake_is_named_with_its_section(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(BadInput, match=says):
        check(tmp_path, text)


def test_the_mistakes_of_all_sections_are_named_at_once(tmp_path: Path) -> None:
    with pytest.raises(BadInput) as caught:
        check(
            tmp_path,
            "playback_host: {ros__parameters: {telemetry_rate: 0, standing_rate: .nan}}\n"
            "recorder: {ros__parameters: {split_size: -5}}\n",
        )
    assert "lab.yaml has 3 mistakes:" in str(caught.value)
    for words in ("telemetry_rate is 0", "standing_rate is nan", "split_size is -5"):
        assert words in str(caught.value)
