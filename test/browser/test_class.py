"""The page on which a teacher steps through a class."""

from __future__ import annotations

import re
from pathlib import Path

from browser_side import eventually
from class_folder import make_class
from page_objects import ClassPage, SignInPage
from playwright.sync_api import Browser, expect
from served_lab import ServedLab, gateway_with_people

from mrlab_ros.core.bridge.rules import Role

PASSWORD = "long enough to be one"


def test_a_teacher_steps_through_a_class_and_a_student_does_not(
    plain_browser: Browser, lab: ServedLab, tmp_path: Path
) -> None:
    folder = make_class(tmp_path / "class", frames=200)
    option = ("--classroom", str(folder))
    with gateway_with_people(lab, tmp_path, 0, *option) as gateway:
        student = plain_browser.new_context(locale="en-GB").new_page()
        SignInPage(student).accept(gateway.invite("greta", Role.STUDENT), PASSWORD)
        main = student.get_by_role("navigation", name="Main")
        expect(main.get_by_role("link", name="Lab")).to_be_visible()
        expect(main.get_by_role("link", name="Class")).to_have_count(0)
        student.goto(f"{gateway.url}/class")
        expect(
            student.get_by_text("greta is a student, and this needs an instructor")
        ).to_be_visible()
        student.context.close()

        page = plain_browser.new_context(locale="en-GB").new_page()
        SignInPage(page).accept(gateway.invite("grace", Role.INSTRUCTOR), PASSWORD)
        page.get_by_role("link", name="Class").click()
        shown = ClassPage(page)
        shown.expect_shown("Anna")
        expect(page.get_by_role("button", name="Previous")).to_be_disabled()
        page.keyboard.press("n")
        shown.expect_shown("Ben")
        assert page.evaluate("scrollY") == 0  # the motion stays in view
        expect(page.get_by_text("0.5 of 3 points")).to_be_visible()
        expect(shown.marks).to_contain_text("Lift it")
        timeline = page.get_by_label("Time", exact=True)
        expect(timeline).to_be_visible()
        expect(page.get_by_text("the solution, a ghost in 3D")).to_be_visible()
        expect(page.locator(".scene-mark-error").first).to_have_attribute(
            "title", re.compile("no collision: .* touches .* cube_1 at 0.20 s")
        )
        shown.marks.get_by_role("button", name="at 0.2 s").click()
        eventually(page, lambda: abs(float(timeline.input_value()) - 0.2) < 0.011)
        page.get_by_role("button", name="Play it in the lab").click()
        page.get_by_role("button", name="ur5e_1").click()
        expect(page.get_by_text("It is loaded on ur5e_1.")).to_be_visible()
        page.get_by_role("button", name="Next").click()
        shown.expect_shown("Cleo")
        expect(page.get_by_text("cleo.pdf")).to_be_visible()
        page.reload()
        shown.expect_shown("Cleo")
        page.get_by_text("Fewest points first").click()
        page.keyboard.press("n")
        shown.expect_shown("Ben")
        page.context.close()
