"""Decisions of a teacher are kept in the journal; with pseudonyms no name gets into the folder."""

from __future__ import annotations

import errno
import os

from refusals import refused

from mrlab_ros.adapters.diagnostics import FILE_UNWRITABLE
from mrlab_ros.classroom import pseudonyms
from mrlab_ros.classroom.journal_file import JournalFile
from mrlab_ros.classroom.marks.exports import Entry, recognise
from mrlab_ros.classroom.marks.gradebook import Sheet
from mrlab_ros.classroom.marks.journal import Entry as Act
from mrlab_ros.classroom.who import Decisions, matched

PATHS = [
    "Jane Doe_11_assignsubmission_file_/run.mat",
    "Max Roe_12_assignsubmission_file_/run.mat",
    "doe jane.mat",
]
SHEET = "Identifier,Full name,Grade\nParticipant 11,Jane Doe,\nParticipant 77,Max Roe,\n"


def test_what_is_decided_holds_in_the_next_run(tmp_path):
    roster = recognise([Entry(path) for path in PATHS], (".mat",))
    sheet, journal = Sheet(SHEET, "s.csv"), JournalFile(tmp_path)
    first = matched(roster, sheet, journal.state(), journal, Decisions())
    assert [(e.kind, e.what, e.proposed) for e in first.unmatched] == [
        ("file", "doe jane.mat", "Jane Doe"), ("student", "max-roe-12", "Max Roe"),
    ]  # fmt: skip
    assert [row.identifier for row in first.rows] == ["Participant 77"]
    for decisions in (Decisions(accepts=True), Decisions()):
        found = matched(roster, sheet, journal.state(), journal, decisions)
        assert found.unmatched == found.rows == ()
        assert found.places == {"jane-doe-11": "Participant 11", "max-roe-12": "Participant 77"}
        assert len(found.roster.submissions[0].candidates) == 2
    decided = Decisions((("doe jane.mat", ""), ("Max Roe", "")))
    found = matched(roster, sheet, journal.state(), journal, decided)
    assert (found.places["max-roe-12"], found.unmatched) == ("", ())
    assert [e.path for e in found.roster.left_out] == ["doe jane.mat"]


def test_acts_for_which_the_disk_has_no_room_are_not_kept_in_part(tmp_path, monkeypatch):
    journal = JournalFile(tmp_path)
    acts = [Act(1.0, "teacher", "comment", "anna", text=text) for text in ("good", "bad")]
    journal.append(lambda _: acts[:1])
    before = journal.path.read_bytes()

    def full(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", full)
        with refused(FILE_UNWRITABLE) as caught:
            journal.append(lambda _: acts)
    assert (caught.value.diagnostic.values["remedy"], journal.path.read_bytes()) == (
        "room",
        before,
    )


def test_with_pseudonyms_the_journal_and_what_is_shown_name_nobody(tmp_path):
    roster = recognise([Entry(path) for path in PATHS], (".mat",))
    hidden = pseudonyms.of_roster(roster, tmp_path / "out")
    sheet, journal = Sheet(SHEET, "s.csv"), JournalFile(tmp_path)
    first = matched(hidden.roster, sheet, journal.state(), journal, Decisions(), hidden)
    (file,) = first.unmatched
    jane = next(name for name, one in hidden.who.items() if one.name == "Jane Doe")
    assert (file.proposed, first.rows) == (jane, ())
    shown = f"{first.unmatched} {first.roster.left_out}"
    found = matched(
        hidden.roster, sheet, journal.state(), journal, Decisions(accepts=True), hidden
    )
    assert found.unmatched == ()
    assert [e.values["student"] for e in found.missing] == ["Max Roe"]  # for the terminal alone
    shown += journal.path.read_text() + str([s.notes for s in found.roster.submissions])
    assert not any(word in shown.lower() for word in ("jane", "doe", "roe", "77"))
