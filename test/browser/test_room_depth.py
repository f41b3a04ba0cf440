"""Robots are hidden behind real things where the headset measures depth and somebody wants it."""

from __future__ import annotations

from pathlib import Path

import pytest
from browser_side import DEADLINE_MS, eventually
from playwright.sync_api import Browser, StorageState
from served_lab import ServedLab

# Software draws the headset's pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

HERE = Path(__file__).parents[1]
IWER = HERE.parent / "web" / "node_modules" / "iwer" / "build" / "iwer.min.js"

# Looks at the middle of a robot, the head to one side: a stretched arm then crosses the picture.
LOOK = """() => {
  const [name] = room.handles.keys()
  const links = Object.values(room.scene.robot(name).root.links)
  const middle = room.head.clone().set(0, 0, 0)
  for (const link of links) middle.add(link.getWorldPosition(room.head.clone()))
  const { device } = headset
  const { x, y, z } = middle.divideScalar(links.length).sub(device.position)
  const turn = (about, angle) => room.look.clone().setFromAxisAngle(about, angle)
  const [across, up, along] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(
    ([a, b, c]) => room.head.clone().set(a, b, c))
  const look = turn(up, Math.atan2(-x, -z))
    .multiply(turn(across, Math.atan2(y, Math.hypot(x, z)))).multiply(turn(along, 0.8))
  device.quaternion.set(look.x, look.y, look.z, look.w)
}"""
# Draws robots alone, and after each picture counts what is drawn in its upper and its lower half.
COUNT = """() => {
  const { stage } = room
  const gl = stage.renderer.getContext()
  const draw = stage.draw.bind(stage)
  stage.panels.visible = false
  stage.setGrid(false)
  stage.draw = now => {
    stage.world.traverse(node => { if (node.type === 'Sprite') node.visible = false })
    for (const { model } of room.visit.inputs.sources.values()) model.group.visible = false
    const drawn = draw(now)
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl
    const pixels = new Uint8Array(width * height * 4)
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels)
    const found = [0, 0]
    for (let i = 0; i < width * height; i++) {
      if (pixels[i * 4 + 3] > 200) found[i < (width * height) / 2 ? 1 : 0]++
    }
    window.halves = found
    return drawn
  }
}"""


def test_a_real_thing_hides_the_robot_behind_it(
    browser: Browser, signed_in: StorageState, lab: ServedLab
) -> None:
    # one robot that stands, whatever other tests left in the lab
    lab.done("scene", "load", "empty")
    lab.done("spawn", "ur5e")
    context = browser.new_context(
        viewport={"width": 320, "height": 240}, locale="en-GB", storage_state=signed_in
    )
    for script in (IWER, HERE / "emulated_headset.js"):
        context.add_init_script(path=script)
    context.add_init_script("localStorage['mrlab.room.occlusion'] = 'yes'")
    page = context.new_page()
    page.set_default_timeout(DEADLINE_MS)
    complaints: list[str] = []
    page.on("console", lambda each: each.type == "error" and complaints.append(each.text))
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{lab.url}/room?inspect")

    def wait_for(condition: str) -> None:
        eventually(page, lambda: bool(page.evaluate(f"Boolean({condition})")))

    wait_for("window.room && room.handles.size > 0")
    page.evaluate("headset.planes.clear()")  # the room's table would hide the robot, too
    page.get_by_role("button", name="Enter the room").dispatch_event("click")
    wait_for("room.inside.value && room.frames > 3")
    assert "depth-sensing" not in page.evaluate("room.visit.missing")
    # what is held is drawn as it is, with files of the page's own origin
    held = (
        "[...room.visit.inputs.sources.values()].map(({ model }) => model.group.children.length)"
    )
    wait_for(f"{held}.join() === '1,1'")
    assert all(url.startswith(lab.url) for url in asked if not url.startswith("blob:"))
    assert sum(url.endswith(".glb") and "/static/" in url for url in asked) == 2
    page.evaluate(LOOK)
    page.evaluate(COUNT)
    wait_for("window.halves && halves[0] > 60 && halves[1] > 60")
    upper, lower = page.evaluate("halves")

    def sees(depth: str, above: bool, below: bool) -> None:
        """Wait until each half shows the robot, or nearly nothing of it."""
        page.evaluate(f"headset.depth = {depth}")
        parts = ((0, upper, above), (1, lower, below))
        for half, whole, seen in parts:
            mark = f"> {0.9 * whole}" if seen else f"< {0.05 * whole}"
            wait_for(f"halves[{half}] {mark}")

    sees("(_, y) => (y < 0.5 ? 0.4 : 20)", above=False, below=True)
    sees("(_, y) => (y < 0.5 ? 20 : 0.4)", above=True, below=False)
    sees("() => 0", above=True, below=True)  # nothing was measured
    sees("() => 0.4", above=False, below=False)
    page.evaluate("room.settings.occlusion.toggle()")
    wait_for(f"halves[0] > {0.9 * upper} && halves[1] > {0.9 * lower}")
    assert complaints == []
    context.close()
