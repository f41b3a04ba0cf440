"""A kind of bag is a row of the table of readers."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.bags import other
from mrlab_ros.adapters.bags.reader import Bag


class TextBag(Bag):
    """A bag of one text, which only its own reader opens."""

    def __init__(self, path: Path, installed: object) -> None:
        self.path = path


def test_a_row_opens_its_own_kind_of_bag(tmp_path: Path, monkeypatch) -> None:
    row = (lambda path: path.suffix == ".text", TextBag)
    monkeypatch.setattr(other, "READERS", [*other.READERS, row])
    assert isinstance(other.open_bag(tmp_path / "a.text", str), TextBag)
