"""An emulated headset in a furnished room, of which pictures are taken."""

from __future__ import annotations

import io
import time
from collections.abc import Sequence
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Page, Route

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).parent
MODULES = ROOT / "web" / "node_modules"
THREE = MODULES / "three" / "build"
# s for what the page waits for: software draws some frames a second.
PATIENCE = 240
# Frames in which panels come to where they are read, after the eyes moved.
SETTLED = 90

LOOK = """([eyes, at]) => {
  const [x, y, z] = at.map((value, i) => value - eyes[i])
  const [yaw, pitch] = [Math.atan2(-x, -z) / 2, Math.atan2(y, Math.hypot(x, z)) / 2]
  headset.device.position.set(...eyes)
  headset.device.quaternion.set(
    Math.cos(yaw) * Math.sin(pitch), Math.sin(yaw) * Math.cos(pitch),
    -Math.sin(yaw) * Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch))
}"""
# x of the lab points along (toX, toZ) of the room.
STAND = """([x, z, toX, toZ]) => {
  const half = Math.atan2(-toX, -toZ) / 2
  room.anchor.put(
    room.head.clone().set(x, 0, z), room.look.clone().set(0, Math.sin(half), 0, Math.cos(half)))
}"""
# Software draws a picture in seconds: all but those that are kept only go on.
REST = """() => {
  const { stage } = room
  const [draw, furniture] = [stage.draw.bind(stage), headset.device.sem.render]
  window.drawing = false
  stage.draw = now => {
    if (window.drawing) return draw(now)
    stage.scene.updateMatrixWorld()
    return true
  }
  headset.device.sem.render = now => { if (window.drawing) furniture(now) }
}"""
HERE_NOW = """room.handles.size > 0 && [...room.handles.keys()].every(name => {
  const robot = room.scene.robot(name)
  return robot?.meshCount > 5 && robot.meshesHere === robot.meshCount
})"""


class EmulatedRoom:
    """The page of the room as somebody in a furnished room sees it."""

    def __init__(self, browser: Browser, size: tuple[int, int]) -> None:
        self.page: Page = browser.new_page(
            viewport={"width": size[0], "height": size[1]}, locale="en-GB", color_scheme="light"
        )
        self.page.set_default_timeout(PATIENCE * 1000)
        self.page.add_init_script(path=MODULES / "iwer" / "build" / "iwer.min.js")
        self.page.add_init_script(path=ROOT / "test" / "emulated_headset.js")
        self.page.route("**/furnished/*", _serve)

    def enter(self, sign_in: str, url: str) -> None:
        """Open the page, furnish the room and enter; hands rest below what is seen."""
        self.page.goto(sign_in)
        self.page.goto(f"{url}/room?inspect")
        self.page.evaluate(
            "import('/furnished/furnished_room.js').then(({ furnish }) => { furnish(headset) })"
        )
        self.settle()
        self.page.evaluate(REST)
        self.page.get_by_role("button", name="Enter the room").dispatch_event("click")
        # the scene was put before the eyes: from now on it stays where it is put
        self.until("room.inside.value && room.alignment.aligned")
        self.page.evaluate("room.guide.panel.panel.act('skip_tour')")
        self.hands(None)

    def until(self, condition: str) -> None:
        """Wait until a condition holds in the page; raises SystemExit where it does not."""
        end = time.monotonic() + PATIENCE
        while not self.page.evaluate(f"Boolean({condition})"):
            if time.monotonic() > end:
                raise SystemExit(f"it took too long until {condition}")
            time.sleep(0.1)

    def settle(self) -> None:
        """Wait until all robots of the lab are drawn whole."""
        self.until(f"window.room && {HERE_NOW}")

    def frames(self, count: int) -> None:
        """Wait until more pictures were drawn."""
        drawn = self.page.evaluate("room.frames")
        self.until(f"room.frames > {drawn + count}")

    def look(
        self, eyes: Sequence[float], at: Sequence[float], angle: float = 66, settle: bool = True
    ) -> None:
        """Look from one place of the room at another, m. angle: of view, upright, degrees."""
        self.page.evaluate(f"headset.device.fovy = {angle} * Math.PI / 180")
        self.page.evaluate(LOOK, [list(eyes), list(at)])
        if settle:
            self.frames(SETTLED)

    def stand(self, x: float, z: float, to_x: float, to_z: float) -> None:
        """Put the lab's origin on the floor, its x axis along a direction of the room."""
        self.page.evaluate(STAND, [x, z, to_x, to_z])

    def hands(self, right: Sequence[float] | None) -> None:
        """Hold the right controller somewhere, m; None: both are out of the picture."""
        place = [0.3, 0.2, 2.5] if right is None else list(right)
        self.page.evaluate(
            "([x, y, z]) => { headset.device.controllers.right.position.set(x, y, z);"
            " headset.device.controllers.left.position.set(-0.3, 0.2, 2.5) }",
            place,
        )

    def act(self, panel: str, *zones: str) -> None:
        """Press parts of a panel of the room."""
        for zone in zones:
            self.until(f"{panel}?.panel.act('{zone}')")

    def shot(self) -> Image.Image:
        """Return what is seen."""
        self.page.evaluate("window.drawing = true")
        self.frames(2)
        image = self.page.screenshot()
        self.page.evaluate("window.drawing = false")
        return Image.open(io.BytesIO(image)).convert("RGB")


def _serve(route: Route) -> None:
    """Answer with a script that no page of the lab has."""
    name = route.request.url.rsplit("/", 1)[1]
    folder = HERE if (HERE / name).exists() else THREE
    route.fulfill(body=(folder / name).read_text("utf-8"), content_type="text/javascript")
