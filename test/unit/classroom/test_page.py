"""A graded class as a document of its page."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import orjson

from mrlab_ros.app.show.page import Code, page
from mrlab_ros.classroom.marks.diagnostics import NO_FILE_HANDED_IN, NO_MOTION_FILE
from mrlab_ros.classroom.marks.exports import Entry, LeftOut, recognise, renamed
from mrlab_ros.classroom.marks.graded import GradedClass, Student
from mrlab_ros.classroom.marks.result import MARKED, NO_FILE, Result, without_marks
from mrlab_ros.classroom.marks.similarity import SAMPLES
from mrlab_ros.classroom.marks.ways import drawn
from mrlab_ros.classroom.page import MOST_PAIRED, class_document, text_of
from mrlab_ros.classroom.rubrics.diagnostics import NOTHING_TOUCHED
from mrlab_ros.classroom.rubrics.marking import Mark, Marks
from mrlab_ros.classroom.rubrics.rubric import Outcome, Rubric, Test
from mrlab_ros.core.base.diagnostic import plain

FOUND = NOTHING_TOUCHED()


class Never:
    def assess(self, checked, reference):
        return Outcome(0.0, FOUND)


RUBRIC = Rubric(
    "Task <1>", (Test("no collision", "no collision", Never(), 6.0, hidden=True),), robot="ur5e"
)
PATHS = [f"{n}_{i}_assignsubmission_file_/a.mat" for n, i in (("Anna", 11), ("Jörg", 12))]


def graded():
    marks = Marks((Mark("no collision", 0.0, 6.0, False, FOUND, time=1.5),))
    result = Result(MARKED, plain(FOUND), marks.plain(), marks.public().plain(), "a.mat", "digest")
    result = replace(result, path=((0.1, 0.2, 0.30004), (0.1, 0.2, 0.4)), has_page=True)
    results = [result, without_marks(RUBRIC, NO_FILE, NO_FILE_HANDED_IN())]
    submissions = recognise([Entry(p) for p in PATHS], (".mat",)).submissions
    students = tuple(Student(s, r) for s, r in zip(submissions, results, strict=True))
    return GradedClass(
        RUBRIC, "Moodle", students, (LeftOut("x.txt", NO_MOTION_FILE()),), reference=result
    )


def test_a_row_leads_to_its_page_and_has_its_way():
    found = orjson.loads(orjson.dumps(class_document(graded())))
    anna, joerg = found["students"]
    assert (anna["page"], anna["marked"]) == (f"pages/{anna['key']}.html", True)
    assert (found["step"], anna["path"]) == (1, drawn(((0.1, 0.2, 0.3), (0.1, 0.2, 0.4)), 2, 1e-3))
    assert (anna["marks"][0]["passed"], anna["marks"][0]["time"]) == (False, 1.5)
    assert joerg["said"]["code"] == "no_file_handed_in"
    assert (joerg["page"], joerg["marked"], joerg["path"]) == (None, False, "")
    assert found["reference"]["page"] == "pages/reference.html"
    assert found["tests"][0]["hidden"]
    assert found["left_out_count"] == 1


def test_the_text_has_a_row_a_student_and_no_name_runs():
    document = class_document(graded())
    document["students"][0]["name"] = "<script>\u202e"
    text = text_of(document)
    heading, *rows = text.split("\n\n")[-1].splitlines()
    assert heading == "Students (student, points, no collision)"
    assert [row.split(" · ")[0] for row in rows] == ["<script>\u202e", "Jörg"]
    shown = page(document["title"], text, document, {}, Code(b"", ""))
    assert "<h1>Task &lt;1&gt;</h1>" in shown
    assert "&lt;script&gt;\\u202e · 0" in shown


def test_the_ways_of_a_large_class_have_fewer_points_in_coarser_steps():
    one = graded().students[0]
    way = tuple((0.0, math.sin(i / 6), i / 60) for i in range(64))
    many = (replace(one, result=replace(one.result, path=way)),) * 5000
    for students, points, step in ((many[:30], 64, 1), (many, 8, 10)):
        found = class_document(replace(graded(), students=students))
        assert found["step"] == step
        assert found["students"][-1]["path"] == drawn(way, points, step / 1e3)


def test_the_picture_of_pairs_has_a_few_of_a_large_class():
    one = graded().students[0]
    rows = np.zeros((SAMPLES, 6))

    def student(n):
        found = rows + (n // 2 if n < 100 else 1000 + n)
        result = replace(one.result, signature=found.tolist(), sha256=f"{n}")
        return replace(one, submission=renamed(one.submission, f"s{n}", f"s{n:03}"), result=result)

    similar = class_document(replace(graded(), students=tuple(map(student, range(200)))))[
        "similar"
    ]
    assert len(similar["groups"]) == 50
    assert len(similar["paired"]) == MOST_PAIRED
    assert similar["paired"][:4] == ["s000", "s001", "s002", "s003"]
    assert similar["apart"][:3] == [[], [0.0], [1.0, 1.0]]
