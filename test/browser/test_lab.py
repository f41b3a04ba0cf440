"""The page of the running lab: what moves there is seen, and stops where a person says so."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
from browser_side import DEADLINE_MS, difference, eventually, pixels
from playwright.sync_api import Browser, expect
from served_lab import MRLAB, ServedLab

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"


def test_a_robot_that_plays_moves_and_is_paused(browser: Browser, lab: ServedLab) -> None:
    context = browser.new_context(
        viewport={"width": 900, "height": 600}, color_scheme="light", reduced_motion="reduce"
    )
    page = context.new_page()
    page.set_default_timeout(DEADLINE_MS)
    page.goto(lab.signed_in_url("/lab"))
    card = page.get_by_role("article", name="ur5e_1")
    expect(card).to_be_visible(timeout=DEADLINE_MS)
    canvas = page.locator("canvas")
    eventually(page, lambda: len(np.unique(pixels(canvas).reshape(-1, 3), axis=0)) > 400)
    player = subprocess.Popen(
        [*MRLAB, "play", "ur5e_1", str(MOTION)],
        env=lab.environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        pause = page.get_by_role("button", name="Pause all")
        expect(pause).to_be_enabled(timeout=DEADLINE_MS)
        before = pixels(canvas)
        eventually(page, lambda: difference(before, pixels(canvas)) > 0.004)
        # it may be over before it is paused: then there is nothing left to pause
        if pause.is_enabled():
            pause.click()
        expect(pause).to_be_disabled(timeout=DEADLINE_MS)
    finally:
        player.terminate()
        player.wait()
    page.get_by_role("button", name="Keys").click()
    row = page.get_by_role("row", name="ur5e_1/joint_states")
    expect(row).to_contain_text("sensor_msgs/JointState")
    context.close()
