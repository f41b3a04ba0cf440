"""Exports are read within bounds: nothing is followed, nothing leads out, nothing inflates."""

from __future__ import annotations

import io
import os
import zipfile

import pytest
from refusals import refused

from mrlab_ros.classroom import submissions
from mrlab_ros.classroom.diagnostics import LARGER_THAN_NEEDED, NO_EXPORT, NO_ZIP
from mrlab_ros.classroom.submissions import Export


def archive(**members):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return content.getvalue()


def exported(tmp_path, content):
    path = tmp_path / "export.zip"
    path.write_bytes(content)
    return Export(path)


def test_a_folder_is_read_and_links_are_told(tmp_path):
    (tmp_path / "Jörg").mkdir()
    (tmp_path / "Jörg" / "a.mat").write_bytes(b"motion")
    (tmp_path / "Jörg" / "link.mat").symlink_to("/etc/passwd")
    (tmp_path / "loop").symlink_to(tmp_path)
    os.mkfifo(tmp_path / "fifo.mat")
    with Export(tmp_path) as found:
        assert [e.path for e in found.entries] == ["Jörg/a.mat"]
        assert found.read("Jörg/a.mat") == b"motion"
        assert sorted(p for p, _ in found.problems) == ["Jörg/link.mat", "fifo.mat", "loop"]


def test_names_of_an_archive_lead_nowhere_and_umlauts_stay(tmp_path):
    content = archive(**{
        "Jörg/a.mat": b"1", "../out.mat": b"2", "/abs.mat": b"3", "C:\\x\\b.mat": b"4",
        "win\\c.mat": b"5",
    })  # fmt: skip
    # as a program writes it that does not say that its names are UTF-8
    plain = content.replace("Jörg".encode(), "Jörg".encode())
    with exported(tmp_path, plain) as found:
        assert sorted(e.path for e in found.entries) == ["Jörg/a.mat", "win/c.mat"]
        assert found.read("Jörg/a.mat") == b"1"
        assert found.read("win/c.mat") == b"5"
        assert len(found.problems) == 3


@pytest.mark.parametrize("name", ["Größe.mat".encode("cp437"), "Größe.mat".encode()])
def test_names_without_a_word_on_their_coding_are_german_all_the_same(tmp_path, name):
    stand_in = b"#" * len(name)
    content = archive(**{stand_in.decode(): b"1"}).replace(stand_in, name)
    with exported(tmp_path, content) as found:
        assert [e.path for e in found.entries] == ["Größe.mat"]
        assert found.read("Größe.mat") == b"1"


def test_an_archive_of_a_student_is_opened_once(tmp_path):
    inner = archive(**{"work/a.mat": b"motion", "deeper.zip": archive(**{"b.mat": b"2"})})
    with exported(tmp_path, archive(**{"Jane.zip": inner, "Max.zip": b"no archive"})) as found:
        assert [e.path for e in found.entries] == [
            "Jane.zip/work/a.mat", "Jane.zip/deeper.zip", "Max.zip",
        ]  # fmt: skip
        assert found.read("Jane.zip/work/a.mat") == b"motion"
        assert [path for path, _ in found.problems] == ["Max.zip"]


def test_what_inflates_too_far_is_not_read(tmp_path, monkeypatch):
    monkeypatch.setattr(submissions, "MOST_BYTES", 1000)
    monkeypatch.setattr(submissions, "MOST_INNER_BYTES", 5000)
    bomb = archive(**{f"{n}.mat": bytes(900) for n in range(9)})
    with exported(tmp_path, archive(**{"a.mat": bytes(2000), "b.zip": bomb})) as found:
        with refused(LARGER_THAN_NEEDED, file="a.mat", most=1000):
            found.read("a.mat")
        assert [(path, why.code) for path, why in found.problems] == [
            ("b.zip", "inflates_too_far")
        ]


def test_gradescopes_metadata_is_read_and_a_broken_one_told(tmp_path):
    text = (
        b"submission_1:\n  :submitters:\n  - :name: Jane\n  :created_at: 2024-01-02 03:04:05 Z\n"
    )
    with exported(tmp_path, archive(**{"e/submission_metadata.yml": text})) as found:
        assert found.metadata()["submission_1"][":submitters"] == [{":name": "Jane"}]
    text = (
        b"submission_1:\n  :submitters:\n  - :name: Jane\n    :sid: 0412346\n    :email:\n"
        b"  :created_at: !ruby/object:ActiveSupport::TimeWithZone\n"
        b"    utc: 2026-11-20 10:11:12.0 Z\n"
    )
    with exported(tmp_path, archive(**{"e/submission_metadata.yml": text})) as found:
        sent = found.metadata()["submission_1"][":submitters"]
        assert sent == [{":name": "Jane", ":sid": "0412346", ":email": ""}]
    with exported(tmp_path, archive(**{"e/submission_metadata.yml": b"a: ["})) as found:
        assert found.metadata() == {}
        assert found.problems[0][1].code == "names_not_known"


@pytest.mark.parametrize("content", [b"", b"PK", b"not an archive"])
def test_what_is_no_archive_is_refused(tmp_path, content):
    with refused(NO_ZIP):
        exported(tmp_path, content)
    with refused(NO_EXPORT):
        Export(tmp_path / "nowhere")
