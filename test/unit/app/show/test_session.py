"""A recorded session as a document of the page."""

import re
from pathlib import Path

import numpy as np
import orjson

from mrlab_ros.app.show import session as module
from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.app.show.session import session, track_document
from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.recording.moves import ObjectTrack, Placed
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, RecordedObject, Track
from mrlab_ros.core.recording.report import Contact, Hop, ReportedState, Series, SessionReport
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.recording.runs import Course, RunJoint

CONTRACT = Path(__file__).parents[4] / "web" / "src" / "playback" / "session.ts"
SHAPE = {
    "mesh": "",
    "size": {"x": 1.0, "y": 1.0, "z": 1.0},
    "color": {"r": 1.0, "g": 0.0, "b": 0.0, "a": 1.0},
    "primitive": {"type": 1, "dimensions": [1.0, 1.0, 1.0]},
}


def recorded():
    report = SessionReport(duration=10.0, start_ns=0)
    robot = report.robot("ur5e_1")
    robot.model = "ur5e"
    for time, label, position, rate in (
        (0.0, "READY", 0.0, 0.0),
        (2.0, "PLAYING", 0.0, 1.0),
        (6.0, "COLLISION_HALT", 4.0, 0.0),
    ):
        clock = PlaybackClock(round(time * 1e9), position, rate)
        robot.add(ReportedState(round(time * 1e9), label, "pick", clock, time, length=8.0))
    robot.states.add(0.0, "READY", "pick")
    robot.states.add(2.0, "PLAYING", "pick")
    robot.states.add(6.0, "COLLISION_HALT", "pick")
    robot.grasps.add(3.0, "HOLDING", "<cube>")
    robot.grasps.add(5.0, "OPEN", "")
    robot.collisions.append(Contact(6.0, "forearm_link", "table", 413))
    cube = ObjectTrack()
    cube.add(0.0, Placed(Pose((0.5, 0.0, 0.0)), "", None))
    report.runs = runs_of(report, {"<cube>": cube}, {})
    times = np.linspace(2.0, 9.0, 50)
    report.runs[0].joints = (RunJoint("a", lower=-1.0, upper=0.5), RunJoint("b"))
    report.runs[0].course = Course(
        times, times - 2, np.column_stack([times / 20, 0 * times]), np.full((50, 2), np.nan),
        np.column_stack([times / 10, times / 20, 0 * times]),
    )  # fmt: skip
    motion = RecordedMotion()
    moved = motion.robot("ur5e_1")
    moved.urdf, moved.model, moved.joints = "<robot/>", "ur5e", ["a", "b"]
    for time in range(10):
        moved.track.add(float(time), [time * 0.1, 0.0])
    motion.objects["<cube>"] = RecordedObject(SHAPE, 0.0, 9.0)
    return report, motion


def fields_of(interface):
    body = re.search(rf"interface {interface} \{{(.*?)\n\}}", CONTRACT.read_text(), re.S).group(1)
    return set(re.findall(r"^  readonly (\w+)[?]?:", body, re.M))


def test_the_fields_are_those_of_the_contract():
    found = orjson.loads(orjson.dumps(session("class", *recorded())))
    assert set(found) == {*fields_of("SessionDocument"), "report"}
    assert set(found["robots"][0]) == fields_of("SessionRobot")
    assert set(found["objects"][0]) == fields_of("SessionObject")
    assert set(found["events"][0]) == fields_of("SessionEvent")
    assert set(found["robots"][0]["track"]) == fields_of("SessionTrack")
    told = found["report"]
    assert set(told) == fields_of("SessionFacts")
    (run,), (robot,) = told["runs"], told["robots"]
    assert fields_of("SessionRun") <= set(run)
    assert set(run["curves"]) == fields_of("RunCurves")
    assert fields_of("RunFigures") <= set(run["figures"])
    assert fields_of("RobotFacts") <= set(robot)
    assert fields_of("Span") <= set(robot["states"][0])


def test_events_are_in_order_and_say_what_happened():
    report, motion = recorded()
    told = [(e.time, e.said.severity.name.lower(), e.said.code) for e in report.events()]
    assert told == [
        (2.0, "info", "run_began"),
        (3.0, "info", "run_grasped"),
        (5.0, "info", "run_released"),
        (6.0, "error", "run_hit"),
        (10.0, "info", "run_ended"),
    ]
    events = session("c", report, motion)["events"]
    assert [(e["time"], e["said"]["severity"], e["said"]["code"]) for e in events] == told


def test_a_robot_without_description_cannot_be_drawn():
    report, motion = recorded()
    motion.robot("ghost")
    assert [r["name"] for r in session("c", report, motion)["robots"]] == ["ur5e_1"]


def test_what_stands_still_takes_two_samples():
    track = Track()
    for time in range(100):
        track.add(float(time), [float(time < 50), 3.0])
    found = track_document(track)
    assert unpacked(found["times"]).tolist() == [0, 49, 50, 99]
    assert unpacked(found["values"])[:, 0].tolist() == [1, 1, 0, 0]


def test_a_long_track_is_thinned_and_keeps_its_ends():
    track = Track()
    for time in range(4 * module.MOST_SAMPLES):
        track.add(float(time), [np.sin(time)])
    times = unpacked(track_document(track)["times"])
    assert len(times) <= module.MOST_SAMPLES + 1
    assert (times[0], times[-1]) == (0, 4 * module.MOST_SAMPLES - 1)


def test_an_empty_track_is_empty():
    assert track_document(Track())["times"]["shape"] == [0]


def test_a_robot_is_drawn_while_the_scene_has_it():
    motion = RecordedMotion()
    for time, names in ((0.6, ["a"]), (5.0, ["a", "b"]), (7.0, ["b"]), (9.0, ["a", "b"])):
        motion.scene(time, names)
    # the recorder heard of the first ones late
    assert motion.robots["a"].there == [(0.0, 7.0), (9.0, None)]
    assert motion.robots["b"].there == [(5.0, None)]


def test_the_link_that_touched_is_painted():
    (robot,) = session("c", *recorded())["robots"]
    assert robot["collisions"] == [[6.0, "forearm_link"]]


def test_the_curves_of_a_run_are_thinned_and_keep_their_peaks():
    report, motion = recorded()
    (run,) = report.runs
    count = 20 * module.CURVE
    times = np.linspace(2.0, 9.0, count)
    joints = np.column_stack([np.sin(times), np.cos(times)])
    joints[count // 3, 1] = 7.0
    joints[count // 2, 0] = np.nan
    unknown = np.full((count, 2), np.nan)
    run.course = Course(times, times - 2, joints, unknown, None)
    (told,) = session("c", report, motion)["report"]["runs"]
    curves = told["curves"]
    shown = unpacked(curves["joints"])
    assert len(shown) < 2 * module.CURVE
    assert shown[:, 1].max() == 7.0
    assert unpacked(curves["times"])[[0, -1]].tolist() == [2.0, 9.0]
    assert (curves["expected"], curves["tool"]) == (None, None)


def test_what_was_measured_of_the_lab_is_told_by_robot():
    report, motion = recorded()
    report.robot("ur5e_1").deadline.add(1.0, 0.002)
    report.latency[Hop("published_to_bridged")] = Series([1.0, 2.0], [0.01, 0.03])
    deadline, latency = session("c", report, motion)["report"]["series"]
    assert (deadline["robot"], deadline["quantity"], deadline["max"]) == (
        "ur5e_1", "deadline", 0.002,
    )  # fmt: skip
    assert latency["hop"] == {"ends": "published_to_bridged", "observer": ""}
    assert unpacked(latency["curve"]["times"]).tolist() == [1.0, 2.0]


def test_of_many_runs_the_first_are_drawn(monkeypatch):
    monkeypatch.setattr(module, "MOST_RUNS", 0)
    (run,) = session("c", *recorded())["report"]["runs"]
    assert run["curves"] is None
    assert run["outcome"]["code"] == "run_halted"
