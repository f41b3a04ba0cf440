"""The commands of robots: what they offer where a description is refused."""

from __future__ import annotations

from pathlib import Path

from refusals import refused

from mrlab_ros.adapters.robots.importing.diagnostics import ARMS_BRANCH
from mrlab_ros.commands import robots


def joint(name: str, parent: str, child: str) -> str:
    return (
        f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        '<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>'
        f'<link name="{child}"/>'
    )


def test_a_description_of_two_arms_is_imported_by_the_command_that_is_offered(tmp_path: Path):
    arms = [
        joint(f"{side}_{i}", f"{side}{i}" if i else "base", f"{side}{i + 1}")
        for side in "lr"
        for i in range(6)
    ]
    file = tmp_path / "two arms.urdf"
    file.write_text(f'<robot name="two"><link name="base"/>{"".join(arms)}</robot>')
    with refused(ARMS_BRANCH, first=6, second=6, tip="l6") as caught:
        robots.import_robot([str(file)], robot_id="two")
    (fix,) = caught.value.diagnostic.fixes
    assert fix.command == f"mrlab robots import '{file}' --id two --tip l6"
