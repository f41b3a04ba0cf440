"""Files and students that could not be matched: proposals, decisions and what becomes of them."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.classroom.marks.diagnostics import UNKNOWN_MATCH
from mrlab_ros.classroom.marks.exports import Entry, Submission, recognise
from mrlab_ros.classroom.marks.journal import ASSIGN, ENROL
from mrlab_ros.classroom.marks.matching import (
    Person,
    assigned,
    decided,
    enrolled,
    files,
    nearest,
)

PEOPLE = [
    Person("jane-doe-11", "Jane Doe", "11"),
    Person("joerg-gross-1234", "Jörg Groß", "1234"),
    Person("max-mueller-13", "Max Müller", "13"),
    Person("mia-mueller-14", "Mia Müller", "14"),
    Person("doejohn-15", "doejohn", "15"),
    Person("名前-16", "名前", "16"),
]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("lab2/jane_doe_final", "Jane Doe"),
        ("Doe, J", "Jane Doe"),
        ("jnae doe", "Jane Doe"),
        ("janedoe", "Jane Doe"),
        ("Jane Do run", "Jane Doe"),
        ("JOERG-GROSS", "Jörg Groß"),
        ("Jorg Gross", "Jörg Groß"),
        ("abgabe 1234", "Jörg Groß"),
        ("m mueller", None),  # two of them
        ("mueller", None),
        ("Maxx Müller", "Max Müller"),
        ("john doe", "doejohn"),
        ("名前", "名前"),
        ("run", None),
        ("", None),
    ],
)
def test_the_nearest_is_proposed_and_nobody_where_it_may_be_two(text, name):
    found = nearest(text, PEOPLE)
    assert (found and found.name) == name


def roster():
    paths = [
        "Jane Doe_11_assignsubmission_file_/run.mat",
        "Max Roe_12_assignsubmission_file_/run.mat",
        "late/doe_jane.mat",
        "late/doe_jane.csv",
        "mail/x7.mat",
        "mail/read me.pdf",
    ]
    return recognise([Entry(p) for p in paths], (".mat", ".csv"), form="Moodle")


def test_files_of_nobody_have_proposals_and_go_where_a_teacher_says():
    found = roster()
    people = [Person(s.key, s.name, s.identifier) for s in found.submissions]
    unmatched, rest = files(found.left_out, {}, people)
    assert [e.path for e in rest] == ["mail/read me.pdf"]
    assert [(e.what, e.proposal) for e in unmatched] == [
        ("late", "jane-doe-11"),
        ("mail/x7.mat", ""),
    ]
    acts = decided(unmatched, {}, people, [], [("mail/x7.mat", "mail/x7.mat")], accepts=True)
    assert acts == [
        (ASSIGN, "jane-doe-11", "late"),
        (ASSIGN, "mail-x7-mat", "mail/x7.mat"),
    ]
    owners = {file: key for _, key, file in acts}
    after = assigned(found, owners, people)
    jane, own, max_ = after.submissions
    assert [e.path for e in jane.candidates] == [
        "late/doe_jane.csv", "late/doe_jane.mat", "Jane Doe_11_assignsubmission_file_/run.mat",
    ]  # fmt: skip
    assert (own.key, max_.key) == ("mail-x7-mat", "max-roe-12")
    assert files(after.left_out, owners, people) == ([], rest)
    nobody = assigned(found, {"late": "", "mail/x7.mat": "../../reference"}, people)
    assert {s.key for s in nobody.submissions} == {"jane-doe-11", "max-roe-12", "reference-1"}
    with refused(UNKNOWN_MATCH, found="late", near=None):
        decided([], {}, people, [], [("late", "Jane Doe")], accepts=False)
    with refused(UNKNOWN_MATCH, found="Jane Do", near="Jane Doe"):
        decided(unmatched, {}, people, [], [("late", "Jane Do")], accepts=False)


def students(*named: tuple[str, str]):
    return [Submission(n.lower(), n, "", identifier) for n, identifier in named]


def test_rows_are_found_by_number_then_by_a_name_that_one_alone_has():
    rows = [
        Person("", "Jane Doe", "Participant 11"),
        Person("", "Max Roe", "Participant 12"),
        Person("", "Anna Li", "Participant 13"),
        Person("", "Anna Li", "Participant 14"),
        Person("", "Ben Ott", "Participant 15"),
    ]
    there = students(("Doe Jane", ""), ("Renamed", "12"), ("Anna Li", ""), ("Ben Otto", "99"))
    places, missing = enrolled(there, rows, {})
    assert places == {"doe jane": "Participant 11", "renamed": "Participant 12"}
    assert [(e.what, e.proposal) for e in missing] == [
        ("anna li", ""), ("ben otto", "Participant 15"),
    ]  # fmt: skip
    people = [Person(s.key, s.name, s.identifier) for s in there]
    acts = decided(missing, {}, people, rows, [("Anna Li", "14")], accepts=True)
    assert (ENROL, "ben otto", "Participant 15") in acts
    # a row has one student, and what was chosen comes first
    places, missing = enrolled(there, rows, {"ben otto": "Participant 11", "anna li": ""})
    assert places["ben otto"] == "Participant 11"
    assert places["anna li"] == ""
    assert [e.what for e in missing] == ["doe jane"]
