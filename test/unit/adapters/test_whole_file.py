"""Files that people name are written as a whole, or what was there stays."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from mrlab_ros.adapters.whole_file import replaced, write_text
from mrlab_ros.core.base.errors import BadInput

FULL = Path("/dev/full")  # a disk without room, for every writer


def test_what_was_there_stays_until_the_new_file_is_whole(tmp_path: Path) -> None:
    page, link = tmp_path / "page.html", tmp_path / "link.html"
    page.write_text("before")
    link.symlink_to(page)

    def half() -> None:
        with replaced(page) as file:
            file.write(b"half")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.raises(OSError, match=r"page\.html"):
        half()
    assert page.read_text() == "before"
    write_text(link, "after")
    assert (page.read_text(), link.is_symlink()) == ("after", True)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["link.html", "page.html"]


def test_a_device_is_written_as_it_is_and_a_full_disk_says_what_helps(tmp_path: Path) -> None:
    link = tmp_path / "page.html"
    link.symlink_to(FULL)
    for place, remedy in ((link, "room"), (tmp_path, None), (tmp_path / ("x" * 300), None)):
        with pytest.raises(BadInput) as caught:
            write_text(place, "text")
        found = caught.value.diagnostic
        assert (found.code, found.values["file"]) == ("file_unwritable", str(place))
        assert found.values.get("remedy") == remedy
    assert FULL.is_char_device()
    write_text(tmp_path / "new" / "page.html", "text")
