"""The room's page as somebody with an emulated Quest 3 uses it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from browser_side import DEADLINE_MS, eventually
from playwright.sync_api import BrowserContext, Page

HERE = Path(__file__).parents[2]
IWER = HERE.parent / "web" / "node_modules" / "iwer" / "build" / "iwer.min.js"
BOARD = "room.board"

# Turns the right controller, held at the hip, to a place of the scene.
AIM = """place => {
  const hand = headset.device.controllers.right
  const from = [0.2, 1.35, -0.2]
  const to = place.map((value, i) => value - from[i])
  const length = Math.hypot(...to)
  const yaw = Math.atan2(-to[0], -to[2]) / 2
  const pitch = Math.asin(to[1] / length) / 2
  hand.position.set(...from)
  hand.quaternion.set(
    Math.cos(yaw) * Math.sin(pitch), Math.sin(yaw) * Math.cos(pitch),
    -Math.sin(yaw) * Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch))
}"""

# Puts the tip of a hand's finger, or of its controller, at a place of the scene.
REACH = """([side, place]) => {
  const { device } = headset
  const inputs = [...room.visit.inputs.sources.values()]
  const { touch } = inputs.find(({ source }) => source.handedness === side)
  const held = device.primaryInputMode === 'hand' ? device.hands[side] : device.controllers[side]
  const { x, y, z } = held.position
  const [a, b, c] = place.map((value, i) => value - touch.place.toArray()[i])
  held.position.set(x + a, y + b, z + c)
}"""


class Headset:
    """A page with an emulated headset in a made-up room; nothing is drawn."""

    def __init__(self, context: BrowserContext, url: str) -> None:
        context.add_init_script(path=HERE / "no_webgl.js")
        context.add_init_script(path=IWER)
        context.add_init_script(path=HERE / "emulated_headset.js")
        self.page: Page = context.new_page()
        self.page.set_default_timeout(DEADLINE_MS)
        self.page.goto(f"{url}/room?inspect")
        self.wait_for("window.room && room.follower.known.value")

    def wait_for(self, condition: str) -> None:
        eventually(self.page, lambda: bool(self.page.evaluate(f"Boolean({condition})")))

    def frames(self, count: int = 3) -> None:
        now = self.page.evaluate("room.frames")
        self.wait_for(f"room.frames >= {now + count}")

    def enter(self) -> None:
        self.page.get_by_role("button", name="Enter the room").dispatch_event("click")
        self.wait_for("room.inside.value && room.frames > 3")

    def act(self, panel: str, zone: str) -> None:
        """Press a part of a panel without aiming at it."""
        self.wait_for(f"{panel}?.panel.ids.includes('{zone}')")
        assert self.page.evaluate(f"{panel}.panel.act('{zone}')")

    def point(self, panel: str, zone: str, share: float = 0.5) -> None:
        """Point the ray at a part of a panel."""
        self.wait_for(f"{panel}.panel.ids.includes('{zone}')")
        place = self.page.evaluate(f"{panel}.panel.centre('{zone}', {share}).toArray()")
        self.page.evaluate(AIM, place)
        self.frames()

    def trigger(self, pulled: bool, side: str = "right") -> None:
        value = 1 if pulled else 0
        controller = f"headset.device.controllers.{side}"
        self.page.evaluate(f"{controller}.updateButtonValue('trigger', {value})")
        self.frames()

    def press(self, panel: str, zone: str) -> None:
        self.point(panel, zone)
        self.trigger(True)
        self.trigger(False)

    def choose(self, panel: str, zone: str) -> None:
        """Press a row of a list, on whichever of its pages it is."""
        self.wait_for(f"{panel}.panel.ids.some((id) => id.startsWith('choose '))")
        while zone not in self.page.evaluate(f"{panel}.panel.ids"):
            self.press(panel, "next")
        self.press(panel, zone)

    def place(self, card: str, x: float, y: float, height: float) -> None:
        """Choose a card of the board, aim at a place of the lab, m, and pull the trigger."""
        self.act(BOARD, card)
        self.wait_for("room.placing.active")
        to = f"room.stage.world.localToWorld(room.head.clone().set({x}, {y}, {height}))"
        self.page.evaluate(AIM, self.page.evaluate(f"{to}.toArray()"))
        self.wait_for("room.placing.pose !== null")
        self.frames()
        self.trigger(True)
        self.trigger(False)
        self.wait_for("!room.placing.active")

    def reach_for(self, place: Sequence[float], away: float = 0.5, side: str = "right") -> None:
        """Hold a controller so that a place lies straight ahead of it, m."""
        x, y, z = place
        hand = f"headset.device.controllers.{side}"
        self.page.evaluate(
            f"{hand}.position.set({x}, {y}, {z + away}); {hand}.quaternion.set(0, 0, 0, 1)"
        )
        self.frames()

    def reach(self, place: Sequence[float], side: str = "right") -> None:
        """Move the tip of a finger, or of a controller, to a place of the scene."""
        for _ in range(2):  # the tip turns with nothing, but it is read a frame later
            self.page.evaluate(REACH, [side, list(place)])
            self.frames(2)

    def arm(self, robot: str) -> list[float]:
        """Return a place on a robot's arm, its elbow, in the scene."""
        found: list[float] = self.page.evaluate(
            f"room.scene.robot('{robot}').root.links.forearm_link"
            ".getWorldPosition(room.head.clone()).toArray()"
        )
        return found

    def touch(self, robot: str) -> None:
        """Touch a robot's stretched arm from above and go away again."""
        x, y, z = self.arm(robot)
        for away in (0.18, 0.12, 0.02, 0.14, 0.5):
            self.reach((x, y + away, z))

    def state(self, robot: str = "ur5e_1") -> str:
        found: str = self.page.evaluate(
            f"room.follower.robots.value.find(v => v.robot.name === '{robot}')?.state ?? ''"
        )
        return found

    def reaches(self, state: str, robot: str = "ur5e_1") -> None:
        eventually(self.page, lambda: self.state(robot) == state)
