"""An export is read by a process of its own, at whose end one archive is lost and no class."""

from __future__ import annotations

import io
import os
import signal
import zipfile

import pytest
from refusals import refused

from mrlab_ros.classroom.diagnostics import (
    LARGER_THAN_NEEDED,
    NO_EXPORT,
    NO_ZIP,
    UNPACKING_ENDED,
)
from mrlab_ros.classroom.submissions import Export


def packed(method=zipfile.ZIP_DEFLATED, **members):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", method) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return content.getvalue()


def exported(tmp_path, content):
    path = tmp_path / "export.zip"
    path.write_bytes(content)
    return path


def test_a_bomb_of_any_method_is_one_file_that_is_not_read(tmp_path):
    bombs = {
        f"{name}.zip": packed(method, **{"a.mat": bytes(1 << 27)})
        for name, method in (("bz", zipfile.ZIP_BZIP2), ("xz", zipfile.ZIP_LZMA))
    }
    path = exported(tmp_path, packed(**bombs, **{"anna.mat": b"motion"}))
    with Export(path) as found:
        assert found.read("anna.mat") == b"motion"
        for name in ("bz.zip/a.mat", "xz.zip/a.mat"):
            with refused(LARGER_THAN_NEEDED):
                found.read(name)


def test_a_file_at_which_the_process_ends_is_one_file(tmp_path):
    with Export(exported(tmp_path, packed(**{"a.mat": b"1", "b.mat": b"2"}))) as found:
        os.kill(found._process.pid, signal.SIGSEGV)
        with refused(UNPACKING_ENDED):
            found.read("a.mat")
        assert found.read("b.mat") == b"2"


def test_it_opens_the_export_and_no_other_file(tmp_path):
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "a.mat").write_bytes(bytes(65 << 20))
    (tmp_path / "class" / "b.mat").write_bytes(b"2")
    with Export(tmp_path / "class") as found:
        with refused(LARGER_THAN_NEEDED):
            found.read("a.mat")
        assert found.read("b.mat") == b"2"


@pytest.mark.parametrize("content", [b"", b"PK", b"not an archive"])
def test_what_is_no_archive_is_refused(tmp_path, content):
    with refused(NO_ZIP):
        Export(exported(tmp_path, content))
    with refused(NO_EXPORT):
        Export(tmp_path / "nowhere")
