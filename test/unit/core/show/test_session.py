"""A recorded session as a document, and what its page says without a script."""

import re
from pathlib import Path

import numpy as np
import orjson

from mrlab_ros.core.recording.report import Contact, SessionReport
from mrlab_ros.core.show import session as module
from mrlab_ros.core.show.packed import unpacked
from mrlab_ros.core.show.session import RecordedMotion, RecordedObject, Track, session
from mrlab_ros.core.show.session_body import session_body

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
    robot.states.add(0.0, "READY", "pick")
    robot.states.add(2.0, "PLAYING", "pick")
    robot.states.add(6.0, "COLLISION_HALT", "pick")
    robot.grasps.add(3.0, "HOLDING", "<cube>")
    robot.grasps.add(5.0, "OPEN", "")
    robot.collisions.append(Contact(6.0, "forearm_link", "table", 412))
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
    texts = [(e["time"], e["severity"], e["text"]) for e in session("c", *recorded())["events"]]
    assert texts == [
        (2.0, "info", "played pick"),
        (3.0, "info", "took <cube>"),
        (5.0, "info", "let go of <cube>"),
        (6.0, "error", "forearm_link touched table at frame 412"),
    ]


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
    text = session_body("class", session("class", report, motion), report, "2026-01-01")
    assert "1 robot" in text
    assert text.count('class="state ') == 3
    assert 'class="hit"' in text
    assert "holds &lt;cube&gt;" in text
    assert "<cube>" not in text
    assert 'data-time="6.000"' in text
