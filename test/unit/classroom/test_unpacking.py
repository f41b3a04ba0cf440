"""Exports are read within bounds: nothing is followed, nothing leads out, nothing inflates."""

from __future__ import annotations

import io
import os
import zipfile

import pytest
from refusals import refused

from mrlab_ros.classroom import unpacking
from mrlab_ros.classroom.diagnostics import (
    LARGER_THAN_NEEDED,
    LINK_NOT_FOLLOWED,
    NAME_LEADS_OUT,
    NO_EXPORT,
    NO_ORDINARY_FILE,
    NO_ZIP,
    NOT_UNPACKED,
)
from mrlab_ros.classroom.unpacking import Contents


def archive(**members):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return content.getvalue()


def exported(tmp_path, content):
    path = tmp_path / "export.zip"
    path.write_bytes(content)
    return Contents(path)


def test_a_folder_is_read_and_links_are_told(tmp_path):
    (tmp_path / "Jörg").mkdir()
    (tmp_path / "Jörg" / "a.mat").write_bytes(b"motion")
    (tmp_path / "Jörg" / "link.mat").symlink_to("/etc/passwd")
    (tmp_path / "loop").symlink_to(tmp_path)
    os.mkfifo(tmp_path / "fifo.mat")
    with Contents(tmp_path) as found:
        files = ["fifo.mat", "Jörg/a.mat", "Jörg/link.mat"]
        assert [e.path for e in found.entries] == files
        assert found.read("Jörg/a.mat") == b"motion"
        with refused(LINK_NOT_FOLLOWED):
            found.read("Jörg/link.mat")
        with refused(NO_ORDINARY_FILE):
            found.read("fifo.mat")
        assert sorted(p for p, _ in found.problems) == ["Jörg/link.mat", "fifo.mat", "loop"]


def test_names_of_an_archive_lead_nowhere_and_umlauts_stay(tmp_path):
    content = archive(**{
        "Jörg/a.mat": b"1", "../out.mat": b"2", "/abs.mat": b"3", "C:\\x\\b.mat": b"4",
        "win\\c.mat": b"5",
    })  # fmt: skip
    # as a program writes it that does not say that its names are UTF-8
    plain = content.replace("Jörg".encode(), "Jörg".encode())
    with exported(tmp_path, plain) as found:
        paths = ["Jörg/a.mat", "abs.mat", "out.mat", "win/c.mat", "x/b.mat"]
        assert sorted(e.path for e in found.entries) == paths
        with refused(NAME_LEADS_OUT):
            found.read("out.mat")
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


def packed(name, method):
    """Return an archive of 1 MiB of zeros, compressed by a method of the ZIP format."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", method) as file:
        file.writestr(name, bytes(1 << 20))
    return content.getvalue()


def test_every_hostile_member_is_an_entry_that_says_why_it_is_not_read(tmp_path):
    nameless = archive(**{"#": b"1"}).replace(b"#", b"/")
    damaged = packed("b.mat", zipfile.ZIP_LZMA)
    torn = bytearray(archive(**{"c.mat": bytes(range(256)) * 9}))
    torn[60:90] = bytes(30)
    outer = archive(**{
        "Anna.zip": nameless, "Ben.zip": packed("a.mat", zipfile.ZIP_BZIP2), "Cem.zip": damaged,
        "Dora.zip": bytes(torn), f"{'e' * 300}/{'e' * 300}.mat": b"2", "Fe\nfe/a.mat": b"3",
        "../Path Trav_1_assignsubmission_file_/a.mat": b"4",
    })  # fmt: skip
    with exported(tmp_path, outer) as found:
        whole = {entry.path for entry in found.entries}
        for path, why in (
            ("Dora.zip/c.mat", NOT_UNPACKED), ("Path Trav_1_assignsubmission_file_/a.mat",
            NAME_LEADS_OUT),
        ):  # fmt: skip
            assert path in whole
            with refused(why):
                found.read(path)
        assert len(found.read("Ben.zip/a.mat")) == len(found.read("Cem.zip/b.mat")) == 1 << 20
        assert found.read("Fe\nfe/a.mat") == b"3"
        assert found.read(f"{'e' * 300}/{'e' * 300}.mat") == b"2"


def test_a_member_without_a_name_is_an_entry(tmp_path):
    content = archive(x=b"1")
    # the central directory and the member itself say that the name has no character
    start = content.index(b"PK\x01\x02")
    local = content[:26] + bytes(2) + content[28:30] + content[31:start]
    central = content[start : start + 28] + bytes(2) + content[start + 30 : start + 46]
    end = content[content.index(b"PK\x05\x06") :]
    size, offset = len(central), len(local)
    end = end[:12] + size.to_bytes(4, "little") + offset.to_bytes(4, "little") + end[20:]
    with exported(tmp_path, local + central + end) as found:
        assert [e.path for e in found.entries] == [unpacking.NAMELESS]
        with refused(NAME_LEADS_OUT):
            found.read(unpacking.NAMELESS)


def test_folders_whose_bytes_are_no_text_stay_apart(tmp_path):
    for byte in (b"\xe4", b"\xf6"):
        folder = os.path.join(os.fsencode(tmp_path), b"M" + byte)
        os.mkdir(folder)
        with open(os.path.join(folder, b"a.mat"), "wb") as file:
            file.write(byte)
    with Contents(tmp_path) as found:
        assert sorted(found.read(e.path) for e in found.entries) == [b"\xe4", b"\xf6"]


def test_what_inflates_too_far_is_not_read(tmp_path, monkeypatch):
    monkeypatch.setattr(unpacking, "MOST_BYTES", 1000)
    monkeypatch.setattr(unpacking, "MOST_INNER_BYTES", 5000)
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
        Contents(tmp_path / "nowhere")
