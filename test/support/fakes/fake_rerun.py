"""Stands for Rerun's SDK in tests: keeps what is sent to it, and writes a file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any
from unittest.mock import MagicMock

import pytest


def fake_rerun(monkeypatch: pytest.MonkeyPatch) -> MagicMock:
    """Put an SDK in the place of Rerun's."""
    made = MagicMock()
    made.RecordingStream.return_value.save.side_effect = lambda path: Path(path).write_text("rrd")
    made.Scalars.columns.side_effect = lambda scalars: scalars
    body = made.urdf.UrdfTree.from_file_path.return_value
    body.name, body.root_link.return_value.name = "ur5e", "base_link"
    for name in ("blueprint", "urdf"):
        monkeypatch.setitem(sys.modules, f"rerun.{name}", getattr(made, name))
    monkeypatch.setitem(sys.modules, "rerun", made)
    return made


def sent(sdk: MagicMock) -> dict[str, Any]:
    """Return the columns that were sent, by entity."""
    return {call.args[0]: call.args[2] for call in sdk.send_columns.call_args_list}
