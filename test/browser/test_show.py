"""Pages of `mrlab show`, opened from the disk without any network."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from browser_side import DEADLINE_MS, Watched, difference, eventually, pixels
from playwright.sync_api import Browser, expect

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.show import ingredients, still_text
from mrlab_ros.app.show.motion import motion_page
from mrlab_ros.app.show.page import page
from mrlab_ros.app.show.session import session
from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.conversion.candidates import Preview
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, RecordedObject
from mrlab_ros.core.recording.report import Contact, ReportedState, SessionReport
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.recording.runs import Course, RunJoint
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients, derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

ROOT = Path(__file__).parents[2]
LIBRARY = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none")
Open = Callable[..., Watched]


def positions() -> np.ndarray:
    t = np.linspace(0, 4, 401)
    return LIBRARY.model("ur5e").home + np.outer(np.sin(t), [1.2, 0.4, 0.5, 0.4, 0.5, 1.0])


def accepted() -> ConversionResult:
    q = positions()
    names = LIBRARY.model("ur5e").joint_names
    channels = derive(q, 100.0, ProxyCoefficients((1.0,), (1.0,), (1.0,), (0.1,), 50.0))
    source = Source("wave.mat", "q", "0" * 64)
    moved = Trajectory("wave", "ur5e", None, names, 100.0, q, None, channels, source)
    return ConversionResult("wave.mat", Outcome.ACCEPTED, moved, (), ())


def refused() -> ConversionResult:
    q = positions()
    q[200:240, 2] = 5.0
    found = Diagnostic(
        "joint_limit", Severity.ERROR, "elbow_joint goes to 5 rad.", "Keep it below pi.",
        {"variable": "q", "first_row": 201, "last_row": 240, "joint": "elbow_joint",
         "value": 5.0, "limit": 3.14, "unit": "rad"},
    )  # fmt: skip
    rows = np.arange(1, 402, 2, dtype=np.uint32)
    shown = Preview("q", rows, q[rows - 1].astype(np.float32))
    return ConversionResult("bad.mat", Outcome.REJECTED, None, (), (found,), shown)


@pytest.fixture
def shown(browser: Browser, tmp_path: Path) -> Iterator[Open]:
    """Return what writes the page of a result and opens it, offline, without motion of its own."""
    contexts = []

    def open_page(
        result: ConversionResult | str,
        *,
        change: Callable[[str], str] = str,
        script: str = "",
        **more,
    ) -> Watched:
        text = result
        if not isinstance(result, str):
            text = motion_page(result, "ur5e", None, LIBRARY, ROOT)
        assert len(text) < 1_000_000
        path = tmp_path / "page.html"
        path.write_text(change(text))
        context = browser.new_context(
            viewport={"width": 700, "height": 700},
            offline=True,
            reduced_motion="reduce",
            color_scheme="light",
            **more,
        )
        contexts.append(context)
        if script:
            context.add_init_script(script)
        watched = Watched(context.new_page())
        watched.page.goto(path.as_uri())
        return watched

    yield open_page
    for context in contexts:
        context.close()


def test_a_motion_is_drawn_and_moves(shown: Open) -> None:
    watched = shown(accepted())
    canvas = watched.page.locator("canvas")
    expect(canvas).to_be_visible(timeout=DEADLINE_MS)
    expect(watched.page.locator("html[data-ready]")).to_have_count(1, timeout=DEADLINE_MS)
    # the robot is dark and blue on a light ground: a canvas that draws nothing is one colour
    eventually(watched.page, lambda: len(np.unique(pixels(canvas).reshape(-1, 3), axis=0)) > 200)
    slider = watched.page.get_by_role("slider")
    begin = pixels(canvas)
    slider.fill("1.6")
    expect(slider).to_have_attribute("aria-valuetext", "1.60 s, row 161")
    eventually(watched.page, lambda: difference(begin, pixels(canvas)) > 0.01)
    slider.fill("0")
    expect(slider).to_have_attribute("aria-valuetext", "0.00 s, row 1")
    # a busy machine draws coarsely for a while
    eventually(watched.page, lambda: difference(begin, pixels(canvas)) < 0.004)
    assert watched.errors == []
    assert watched.foreign() == []


def test_it_plays_by_keyboard_and_ends(shown: Open) -> None:
    watched = shown(accepted())
    watched.page.get_by_label("Speed").select_option("4")
    watched.page.locator("canvas").focus()
    watched.page.keyboard.press(" ")
    slider = watched.page.get_by_role("slider")
    expect(slider).to_have_attribute("aria-valuetext", "4.00 s, row 401", timeout=DEADLINE_MS)
    expect(watched.page.get_by_role("button", name="Play")).to_be_visible()


def test_a_refused_file_stands_at_its_fault_with_the_link_painted(shown: Open) -> None:
    watched = shown(refused())
    page = watched.page
    expect(page.locator("html[data-ready]")).to_have_count(1, timeout=DEADLINE_MS)
    slider = page.get_by_role("slider")
    expect(slider).to_have_attribute("aria-valuetext", "2.00 s, row 201")
    at_fault = 0

    def painted() -> bool:
        nonlocal at_fault
        at_fault = red(pixels(page.locator("canvas")))
        return at_fault > 200

    eventually(page, painted)
    slider.fill("0")
    expect(slider).to_have_attribute("aria-valuetext", "0.00 s, row 1")
    eventually(page, lambda: at_fault > red(pixels(page.locator("canvas"))) + 200)
    page.get_by_role("button", name="rows 201 to 240").click()
    expect(slider).to_have_attribute("aria-valuetext", "2.00 s, row 201")
    assert page.locator(".plot .mark").count() == 1
    assert watched.errors == []
    # all of it is one sheet of paper, whose picture is of the same row
    expect(watched.page.get_by_alt_text("at row 201")).to_have_count(1)
    sheets = re.findall(rb"/Type\s*/Page\b", watched.page.pdf(prefer_css_page_size=True))
    assert len(sheets) == 1


def green(picture: np.ndarray) -> int:
    """Return how many pixels are clearly green."""
    r, g, b = picture[..., 0], picture[..., 1], picture[..., 2]
    return int(((g > r + 60) & (g > b + 60)).sum())


def red(picture: np.ndarray) -> int:
    """Return how many pixels are clearly red."""
    r, g, b = picture[..., 0], picture[..., 1], picture[..., 2]
    return int(((r > 120) & (r > 2 * g) & (r > 2 * b)).sum())


def test_a_missing_mesh_is_said(shown: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = LIBRARY.mesh_path
    monkeypatch.setattr(
        LIBRARY,
        "mesh_path",
        lambda uri: ROOT / "none.glb" if "upper_arm" in uri and "hull" not in uri else whole(uri),
    )
    monkeypatch.setattr("mrlab_ros.app.show.motion.poster", lambda *_: "data:,")
    watched = shown(accepted())
    note = watched.page.get_by_role("status").first
    expect(note).to_contain_text("upper_arm_link.glb", timeout=DEADLINE_MS)
    assert watched.page.locator("canvas").is_visible()


def test_without_webgl_a_picture_and_a_sentence_stand_there(shown: Open) -> None:
    watched = shown(accepted(), script="HTMLCanvasElement.prototype.getContext = () => null")
    expect(watched.page.get_by_text("cannot draw in 3D")).to_be_visible()
    assert watched.page.locator("#view img").is_visible()
    watched.page.get_by_role("slider").fill("2")
    # 2 s of 4 s, in the middle of the plot
    expect(watched.page.locator(".plot .playhead").first).to_have_attribute("x1", "318")
    expect(watched.page.locator(".strip-value").first).to_have_text(re.compile(r"^[-\d.]+°$"))


def test_without_scripts_a_picture_and_the_text_of_the_report_stand_there(shown: Open) -> None:
    page = shown(refused(), java_script_enabled=False).page
    assert page.locator(".poster img").is_visible()
    text = page.locator(".report-text").inner_text().splitlines()
    assert text[0].startswith("refused · bad.mat")
    place = "q · elbow_joint · rows 201 to 240"
    assert f"1. Error · {place}: elbow_joint goes to 5 rad. Keep it below pi." in text
    assert any(line.startswith("elbow_joint · ") for line in text)
    assert page.get_by_text("Text des Berichts auf Englisch").is_visible()


def test_a_german_reader_reads_german(shown: Open) -> None:
    watched = shown(accepted(), locale="de-DE")
    expect(watched.page.get_by_role("heading", name="Geschwindigkeiten")).to_be_visible()
    expect(watched.page.get_by_text("4,00 s, 401 Zeilen mit 100 Hz")).to_be_visible()
    assert watched.page.locator("html").get_attribute("lang") == "de"


def test_nothing_added_to_the_page_runs(shown: Open) -> None:
    evil = "<script>document.title = 'evil'</script><img src=x onerror=\"document.title='evil'\">"
    watched = shown(accepted(), change=lambda text: text.replace("<div id", f"{evil}<div id"))
    expect(watched.page.locator("canvas")).to_be_visible(timeout=DEADLINE_MS)
    assert watched.page.title() != "evil"


def recorded() -> str:
    """Return the page of a session: an arm that takes a cube, carries it, and hits a table."""
    report = SessionReport(duration=4.0, start_ns=0)
    told = report.robot("ur5e_1")
    for time, label in ((0.0, "PLAYING"), (3.0, "COLLISION_HALT")):
        clock = PlaybackClock(round(time * 1e9), time, float(label == "PLAYING"))
        told.add(ReportedState(round(time * 1e9), label, "wave", clock, time, length=4.0))
    told.states.add(0.0, "PLAYING", "wave")
    told.states.add(3.0, "COLLISION_HALT", "wave")
    told.grasps.add(1.0, "HOLDING", "cube_1")
    told.collisions.append(Contact(3.0, "forearm_link", "table", 301))
    report.runs = runs_of(report, {}, {})
    times = np.linspace(0, 4, 401)
    run = report.runs[0]
    run.joints = tuple(map(RunJoint, LIBRARY.model("ur5e").joint_names))
    run.course = Course(times, times, positions(), positions() + 0.1, positions()[:, :3])
    motion = RecordedMotion()
    robot = motion.robot("ur5e_1")
    robot.urdf = LIBRARY.description("ur5e")
    robot.joints = list(LIBRARY.model("ur5e").joint_names)
    robot.base.add(0.0, [0, 0, 0, 0, 0, 0, 1])
    shape = {
        "mesh": "",
        "size": {"x": 0.2, "y": 0.2, "z": 0.2},
        "color": {"r": 0.0, "g": 0.7, "b": 0.0, "a": 1.0},
        "primitive": {"type": 1, "dimensions": [0.2, 0.2, 0.2]},
    }
    cube = motion.objects["cube_1"] = RecordedObject(shape, 0.0, 4.0)
    cube.holders = [(0.0, ""), (1.0, "ur5e_1")]
    for time, q in zip(np.linspace(0, 4, 401), positions(), strict=True):
        robot.track.add(float(time), q.tolist())
    # what physics sent last before the arm took it; then it moves with the hand
    cube.track.add(0.0, [0.5, -0.3, 0.1, 0, 0, 0, 1])
    document = session("class", report, motion)
    meshes = ingredients.meshes_of([robot.urdf], LIBRARY.mesh_path)
    text = still_text.session(document)
    return page("class", text, document, meshes, ingredients.code(ROOT))


def test_a_session_is_drawn_and_its_events_lead_there(shown: Open) -> None:
    watched = shown(recorded())
    expect(watched.page.locator("html[data-ready]")).to_have_count(1, timeout=DEADLINE_MS)
    canvas = watched.page.locator("canvas")
    eventually(watched.page, lambda: green(pixels(canvas)) > 200)
    first = pixels(canvas)
    events = watched.page.get_by_role("region", name="Events")
    events.get_by_role("button", name="hit table").click()
    slider = watched.page.get_by_role("slider")
    expect(slider).to_have_attribute("aria-valuetext", "3.00 s, row 301")
    eventually(watched.page, lambda: difference(first, pixels(canvas)) > 0.01)
    row = watched.page.get_by_role("table").first.get_by_role("row", name="wave")
    expect(row).to_contain_text("halted by a collision")
    row.get_by_role("button", name="go to its beginning").click()
    expect(slider).to_have_attribute("aria-valuetext", "0.00 s, row 1")
    # paper shows what is folded, and pictures at what was done
    folded = watched.page.locator("details:not([open])")
    before = folded.count()
    assert before > 0
    watched.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert folded.count() == 0
    assert watched.page.locator(".film img").count() == 2
    watched.page.evaluate("dispatchEvent(new Event('afterprint'))")
    expect(watched.page.locator(".film")).to_have_count(0)
    expect(folded).to_have_count(before)
    assert watched.errors == []
    assert watched.foreign() == []
