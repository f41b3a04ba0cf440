"""A rubric as a document of mappings, lists and texts; see docs/rubrics.md."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from mrlab_ros.classroom.rubrics.diagnostics import (
    BAD_CLOSEST,
    BAD_DUE,
    BAD_POSE,
    NO_PARTIAL,
    POSE_COUNT,
    READS_NO_POSES,
    REQUIRES_CIRCLE,
    REQUIRES_UNKNOWN,
    RUBRIC_ENTRY,
    RUBRIC_TEST,
    SAME_TEST_NAME,
    TEST_COUNT,
    TEST_POSE,
    TURNED_TWICE,
    UNKNOWN_PARTIAL,
)
from mrlab_ros.classroom.rubrics.late import Late, instant
from mrlab_ros.classroom.rubrics.measures import FORMS
from mrlab_ros.classroom.rubrics.rubric import LENGTH, Rubric, Test
from mrlab_ros.classroom.rubrics.sentences import Form, Given, form_of
from mrlab_ros.core.base.checks import (
    FILLED_TEXT,
    FLAG,
    TEXT,
    Number,
    Numbers,
    Texts,
    Words,
    above,
    between,
    checked,
    shown,
)
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.diagnostics import IN_PLACE
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.geometry import Pose, Vector, normalized, quaternion_from_rpy
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.base.records import Record, every, read
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.checking.rehearsal import FARTHEST

FIELDS = (
    "name", "about", "robot", "tool", "scene", "reference", "files", "closest", "tests", "late",
)  # fmt: skip
TEST_FIELDS = (
    "name", "expect", "points", "hint", "hidden", "partial", "poses", "requires",
    "gate", "cap", "bonus",
)  # fmt: skip
POSE_FIELDS = ("position", "rpy_deg", "orientation")
POSITION = Numbers(3, between(-100, 100), "m: x, y, z in world")
ANGLES = Numbers(3, between(-360, 360), "degrees: roll, pitch, yaw")
QUATERNION = Numbers(4, between(-1, 1), "x, y, z, w")
POINTS = Number(above(0, 1e6))
NAMES = Texts(FILLED_TEXT, single=True)
MOST_TESTS, MOST_POSES = 200, 1000
# The line of each entry, by the keys and numbers that lead to it.
Lines = Mapping[tuple[str | int, ...], int]


def parse(document: object, origin: str, lines: Lines | None = None) -> Rubric:
    """Return the rubric; raise BadInput that names all mistakes with their lines.

    origin: the file. lines: from 1; none: mistakes are named by their tests alone.
    """
    known = lines or {}
    record = Record(document, origin, FIELDS)
    entries = record.entries("tests")
    if not 0 < len(entries) <= MOST_TESTS:
        fixes = (Fix(command="mrlab rubric example"),)
        raise record.error(TEST_COUNT(count=len(entries), most=MOST_TESTS, fixes=fixes))
    closest = record.optional("closest", TEXT)
    try:
        metres = CLOSE if closest is None else LENGTH.read(closest)
    except BadInput as error:
        raise BadInput(IN_PLACE(place=record.at("closest"), why=error.diagnostic)) from None
    if not 0 <= metres <= FARTHEST:
        raise record.error(BAD_CLOSEST(text=closest, limit=FARTHEST))
    tests = every(lambda numbered: _test(origin, known, *numbered), enumerate(entries), origin)
    if (late := _late(record)) is not None:
        tests.append(Test(late.name, "", late, 0.0))
    _unique(tests, origin)
    _require_others(tests, origin)
    assert isinstance(document, Mapping)
    return Rubric(
        name=record.value("name", TEXT, ""),
        tests=tuple(tests),
        robot=record.value("robot", TEXT, ""),
        tool=record.value("tool", TEXT, ""),
        scene=record.value("scene", TEXT, ""),
        reference=record.value("reference", TEXT, ""),
        closest=metres,
        files=record.value("files", TEXT, ""),
        about=record.value("about", TEXT, ""),
        origin=origin,
        plain=document,
    )


def _late(record: Record) -> Late | None:
    """Return the rule for late submissions, None: there is none. Raises BadInput."""
    if "late" not in record:
        return None
    late = read(Late, record.mapping("late"), record.at("late"))
    if late.due and instant(late.due) is None:
        raise BadInput(IN_PLACE(place=record.at("late"), why=BAD_DUE(text=late.due)))
    return late


def _unique(tests: list[Test], origin: str) -> None:
    """Raise BadInput where two tests have one name."""
    first: dict[str, Test] = {}
    for test in tests:
        other = first.setdefault(test.name, test)
        if other is not test:
            place = RUBRIC_TEST(file=origin, line=test.line or None, test=test.name)
            why = SAME_TEST_NAME(test=test.name, line=other.line)
            raise BadInput(IN_PLACE(place=place, why=why))


def _require_others(tests: list[Test], origin: str) -> None:
    """Raise BadInput where a test requires one that is not there, or itself."""
    required = {test.name: test.requires for test in tests}
    for test in tests:
        place = RUBRIC_TEST(file=origin, line=test.line or None, test=test.name)
        known = [name for name in required if name != test.name]
        for name in test.requires:
            if name not in known:
                why = REQUIRES_UNKNOWN(test=name, known=known, close=close_to(name, known))
                raise BadInput(IN_PLACE(place=place, why=why))
        reached, waiting = set[str](), list(test.requires)
        while waiting:
            name = waiting.pop()
            if name not in reached:
                reached.add(name)
                waiting += required.get(name, ())
        if test.name in reached:
            why = REQUIRES_CIRCLE(tests=sorted(reached - {test.name}))
            raise BadInput(IN_PLACE(place=place, why=why))


def at(origin: str, line: int) -> str:
    """Return where something is, as editors and compilers have it; line 0: not known."""
    return f"{origin}:{line}" if line else origin


def _test(origin: str, lines: Lines, index: int, value: object) -> Test:
    line = lines.get(("tests", index), 0)
    number = RUBRIC_ENTRY(file=origin, line=line or None, number=index + 1)
    entry = Record(value, number, TEST_FIELDS)
    expect = entry.required("expect", FILLED_TEXT)
    name = entry.value("name", FILLED_TEXT, expect)
    entry.place = RUBRIC_TEST(file=origin, line=line or None, test=name)
    points = entry.required("points", POINTS)
    partial = entry.value("partial", FILLED_TEXT, "")
    of_expect = lines.get(("tests", index, "expect"), line)
    try:
        form, gaps = form_of(expect, FORMS)
        each, until = _partial(form, partial)
    except BadInput as error:
        place = RUBRIC_TEST(file=origin, line=of_expect or None, test=name)
        raise BadInput(IN_PLACE(place=place, why=error.diagnostic)) from None
    poses = _poses(entry, form, expect)
    return Test(
        name=name,
        expect=expect,
        measure=form.build(gaps, Given(poses, each, until)),
        points=points,
        hint=entry.value("hint", TEXT, ""),
        hidden=entry.value("hidden", FLAG, False),
        partial=partial,
        line=line,
        requires=entry.value("requires", NAMES, ()),
        gate=entry.value("gate", FLAG, False),
        cap=entry.optional("cap", POINTS),
        bonus=entry.value("bonus", FLAG, False),
    )


def _partial(form: Form, rule: str) -> tuple[bool, float | None]:
    """Return whether each part earns its points, and until which value there are some."""
    if not rule or rule == "none":
        return False, None
    if rule == "each" and form.each:
        return True, None
    word, _, value = rule.partition(" ")
    if word == "until" and form.until is not None:
        return False, form.until.read(value)
    if not form.rules:
        raise BadInput(NO_PARTIAL(rule=rule, sentence=form.text))
    raise BadInput(UNKNOWN_PARTIAL(rule=rule, sentence=form.text, rules=form.rules))


def _poses(entry: Record, form: Form, expect: str) -> tuple[Pose | Vector, ...]:
    values = entry.entries("poses")
    if values and not form.poses:
        raise entry.error(READS_NO_POSES(sentence=expect))
    if form.poses and not 0 < len(values) <= MOST_POSES:
        raise entry.error(POSE_COUNT(count=len(values), most=MOST_POSES))
    return tuple(_pose(entry.place, number, value) for number, value in enumerate(values, 1))


def _pose(place: Words, number: int, value: object) -> Pose | Vector:
    where = TEST_POSE(place=place, number=number)
    if isinstance(value, list | tuple):
        x, y, z = checked(where, value, POSITION)
        return (x, y, z)
    if not isinstance(value, Mapping):
        raise BadInput(BAD_POSE(place=where, found=shown(value)))
    entry = Record(value, where, POSE_FIELDS)
    x, y, z = entry.required("position", POSITION)
    turned = entry.optional("rpy_deg", ANGLES)
    given = entry.optional("orientation", QUATERNION)
    if turned is not None and given is not None:
        raise entry.error(TURNED_TWICE())
    if turned is not None:
        roll, pitch, yaw = (math.radians(angle) for angle in turned)
        return Pose((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    if given is not None:
        qx, qy, qz, qw = given
        try:
            pose = Pose((x, y, z), (qx, qy, qz, qw))
            return Pose(pose.position, normalized(pose.orientation))
        except LabError as error:
            raise BadInput(IN_PLACE(place=where, why=error.diagnostic)) from None
    return (x, y, z)


def plain(rubric: Rubric) -> dict[str, Any]:
    """Return what a rubric was read from, as mappings, lists and texts, for a digest."""
    return dict(rubric.plain or {})
