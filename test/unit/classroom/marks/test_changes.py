"""Marks that a teacher changed in the table are found, kept and shown everywhere."""

from __future__ import annotations

import pytest

from mrlab_ros.classroom.marks import changes, gradebook
from mrlab_ros.classroom.marks.exports import Submission
from mrlab_ros.classroom.marks.graded import GradedClass, Student
from mrlab_ros.classroom.marks.result import MARKED, TO_REPEAT, Result, without_marks
from mrlab_ros.classroom.rubrics.diagnostics import NOTHING_TOUCHED
from mrlab_ros.classroom.rubrics.marking import Mark, Marks
from mrlab_ros.classroom.rubrics.rubric import Outcome, Rubric, Test
from mrlab_ros.core.base.diagnostic import plain

FOUND = NOTHING_TOUCHED()


class Never:
    def assess(self, checked, reference):
        return Outcome(0.0, FOUND)


RUBRIC = Rubric("task", (Test("a; b", "x", Never(), 6.0), Test("+quick", "y", Never(), 4.0)))


def student(key, first, second):
    marks = Marks(
        (
            Mark("a; b", first, 6.0, first == 6.0, FOUND),
            Mark("+quick", second, 4.0, second == 4.0, FOUND, hidden=True),
        )
    )
    result = Result(MARKED, plain(FOUND), marks.plain(), marks.public().plain())
    return Student(Submission(key, key.title(), "folder"), result)


STUDENTS = (student("anna", 6.0, 1.5), student("ben", 0.0, 4.0))
DOCUMENT = GradedClass(RUBRIC, "folder", STUDENTS).document()


def table(students=STUDENTS):
    return gradebook.table(RUBRIC, students)


@pytest.mark.parametrize("other_program", [False, True])
def test_a_table_as_it_was_written_holds_no_change(other_program):
    text = table()
    if other_program:
        text = text.replace("a; b", "a b").replace(",", ";").replace("1.5", "1,5")
    assert changes.found(text, DOCUMENT) == ({}, [])


def test_changes_are_found_and_hold():
    text = table().replace("Anna,,,no,7.5,10,marked,,6,1.5", "Anna,,,no,9,10,marked,,5,x")
    text = text.replace("Ben,,,no,4,10,marked,,0,4", 'Ben,,,no,4,10,marked,,"2,5",4')
    found, problems = changes.found(text, DOCUMENT)
    assert found == {"anna": {"points": 9.0, "a; b": 5.0}, "ben": {"a; b": 2.5}}
    assert [(p.code, p.values["found"]) for p in problems] == [("changed_mark_not_read", "x")]
    anna, ben = (changes.applied(s, found[s.key], "Well done") for s in STUDENTS)
    assert (anna.result.points, ben.result.points) == (9.0, 6.5)
    assert [m["points"] for m in ben.result.public["tests"]] == [2.5]
    assert (ben.result.public["points"], ben.result.public["hints"]) == (6.5, ["Well done"])
    assert [n.code for n in anna.submission.notes] == ["changed_mark", "changed_mark"]
    # the next run finds nothing new, and knows what the tests gave
    shown = (anna, ben)
    document = GradedClass(RUBRIC, "folder", shown).document()
    assert changes.found(table(shown), document) == ({}, [])
    given = [changes.given_of(s) for s in document["students"]]
    assert given == [changes.columns_of(s) for s in DOCUMENT["students"]]


def test_points_that_cannot_be_had_are_refused():
    tests = (
        Mark("a; b", 6.0, 6.0, True, FOUND),
        Mark("more", 1.0, 2.0, False, FOUND, bonus=True),
        Mark("Late", -1.0, 0.0, False, FOUND),
    )
    marks = Marks(tests).plain()
    rubric = Rubric("task", tuple(Test(t.name, "x", Never(), t.of, bonus=t.bonus) for t in tests))
    anna = Student(
        Submission("anna", "Anna", "folder"), Result(MARKED, plain(FOUND), marks, marks)
    )
    document, text = (
        GradedClass(rubric, "folder", (anna,)).document(),
        gradebook.table(rubric, (anna,)),
    )
    had = ",6,6,marked,,6,1,-1,"
    assert had in text

    def refused(*row):
        found, problems = changes.found(
            text.replace(had, ",{},6,marked,,{},{},{},".format(*row)), document
        )
        assert {p.code for p in problems} <= {"changed_mark_out_of_range"}
        said = [(p.values["test"], p.values["least"], p.values["most"]) for p in problems]
        return found.get("anna", {}), said

    every = {"points": 8.0, "a; b": 0.0, "more": 2.0, "Late": -8.0}
    assert refused(8, 0, 2, -8) == (every, [])
    ranges = [("a; b", 0, 6), ("more", 0, 2), ("Late", -8, 0), ("points", 0, 8)]
    for row in ((99, 6.5, 2.5, 1), (-3, -3, -0.5, -9)):
        assert refused(*row) == ({}, ranges)


def test_what_the_test_gave_comes_back():
    marks = STUDENTS[1].result.marks
    changed = changes.marks(marks, {"a; b": 2.0, "points": 9.0, "a test of old": 3.0})
    assert (changed["points"], changed["given"]) == (9.0, 4.0)
    assert changes.marks(changed, {}) == marks
    assert changes.marks(changed, {"a; b": 0.0}) == marks


def test_who_is_to_be_repeated_has_no_mark_and_no_share_in_the_mean():
    again = Student(STUDENTS[1].submission, without_marks(RUBRIC, TO_REPEAT, FOUND))
    rows = table((STUDENTS[0], again)).splitlines()
    assert "Ben,,,no,,10,to_repeat,,,," in rows[2]
    assert GradedClass(RUBRIC, "folder", (STUDENTS[0], again)).statistics().mean == 7.5
    moodle = Student(Submission("ben", "Ben", "Moodle", "2"), again.result)
    sheet = "Identifier,Grade\nParticipant 2,\n"
    filled, problems = gradebook.Sheet(sheet, "sheet.csv").filled(
        [moodle], {"ben": "Participant 2"}
    )
    assert filled.splitlines()[1] == "Participant 2,"
    assert [p.code for p in problems] == ["grade_to_repeat"]
