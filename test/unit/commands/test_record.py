"""What a person may mean by a word after `mrlab record`."""

from __future__ import annotations

from pathlib import Path

import pytest

from mrlab_ros.commands.record import record
from mrlab_ros.core.errors import Misuse


@pytest.mark.parametrize(
    ("word", "meant"), [("stop", "use mrlab record --stop"), ("start", "use mrlab record,")]
)
def test_a_command_is_no_bag(word, meant):
    with pytest.raises(Misuse, match=meant):
        record(Path(word))
