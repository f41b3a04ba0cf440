"""Tables for gradebooks, pseudonyms, and the document of a class."""

from __future__ import annotations

import csv
import io
import json

import pytest
from refusals import refused

from mrlab_ros.classroom.marks import changes, gradebook
from mrlab_ros.classroom.marks.diagnostics import NO_FILE_HANDED_IN, NO_WORKSHEET
from mrlab_ros.classroom.marks.exports import Entry, recognise
from mrlab_ros.classroom.marks.graded import GradedClass, Student
from mrlab_ros.classroom.marks.matching import enrolled
from mrlab_ros.classroom.marks.result import MARKED, NO_FILE, Result, pseudonymous, without_marks
from mrlab_ros.classroom.rubrics.diagnostics import NOTHING_TOUCHED
from mrlab_ros.classroom.rubrics.marking import Mark, Marks
from mrlab_ros.classroom.rubrics.rubric import Outcome, Rubric, Test
from mrlab_ros.core.base.diagnostic import plain

FOUND = NOTHING_TOUCHED()


class Never:
    def assess(self, checked, reference):
        return Outcome(0.0, FOUND)


RUBRIC = Rubric(
    "Task <1>",
    (
        Test("no collision", "no collision", Never(), 6.0, "look at the table"),
        Test("secret", "cycle < 8 s", Never(), 4.0, "be quicker", hidden=True),
    ),
    robot="ur5e",
)
PATHS = [f"{n}_{i}_assignsubmission_file_/a.mat" for n, i in (("=cmd()", 11), ("Jörg", 12))]


def graded(points=(6.0, 0.0)):
    roster = recognise([Entry(p) for p in PATHS], (".mat",))
    marks = Marks(
        (
            Mark("no collision", points[0], 6.0, points[0] == 6.0, FOUND, time=1.5),
            Mark("secret", points[1], 4.0, points[1] == 4.0, FOUND, "be quicker", True),
        )
    )
    result = Result(MARKED, plain(FOUND), marks.plain(), marks.public().plain(), "a.mat", "digest")
    results = [result, without_marks(RUBRIC, NO_FILE, NO_FILE_HANDED_IN())]
    pairs = zip(roster.submissions, results, strict=True)
    return GradedClass(RUBRIC, "Moodle", tuple(Student(s, r) for s, r in pairs))


def filled(template, students, title=""):
    """Return a filled table, its problems, and who is in none of its rows."""
    sheet = gradebook.Sheet(template, "s.csv", title)
    places, missing = enrolled([s.submission for s in students], sheet.people, {})
    return *sheet.filled(students, places), [each.what for each in missing]


@pytest.mark.parametrize("name", ["a;=1+1;b.mat", "a\t+1", "=1", 'x;"@SUM(1)', "\uff1d1"])
def test_no_cell_is_a_formula_whatever_parts_the_cells(name):
    shown = gradebook.cell(name)
    for delimiter in ",;\t":
        row = next(csv.reader(io.StringIO(shown), delimiter=delimiter))
        assert not [one for one in row if one.lstrip()[:1] in ("=", "+", "-", "@", "\uff1d")]


def test_a_table_is_opened_by_excel_and_computes_nothing():
    text = gradebook.table(RUBRIC, graded().students)
    assert text.startswith("\ufeff")
    rows = list(csv.DictReader(io.StringIO(text.removeprefix("\ufeff"))))
    assert [row["name"] for row in rows] == ["'=cmd()", "Jörg"]
    assert [row["points"] for row in rows] == ["6", "0"]
    assert rows[0]["secret"] == "0"


def test_another_maximum_of_moodle_is_said_once():
    rows = ["Identifier,Grade,Maximum Grade", "Participant 11,,100", "Participant 12,,100"]
    _, problems, _ = filled("\n".join(rows), graded().students)
    assert len(problems) == 1
    assert problems[0].code == "maximum_differs"
    assert problems[0].values == {"found": "100", "points": 10.0}


@pytest.mark.parametrize(
    ("head", "rows", "grades"),
    [
        (
            "Identifier,Full name,Grade,Maximum Grade,Feedback comments",
            ["Participant 11,=x,,10,", "Participant 99,Y,3,10,"],
            ["6", "3"],
        ),
        (
            "ID;Vollständiger Name;Bewertung;Bestwertung",
            ["Teilnehmer/in11;Jörg;;10,00", "Teilnehmer/in12;Z;;10,00"],
            ["6", "0"],
        ),
    ],
)
def test_moodles_worksheet_is_filled_by_its_identifiers(head, rows, grades):
    template = "\ufeff" + "\r\n".join([head, *rows]) + "\r\n"
    text, _, missing = filled(template, graded().students)
    delimiter = ";" if ";" in head else ","
    found = list(csv.reader(io.StringIO(text.removeprefix("\ufeff")), delimiter=delimiter))
    place = head.split(delimiter).index("Grade" if "Grade" in head else "Bewertung")
    assert [row[place] for row in found[1:]] == grades
    assert [row[1] for row in found[1:]] == [row.split(delimiter)[1] for row in rows]
    assert missing == ([] if delimiter == ";" else ["joerg-12"])
    if delimiter == ",":
        assert "secret" not in found[1][4]
        assert "be quicker" in found[1][4]


def test_another_maximum_is_said_and_what_is_no_worksheet_refused():
    template = "Identifier,Grade,Maximum Grade\nParticipant 11,,100\nParticipant 12,,10\n"
    _, problems, _ = filled(template, graded().students)
    assert problems[0].code == "maximum_differs"
    assert problems[0].values == {"found": "100", "points": 10.0}
    with refused(NO_WORKSHEET, file="s.csv", columns=["a", "b"]):
        filled("a,b\n1,2\n", graded().students)


def test_who_could_not_be_marked_is_told_why_once_and_what_a_teacher_gives():
    student = graded().students[1]
    why = str(NO_FILE_HANDED_IN())
    assert gradebook.comment(student.result) == why
    given = changes.applied(student, {"no collision": 2.0}, "See me")
    assert gradebook.comment(given.result) == f"{why}\nno collision: 2 of 6\nSee me"
    shown = GradedClass(RUBRIC, "folder", (given,)).document()["students"][0]
    assert gradebook.words_of(shown) == (
        f"2 of 10 points. {why}\n\nno collision: 2 of 6\nSee me\n"
    )


def test_gradescope_hides_what_is_hidden():
    found = gradebook.gradescope(graded().students[0].result)
    assert found["score"] == 6.0
    one, other = found["tests"]
    assert (one["visibility"], one["max_score"], one["status"]) == ("visible", 6.0, "passed")
    assert (other["visibility"], other["score"]) == ("hidden", 0.0)
    assert "secret" not in found["output"]
    assert "be quicker" in found["output"]


def test_the_document_of_a_class_is_json_and_its_figures_are_right():
    found = json.loads(json.dumps(graded().document()))
    assert found["schema"] == "mrlab.class.1"
    assert found["statistics"]["mean"] == 3.0
    assert found["statistics"]["bins"] == [1, 0, 0, 0, 0, 0, 1, 0, 0, 0]
    assert [t["name"] for t in found["statistics"]["tests"]] == ["secret", "no collision"]
    assert found["students"][1]["outcome"] == NO_FILE


def test_pseudonyms_are_stable_and_say_nothing():
    roster = recognise([Entry(p) for p in PATHS], (".mat",))
    changed, who = pseudonymous(roster, b"secret")
    assert pseudonymous(roster, b"secret")[0] == changed
    assert pseudonymous(roster, b"other")[0] != changed
    assert {s.name for s in who.values()} == {"=cmd()", "Jörg"}
    for one in changed.submissions:
        shown = (one.key, one.name, one.identifier, one.folder, one.email, *one.others, *one.notes)
        assert not any(
            word in str(text) for text in shown for word in ("Jörg", "joerg", "11", "12")
        )
    fewer = recognise([Entry(PATHS[1])], (".mat",))
    assert pseudonymous(fewer, b"secret")[0].submissions[0] in changed.submissions


@pytest.mark.parametrize(
    ("form", "paths", "sheet", "grades", "others"),
    [
        (
            "Canvas",
            ["doejane_11_700_a.mat", "roemax_12_701_a.mat"],
            "Student,ID,SIS Login ID,Section,Task <1> (55),Other (56)\n"
            "    Points Possible,,,,10,3\n"
            '"Doe, Jane",11,jdoe,A,,1\n"Roe, Max",12,mroe,A,7,2\n',
            ["10", "6", "0"],
            ["3", "1", "2"],
        ),
        (
            "ILIAS",
            ["Abgaben/Doe_Jane_jdoe_70/a.mat", "Abgaben/Roe_Max_m5roe_71/a.mat"],
            "update;usr_id;login;lastname;firstname;status;mark;notice;comment\n"
            "0;300;jdoe;Doe;Jane;notgraded;;;\n0;301;m5roe;Roe;Max;notgraded;;;\n",
            ["6", "0"],
            ["1", "1"],
        ),
    ],
)
def test_tables_of_other_platforms_are_filled(form, paths, sheet, grades, others):
    roster = recognise([Entry(path) for path in paths], (".mat",))
    assert roster.form == form
    results = [student.result for student in graded().students]
    students = [Student(s, r) for s, r in zip(roster.submissions, results, strict=True)]
    text, problems, missing = filled(sheet, students, "Task <1>")
    assert problems == missing == []
    rows = list(csv.reader(io.StringIO(text), delimiter=";" if form == "ILIAS" else ","))
    grade, other = (4, 5) if form == "Canvas" else (6, 0)
    assert [row[grade] for row in rows[1:]] == grades
    assert [row[other] for row in rows[1:]] == others
    if form == "ILIAS":
        assert "no collision: 6 of 6" in rows[1][8]
    with refused(NO_WORKSHEET):
        filled(sheet.replace("mark", "m").replace("Task <1>", "T"), students, "X")
