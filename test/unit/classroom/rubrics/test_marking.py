"""Marks: sums, parts, hidden tests, files without a motion."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from made_motions import checked

from mrlab_ros.classroom.rubrics.diagnostics import NO_MOTION_TO_MARK
from mrlab_ros.classroom.rubrics.late import Late, instant
from mrlab_ros.classroom.rubrics.marking import flaws_of_trials, mark, points_of
from mrlab_ros.classroom.rubrics.rubric import LENGTH, Outcome, Rubric, Test, Threshold
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.checking.report import CheckReport

FOUND = checked()


class Fixed:
    def __init__(self, share, time=1.0):
        self.share, self.time = share, time

    def assess(self, given, reference):
        return Outcome(self.share, NO_MOTION_TO_MARK(), self.time)


SHARES = st.floats(0, 1)
POINTS = st.floats(0.01, 100)
TESTS = st.lists(st.tuples(SHARES, POINTS, st.booleans()), min_size=1, max_size=12)


def rubric(entries):
    return Rubric("r", tuple(
        Test(f"t{i}", "no collision", Fixed(share), points, f"h{i}", hidden)
        for i, (share, points, hidden) in enumerate(entries)
    ))  # fmt: skip


@given(TESTS)
def test_marks_are_the_sum_of_their_tests_and_never_more_than_the_points(entries):
    marks = mark(rubric(entries), FOUND)
    assert 0 <= marks.points <= marks.of + 1e-6
    assert math.isclose(marks.points, sum(m.points for m in marks.tests), abs_tol=1e-5)
    assert (marks.points == marks.of) == (not marks.lost)
    for one, (share, points, _) in zip(marks.tests, entries, strict=True):
        assert one.passed == (share >= 1 - 1e-9)
        assert one.points <= points
        assert abs(one.points - share * points) <= 0.01 + 1e-6
        assert (one.time is None) == one.passed
        assert (one.found.severity is Severity.INFO) == one.passed
        assert one.found.refuses == (not one.passed and one.points == 0)


@given(TESTS)
def test_what_a_student_sees_holds_nothing_of_hidden_tests_but_hints(entries):
    whole = mark(rubric(entries), FOUND)
    marks = whole.public()
    hidden = {f"t{i}" for i, e in enumerate(entries) if e[2]}
    assert not hidden & {m.name for m in marks.tests}
    assert (marks.points, marks.of) == (whole.points, whole.of)
    lost = {f"h{i}" for i, (s, _, h) in enumerate(entries) if h and s < 1 - 1e-9}
    assert set(marks.hints) == lost


@given(TESTS, st.randoms())
def test_the_order_of_tests_changes_no_mark(entries, random):
    given_marks = {m.name: m.points for m in mark(rubric(entries), FOUND).tests}
    tests = list(rubric(entries).tests)
    random.shuffle(tests)
    assert {m.name: m.points for m in mark(Rubric("r", tuple(tests)), FOUND).tests} == given_marks


def test_a_test_earns_nothing_before_those_that_it_requires():
    tests = (
        Test("first", "x", Fixed(1.0), 1.0, requires=("second",)),
        Test("second", "x", Fixed(1.0), 1.0, requires=("third",)),
        Test("third", "x", Fixed(0.5, 2.5), 1.0, hidden=True),
        Test("other", "x", Fixed(0.5), 1.0),
    )
    marks = mark(Rubric("r", tests), FOUND)
    assert [m.points for m in marks.tests] == [0, 0, 0.5, 0.5]
    # the name of a hidden test is not said
    assert [m.found.code for m in marks.tests[:2]] == ["required_hidden_lost"] * 2
    assert [m.time for m in marks.tests[:2]] == [2.5, 2.5]
    shown = mark(Rubric("r", (*tests[:2], replace(tests[2], hidden=False))), FOUND)
    assert shown.tests[0].found.values == {"test": "third"}


def test_a_lost_gate_leaves_its_own_points_and_a_cap_limits_the_whole():
    most = Test("most", "x", Fixed(1.0), 8.0)
    gate = Test("gate", "x", Fixed(0.5), 1.0, gate=True)
    assert [m.points for m in mark(Rubric("r", (most, gate)), FOUND).tests] == [0, 0.5]
    passed = replace(gate, measure=Fixed(1.0))
    assert mark(Rubric("r", (most, passed)), FOUND).points == 9
    cap = Test("cap", "x", Fixed(0.0), 1.0, cap=3.0)
    marks = mark(Rubric("r", (most, cap)), FOUND)
    assert (marks.points, marks.of, marks.tests[1].found.code) == (3, 9, "capped")
    assert marks.plain()["points"] == marks.public().points == 3
    kept = replace(cap, measure=Fixed(1.0))
    assert mark(Rubric("r", (most, kept)), FOUND).points == 9


def test_what_stands_still_earns_and_what_no_trial_loses_is_a_flaw():
    names = ("easy", "never lost", "good")
    tests = tuple(Test(name, "x", Fixed(1.0), 2.0, line=n) for n, name in enumerate(names))
    full = mark(Rubric("r", tests), FOUND)

    def losing(*lost):
        return replace(full, tests=tuple(
            replace(m, points=0.0, passed=False) if m.name in lost else m for m in full.tests
        ))  # fmt: skip

    found = list(flaws_of_trials(Rubric("r", tests), losing("good"), [losing("easy"), full]))
    assert [(f.test, f.found.code) for f in found] == [
        ("easy", "earned_standing"), ("never lost", "lost_by_none"),
    ]  # fmt: skip


@given(POINTS, st.lists(SHARES, min_size=2, max_size=2))
def test_a_larger_share_never_earns_less(points, shares):
    low, high = sorted(shares)
    assert points_of(points, low) <= points_of(points, high) <= points


@given(st.floats(0.001, 1), st.floats(0.001, 1), st.lists(st.floats(0, 3), min_size=2, max_size=2))
def test_a_threshold_falls_evenly_from_its_limit_to_its_end(limit, span, values):
    near, far = sorted(values)
    rule = Threshold(LENGTH, limit, limit + span)
    assert 1 >= rule.share(near) >= rule.share(far) >= 0
    assert rule.share(limit) == 1
    assert rule.share(limit + span) < 1e-9
    assert math.isclose(rule.share(limit + span / 2), 0.5, abs_tol=1e-6)
    least = Threshold(LENGTH, limit + span, limit, at_least=True)
    assert math.isclose(least.share(limit + span / 2), 0.5, abs_tol=1e-6)


def test_a_file_without_a_motion_gets_nothing_and_is_told_why_once():
    finding = Diagnostic("not_numbers", Severity.ERROR, "'q' is text.", "Save numbers.")
    refused = Checked(CheckReport("f", {}, (), (finding,)), {})
    marks = mark(rubric([(1.0, 3.0, False), (0.5, 1.0, True)]), refused)
    assert (marks.points, marks.of, marks.note) == (0.0, 4.0, finding)
    assert {m.found.code for m in marks.tests} == {NO_MOTION_TO_MARK.code}
    assert all(m.time is None for m in marks.tests)
    assert json.loads(json.dumps(marks.public().plain()))["hints"] == []


def test_a_bonus_comes_on_top_and_a_lost_one_costs_nothing():
    base = Test("a", "no collision", Fixed(1), 4)
    for share, points in ((1, 6), (0, 4)):
        extra = Test("b", "no collision", Fixed(share), 2, bonus=True)
        marks = mark(Rubric("r", (base, extra)), FOUND)
        assert (marks.points, marks.of) == (points, 4)
        assert marks.public().of == 4
    assert Rubric("r", (base, extra)).points == 4


@pytest.mark.parametrize(("days", "points"), [(0, 8), (1, 7.2), (2, 6.4), (6, 4), (400, 4)])
def test_a_late_submission_loses_a_share_of_what_it_earned(days, points):
    late = Late("10%", at_most="50%")
    tests = (Test("a", "no collision", Fixed(0.8), 10), Test("Late", "", late, 0.0))
    marks = mark(Rubric("r", tests), FOUND, late=days)
    assert (marks.points, marks.of) == (points, 10)
    assert marks.tests[-1].points == round(points - 8, 6)
    assert marks.tests[-1].found.code == ("handed_in_late" if days else "handed_in_on_time")
    none = mark(Rubric("r", (Test("a", "", Fixed(0), 3), tests[1])), FOUND, late=days)
    assert none.points == 0


def test_what_a_cap_leaves_is_what_a_late_submission_loses_a_share_of():
    capped = Test("a", "no collision", Fixed(0), 4, cap=5)
    tests = (capped, Test("b", "no collision", Fixed(1), 16), Test("Late", "", Late("20%"), 0.0))
    assert mark(Rubric("r", tests), FOUND, late=1).points == 4


DAY = 24 * 3600


def test_days_are_counted_from_the_instant_in_the_rubric_or_as_the_platform_says():
    due = instant("2026-11-30 23:59 +01:00")
    assert due == instant("2026-11-30T22:59:00.5Z") == instant("2026-11-30 22:59:00.000 UTC")
    assert instant("30.11.2026 23:59") is None
    assert instant("2026-02-30 10:00 Z") is None
    rule = Late("10%", "2026-11-30 23:59 +01:00")
    assert [rule.days(due + s, False) for s in (-DAY, 0, 1, DAY, DAY + 1)] == [0, 0, 1, 1, 2]
    # the platform's word where no instant is known; the rubric's where one is
    assert [rule.days(None, late) for late in (False, True)] == [0, 1]
    assert rule.days(due - 1, True) == 0
    assert Late("10%").days(due + 3 * DAY, True) == 1
