"""A course on a learning platform: a teacher and a student come from it, by their pages alone."""

from __future__ import annotations

import json
import time
import urllib.request
from pathlib import Path

import pytest
import yaml
from learning_platform import LearningPlatform
from own_port import free_port
from playwright.sync_api import Browser, Page, expect
from served_lab import ServedLab, gateway_with_people

ROOT = Path(__file__).parents[2]
PICK = ROOT / "examples" / "pick_and_place_ur5e.mat"
QUINTIC = ROOT / "examples" / "quintic_ur5e.mat"
RUBRIC = """name: Take the cube
robot: ur5e
scene: pick_and_place
reference: solution.mat
tests:
  - {name: Takes the cube, expect: grasps cube_1 between 1 s and 4 s, points: 2, hint: Close it}
  - {name: In time, expect: cycle < 30 s, points: 1}
"""
# A run starts processes that import everything and check the solution.
RUN_MS = 240_000


def came(browser: Browser, course: str, who: str, locale: str = "en-GB") -> Page:
    """Open the tool in the course, as that person; return its page."""
    page = browser.new_context(locale=locale, accept_downloads=True).new_page()
    page.goto(course)
    page.get_by_role("button", name=f"open as {who}").click()
    return page


@pytest.mark.timeout(900)
def test_a_course_by_the_pages_alone(
    plain_browser: Browser, lab: ServedLab, tmp_path: Path
) -> None:
    port = free_port()
    tool = f"http://127.0.0.1:{port}"

    def tool_keys() -> object:
        with urllib.request.urlopen(f"{tool}/api/lti/keys", timeout=10) as answer:
            return json.load(answer)

    platform = LearningPlatform(tool_keys, time.time)
    file = tmp_path / "lti.yaml"
    file.write_text(yaml.safe_dump(platform.settings()))
    rubric = tmp_path / "rubric.yaml"
    rubric.write_text(RUBRIC)
    solution = tmp_path / "solution.mat"
    solution.write_bytes(PICK.read_bytes())
    options = ("--classroom", str(tmp_path / "class"), "--lti", str(file))
    with gateway_with_people(lab, tmp_path, port, *options):
        course = f"{platform.url}/course?tool={tool}"
        teacher = came(plain_browser, course, "Grace Teacher")
        expect(teacher.get_by_role("heading", name="Robotics 1: Pick and place")).to_be_visible()
        teacher.get_by_label("Rubric (YAML)", exact=True).set_input_files(rubric)
        expect(teacher.get_by_text("The rubric names solution.mat")).to_be_visible()
        teacher.get_by_label("Solution, as the rubric names it", exact=True).set_input_files(
            solution
        )
        expect(teacher.get_by_text("The rubric names solution.mat")).to_be_hidden()

        anna = came(plain_browser, course, "Anna Ärmel", "de-DE")
        expect(anna.get_by_role("heading", name="Take the cube")).to_be_visible()
        expect(anna.get_by_role("link", name="Klasse")).to_be_visible()
        anna.locator("input[type=file]").set_input_files(QUINTIC)
        said = anna.get_by_text("1 Test ist erfüllt, an 1 Test ist noch zu tun.")
        expect(said).to_be_visible(timeout=RUN_MS)
        expect(anna.get_by_text("Close it")).to_be_visible()
        anna.locator("input[type=file]").set_input_files(PICK)
        said = anna.get_by_text("2 Tests sind erfüllt.")
        expect(said).to_be_visible(timeout=RUN_MS)

        teacher.reload()
        teacher.get_by_role("button", name="Get the list of students").click()
        expect(teacher.get_by_text("1 of 3 have handed in")).to_be_visible()
        teacher.get_by_role("button", name="Take what was handed in").click()
        teacher.get_by_role("button", name="Mark the class").click()
        heading = teacher.get_by_role("heading", level=1, name="Anna Ärmel")
        expect(heading).to_be_visible(timeout=RUN_MS)
        expect(teacher.get_by_text("3 of 3 points")).to_be_visible()
        teacher.get_by_role("button", name="Release the marks").click()
        send = teacher.get_by_role("button", name="Send the marks to the course")
        expect(send).to_be_visible(timeout=RUN_MS)
        send.click()
        expect(teacher.get_by_text("3 marks are in the course's gradebook")).to_be_visible()
        given = {who: score["scoreGiven"] for who, score in platform.scores.items()}
        assert given == {"a": 3, "b": 0, "c": 0}
        anna.reload()
        expect(anna.get_by_text("3 von 3 Punkten")).to_be_visible()

        # the same task for another course page: the choice is shown in the platform's language
        teacher.goto(course)
        teacher.get_by_role("button", name="link as Grace Teacher").click()
        teacher.get_by_role("button", name="Aufnehmen").click()
        expect(teacher.get_by_role("heading", name="Added")).to_be_visible()
        assert len(platform.linked) == 1
        for page in (teacher, anna):
            page.context.close()
    platform.close()
