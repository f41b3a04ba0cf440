"""A lab with physics as a student runs it: load a scene, play the hand-over, look at the rod."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from launched_lab import done, launched_lab

CELL = Path(__file__).parents[2] / "examples" / "handover_cell.yaml"


@pytest.fixture
def lab(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    with launched_lab(tmp_path, monkeypatch, "--physics", "--no-bridge"):
        yield


def rod_after_the_hand_over() -> dict[str, Any]:
    done("scene", "load", "handover")
    done("system", "create", str(CELL))
    assert "handover: PLAYING" in done("system", "play", "handover")
    (rod,) = json.loads(done("objects", "list", "--json"))
    return rod


def test_a_student_hands_a_rod_over(lab: None) -> None:
    rod = rod_after_the_hand_over()
    assert (rod["name"], rod["held_by"]) == ("rod_1", "")
    assert rod["position"] == pytest.approx([0.817, -0.321, 0.08], abs=0.01)
