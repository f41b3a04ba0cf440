"""A recorded session as a document, and what its page says without a script."""

import re
from pathlib import Path

import numpy as np
import orjson

from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.recording.moves import ObjectTrack, Placed
from mrlab_ros.core.recording.report import Contact, ReportedState, SessionReport
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.recording.runs import Course, RunJoint
from mrlab_ros.core.show import session as module
from mrlab_ros.core.show.packed import unpacked
from mrlab_ros.core.show.session import RecordedMotion, RecordedObject, Track, session
from mrlab_ros.core.show.session_body import session_body
from mrlab_ros.core.show.timeline_body import timeline

CONTRACT = Path(__file__).parents[4] / "web" / "src" / "playback" / "session.ts"
BEGAN = "2026-01-01 23:59:58"
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
    body = re.search(
        rf"export interface {interface} \{{(.*?)\n\}}", CONTRACT.read_text(), re.S
    ).group(1)
    return set(re.findall(r"^  readonly (\w+)[?]?:", body, re.M))


def test_the_fields_are_those_of_the_contract():
    found = orjson.loads(orjson.dumps(session("class", *recorded())))
    assert set(found) == fields_of("SessionDocument")
    assert set(found["robots"][0]) == fields_of("SessionRobot")
    assert set(found["objects"][0]) == fields_of("SessionObject")
    assert set(found["events"][0]) == fields_of("SessionEvent")
    assert set(found["robots"][0]["track"]) == fields_of("SessionTrack")
    assert found["schema"] in CONTRACT.read_text()


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
    assert [(e["time"], e["severity"]) for e in events] == [each[:2] for each in told]


def test_a_robot_without_description_cannot_be_drawn():
    report, motion = recorded()
    motion.robot("ghost")
    assert [r["name"] for r in session("c", report, motion)["robots"]] == ["ur5e_1"]


def test_what_stands_still_takes_two_samples():
    track = Track()
    for time in range(100):
        track.add(float(time), [float(time < 50), 3.0])
    found = track.document()
    assert unpacked(found["times"]).tolist() == [0, 49, 50, 99]
    assert unpacked(found["values"])[:, 0].tolist() == [1, 1, 0, 0]


def test_a_long_track_is_thinned_and_keeps_its_ends():
    track = Track()
    for time in range(4 * module.MOST_SAMPLES):
        track.add(float(time), [np.sin(time)])
    times = unpacked(track.document()["times"])
    assert len(times) <= module.MOST_SAMPLES + 1
    assert (times[0], times[-1]) == (0, 4 * module.MOST_SAMPLES - 1)


def test_an_empty_track_is_empty():
    assert Track().document()["times"]["shape"] == [0]


def test_the_page_says_it_without_a_script():
    report, motion = recorded()
    text = session_body("class", session("class", report, motion), report, BEGAN)
    assert "1 robot" in text
    wide = re.search(r'<svg class="strip states wide".*?</svg>', text, re.S).group(0)
    assert wide.count('<rect class="state ') == 3
    assert wide.count('class="hit"') == 1
    assert "1 · pick" in wide
    assert "00:00:00" in text  # 2 s after the session began
    assert "holds &lt;cube&gt;" in text
    assert "<cube>" not in text
    assert 'data-time="6.000"' in text
    assert 'class="result halted"' in text
    assert text.count('class="path"') == 3
    assert "limit 28.65 deg" in text  # 0.5 rad of the first joint, which comes near
    assert "Technical" in text


def test_a_session_in_which_nothing_was_played_says_so():
    text = session_body(
        "class", session("class", SessionReport(1.0, 0), RecordedMotion()),
        SessionReport(1.0, 0), BEGAN,
    )  # fmt: skip
    assert "No robot played." in text


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


def test_states_that_differ_in_what_is_loaded_alone_are_one_bar():
    report = SessionReport(100.0, 0)
    robot = report.robot("ur5e_1")
    for time, label, loaded in (
        (0.0, "IDLE", ""), (10.0, "READY", "a"), (20.0, "READY", "b"),
        (30.0, "PLAYING", "b"), (30.01, "COMPLETE", "b"), (60.0, "PLAYING", "b"),
    ):  # fmt: skip
        robot.states.add(time, label, loaded)
    report.robot("silent <1>")
    text = timeline(report)
    wide = re.search(r'<svg class="strip states wide".*?</svg>', text, re.S).group(0)
    assert re.findall(r'class="state ([a-z-]+)"', wide) == [
        "idle", "ready", "playing", "complete", "playing",
    ]  # fmt: skip
    assert "Without a run</span>: silent &lt;1&gt;" in text
    assert "1:00" in text  # the axis of what lasts longer than 100 s, or as long, shows minutes
    assert timeline(SessionReport(1.0, 0)) == ""


def test_the_figures_of_a_run_stand_beside_the_way_of_its_tool():
    report, motion = recorded()
    text = session_body("class", session("class", report, motion), report, BEGAN)
    figures = re.search(r'<dl class="run-figures">.*?</dl>', text, re.S).group(0)
    assert "4.00 / 8.00 s, 1\N{MULTIPLICATION SIGN}" in figures
    assert "(a)" in figures  # the joint that came nearest to its limit
    assert "Reference" not in figures
