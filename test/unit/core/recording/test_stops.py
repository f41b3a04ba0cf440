"""Where a guided replay stands."""

from __future__ import annotations

import pytest

from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.recording.diagnostics import LOOKED_HERE, RUN_GRASPED, RUN_HIT
from mrlab_ros.core.recording.report import Contact, Event, SessionReport
from mrlab_ros.core.recording.runs import Action, Deed, Result, Run
from mrlab_ros.core.recording.stops import next_stop, stop_before, stops_of


def recorded() -> SessionReport:
    """A run that grasps and hits, and a mark just after it has begun."""
    report = SessionReport(9.05, 0)
    robot = report.robot("ur5e_1")
    robot.bases.append((0.0, Pose((1.0, 2.0, 0.0))))
    robot.collisions.append(Contact(6.0, "wrist", "table", 7, (0.5, 0.0, 0.74)))
    run = Run("ur5e_1", "ur5e", "wave", 1, "", 1.0, 9.0, 8.0, number=1, result=Result.COMPLETED)
    hit = RUN_HIT(robot="ur5e_1", other="table", link="wrist", row=7)
    grasp = RUN_GRASPED(object="cube_1", robot="ur5e_1", place=(0.1, 0.2, 0.3))
    run.actions = [Action(3.0, Deed.GRASPED, grasp), Action(6.0, Deed.HIT, hit)]
    report.runs = [run]
    report.marks = [Event(1.3, "", 0, LOOKED_HERE(name="Anna"), (4.0, 4.0, 1.0))]
    return report


def test_each_thing_that_happened_is_a_stop_with_its_place():
    stops = stops_of(recorded())
    assert [stop.time for stop in stops] == pytest.approx([1.4, 3.1, 6.1, 9.04])
    places = [stop.said.values["place"] for stop in stops]
    assert places == [(4.0, 4.0, 1.0), (0.1, 0.2, 0.3), (0.5, 0.0, 0.74), (1.0, 2.0, 0.0)]
    first = plain(stops[0].said)["values"]
    assert (first["number"], first["count"]) == (1, 4)
    assert [each["code"] for each in first["events"]] == ["stop_event", LOOKED_HERE.code]


def test_the_stops_before_and_after_a_place():
    stops = stops_of(recorded())
    assert next_stop(stops, 0.0) is stops[0]
    assert next_stop(stops, stops[0].time) is stops[1]
    assert next_stop(stops, 9.05) is None
    assert stop_before(stops, stops[2].time) is stops[1]
    # Who has just passed one wants the one before.
    assert stop_before(stops, 3.3) is stops[0]
    with pytest.raises(Misuse):
        stop_before(stops, stops[0].time)


def test_a_session_in_which_nothing_happened_has_no_stops():
    assert stops_of(SessionReport(0.0, 0)) == []
