"""Where things stand in the room: on aimed points, in two headsets, after a loss, and panels.

A real lab; Chromium with emulated Quest 3s, in furnished rooms made up from a seed: tables
of any height and direction, a sofa. Measured is what the lab says afterwards, in coordinates of
the real room. The emulation tracks perfectly: what a headset adds is not in it.
"""

from __future__ import annotations

import math
import random
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from lab import ROOT
from size import Size

sys.path[:0] = [str(ROOT / "test" / "support" / folder) for folder in ("labs", "pages")]

from measures.gateway import chromium  # noqa: E402
from room_side import AIM, BOARD, Headset  # noqa: E402
from served_lab import ServedLab, served_lab  # noqa: E402

NEEDS = ("chromium", "playwright")
SEED = 33
# Puts planes into the emulated room in place of those that it has. y of a pose is up.
FURNISH = """things => {
  headset.planes.clear()
  for (const { x, z, label, at, turn } of things) {
    headset.planes.add(headset.plane(x, z, label, { x: at[0], y: at[1], z: at[2] },
      { x: 0, y: Math.sin(turn / 2), z: 0, w: Math.cos(turn / 2) }))
  }
}"""
# The base of a robot as the lab has it, in the floor space of the headset: x, y, z, heading.
STANDS = """name => {
  const view = room.follower.robots.value.find(({ robot }) => robot.name === name)
  if (view === undefined) return null
  const { position: p, orientation: q } = view.robot.pose
  const at = room.stage.world.localToWorld(room.head.clone().set(p.x, p.y, p.z))
  return [...at.toArray(), 2 * Math.atan2(q.z, q.w)]
}"""
GHOST = """() => {
  const { pose } = room.placing
  return pose === null ? null : 2 * Math.atan2(pose.orientation.z, pose.orientation.w)
}"""
NAMES = "[...room.handles.keys()].sort()"
# The largest part of the points along an arm that a robot's panel hides, and that the board hides,
# 0 to 1.
COVERED = """() => {
  const eyes = room.head
  const board = room.board.panel.group
  const most = [0, 0]
  const panels = room.stage.panels.children.filter((group) =>
    group.visible && group !== room.caption.panel.group)
  for (const links of room.robots.links()) {
    const points = []
    for (const link of links) {
      const from = link.parent?.parent
      if (from == null) continue
      const a = eyes.clone().setFromMatrixPosition(link.matrixWorld)
      const b = eyes.clone().setFromMatrixPosition(from.matrixWorld)
      // by length: frames without one are at the tool
      const count = Math.round(a.distanceTo(b) / 0.02)
      for (let i = 0; i < count; i++) points.push(a.clone().lerp(b, (i + 0.5) / count))
    }
    for (const group of panels) {
      const { parameters } = group.children[0]?.geometry ?? {}
      if (parameters?.width === undefined) continue
      const hidden = points.filter((point) => {
        const way = point.clone().sub(eyes)
        const [o, p] = [eyes, point].map((each) => group.worldToLocal(each.clone()))
        const t = o.z / (o.z - p.z)
        if (!(t > 0 && t < 1) || way.length() < 1e-6) return false
        const [x, y] = [o.x + t * (p.x - o.x), o.y + t * (p.y - o.y)]
        return Math.abs(x) < parameters.width / 2 && Math.abs(y) < parameters.height / 2
      })
      const which = group === board ? 1 : 0
      if (points.length > 0) most[which] = Math.max(most[which], hidden.length / points.length)
    }
  }
  return most
}"""
# Anchors of earlier sessions are not tracked before a time, and refused so often.
LOSE = """([seconds, refusals]) => {
  window.restored = new WeakSet()
  window.trackedAt = Infinity
  const { restorePersistentAnchor } = XRSession.prototype
  XRSession.prototype.restorePersistentAnchor = async function (handle) {
    window.trackedAt = Math.min(window.trackedAt, performance.now() + 1000 * seconds)
    if (refusals-- > 0) throw new DOMException('busy', 'OperationError')
    const anchor = await restorePersistentAnchor.call(this, handle)
    window.restored.add(anchor.anchorSpace)
    return anchor
  }
  const { getPose } = XRFrame.prototype
  XRFrame.prototype.getPose = function (space, base) {
    const lost = window.restored.has(space) && performance.now() < window.trackedAt
    return lost ? undefined : getPose.call(this, space, base)
  }
}"""


def furnished(rng: random.Random) -> list[dict[str, Any]]:
    """Return a room: a floor, two tables and a sofa around the middle."""
    found = [{"x": 3.5, "z": 3.5, "label": "floor", "at": [0.0, 0.0, 0.0], "turn": 0.0}]
    for label, bearing in (("table", -0.6), ("table", 0.7), ("couch", 2.4)):
        away, angle = rng.uniform(1.3, 2.0), bearing + rng.uniform(-0.3, 0.3)
        high = 0.42 if label == "couch" else rng.choice((0.45, 0.72, 0.74, 0.9))
        found.append(
            {
                "x": rng.uniform(0.4, 0.8),
                "z": rng.uniform(0.3, 0.45),
                "label": label,
                "at": [away * math.sin(angle), high, -away * math.cos(angle)],
                "turn": rng.uniform(-math.pi, math.pi),
            }
        )
    return found


@contextmanager
def entered(browser: Any, lab: ServedLab, things: list[dict[str, Any]]) -> Iterator[Headset]:
    """Yield a headset inside a room."""
    context = browser.new_context(locale="en-GB")
    context.new_page().goto(lab.signed_in_url())
    made = Headset(context, lab.url)
    made.page.evaluate(FURNISH, things)
    made.enter()
    made.page.evaluate("room.guide.panel.panel.act('skip_tour')")
    made.wait_for("room.alignment.aligned && room.common.aligned")
    made.wait_for("room.surfaces.some(({ label }) => label === 'table')")
    yield made
    context.close()


def placing(browser: Any, lab: ServedLab, rng: random.Random, count: int) -> list[dict[str, Any]]:
    """Place robots on points of floors and tables by the ray; return how far off they stand."""
    off, turned, there = [], [], 0
    each = min(count, 5)
    while there < count:
        things = furnished(rng)
        with entered(browser, lab, things) as made:
            page = made.page
            for _ in range(each):
                before = set(page.evaluate(NAMES))
                made.act(BOARD, "tab robots")
                if "robot ur5e" not in page.evaluate("room.board.panel.ids"):
                    made.act(BOARD, "next")
                made.act(BOARD, "robot ur5e")
                made.wait_for("room.placing.active")
                aimed = _aim(made, rng, things)
                heading = page.evaluate(GHOST)
                made.trigger(True)
                made.trigger(False)
                made.wait_for(f"room.handles.size > {len(before)}")
                (name,) = set(page.evaluate(NAMES)) - before
                x, y, z, stands = page.evaluate(STANDS, name)
                off.append(1000 * math.dist(aimed, (x, y, z)))
                turned.append(abs(math.degrees(math.remainder(stands - heading, math.tau))))
                there += 1
                lab.done("remove", name)
                made.wait_for(f"room.handles.size === {len(before)}")
    good = sum(a <= 10 and b <= 2 for a, b in zip(off, turned, strict=True))
    return [
        _row(
            "robots within 10 mm and 2 degrees of the aimed point", good, "", f"{there} of {there}"
        ),
        _row("robot from the aimed point, most", max(off), "mm", "< 10"),
        _row("robot from the heading of its ghost, most", max(turned), "degrees", "< 2"),
    ]


def _aim(made: Headset, rng: random.Random, things: list[dict[str, Any]]) -> list[float]:
    """Aim at a place where a robot may stand; return it, in the floor space."""
    tables = [each for each in things if each["label"] == "table"]
    for trial in range(60):
        if trial % 2:
            point = [rng.uniform(-1.8, 1.8), 0.0, rng.uniform(-2.4, -0.8)]
        else:
            table = rng.choice(tables)
            cos, sin = math.cos(table["turn"]), math.sin(table["turn"])
            u = rng.uniform(-0.4, 0.4) * table["x"]
            v = rng.uniform(-0.2, 0.2) * table["z"]
            x, y, z = table["at"]
            point = [x + u * cos + v * sin, y, z - u * sin + v * cos]
        made.page.evaluate(AIM, point)
        made.frames(4)
        hit = made.page.evaluate(
            "room.placing.pose === null ? null : room.stage.world.localToWorld(room.head.clone()"
            ".set(room.placing.land.x, room.placing.land.y, room.placing.land.z)).toArray()"
        )
        # A table may stand before the point: then another one.
        if hit is not None and math.dist(hit, point) < 0.05:
            return point
    raise AssertionError("no free place in this room")


def touching(browser: Any, lab: ServedLab, rng: random.Random, count: int) -> list[dict[str, Any]]:
    """Align two headsets whose floor spaces differ; return how far apart they see one robot."""
    things = furnished(rng)
    exact, trembling, foreign = [], [], 0
    name = "ur5e_1"
    with entered(browser, lab, things) as first:
        for _ in range(count):
            yaw = rng.uniform(-math.pi, math.pi)
            east, south = rng.uniform(-2, 2), rng.uniform(-2, 2)

            def theirs(p: list[float], yaw: float = yaw, e: float = east, s: float = south) -> Any:
                """A place of the room in the second headset's own floor space."""
                x, y, z = p
                cos, sin = math.cos(yaw), math.sin(yaw)
                return [x * cos + z * sin + e, y, -x * sin + z * cos + s]

            moved = [
                {**each, "at": theirs(each["at"]), "turn": each["turn"] + yaw} for each in things
            ]
            marks = ([-1.0, 0.9, -0.4], [0.9, 0.9, -0.7])
            context = browser.new_context(locale="en-GB")
            context.new_page().goto(lab.signed_in_url())
            second = Headset(context, lab.url)
            second.page.evaluate(FURNISH, moved)
            second.enter()
            second.wait_for("room.people.present.length === 1")
            device = second.page.evaluate("localStorage['mrlab.room.device']")
            second.wait_for("room.scan.count > 2")
            second.frames(60)
            foreign += first.page.evaluate(
                f"room.surfaces.filter(({{ source }}) => source === '{device}').length"
            )
            for tremble, found in ((0.0, exact), (0.003, trembling)):
                seen = []
                for made, place in ((first, list), (second, theirs)):
                    _touch(made, [place(_shaken(rng, mark, tremble)) for mark in marks])
                    at = made.page.evaluate(STANDS, name)[:3]
                    seen.append(at)
                found.append(1000 * math.dist(theirs(seen[0]), seen[1]))
            context.close()
            first.wait_for("room.people.present.length === 0")
    return [
        _row("the same robot in two headsets that touched, most", max(exact), "mm", "< 15"),
        _row(
            "the same where hands are off by 3 mm (standard deviation)",
            max(trembling),
            "mm",
            "< 15",
        ),
        _row("surfaces of a headset in the other before that", foreign, "", "< 1"),
    ]


def _shaken(rng: random.Random, point: list[float], deviation: float) -> list[float]:
    return [value + rng.gauss(0.0, deviation) for value in point]


def _touch(made: Headset, points: list[list[float]]) -> None:
    made.act(BOARD, "tab room")
    made.act(BOARD, "align")
    for point in points:
        made.reach(point)
        made.trigger(True)
        made.trigger(False)
    made.wait_for("room.touching.awaited === 'nothing' && room.anchor.hold === 'kept'")
    made.frames()


def losing(browser: Any, lab: ServedLab, rng: random.Random) -> list[dict[str, Any]]:
    """Leave a kept place, and return to it while it is lost and refused."""
    context = browser.new_context(locale="en-GB")
    context.new_page().goto(lab.signed_in_url())
    made = Headset(context, lab.url)
    page = made.page
    page.evaluate(FURNISH, furnished(rng))
    made.enter()
    made.wait_for("room.anchor.hold === 'kept'")
    kept = page.evaluate("localStorage['mrlab.room.anchor']").split("\t")[0]
    before = page.evaluate(STANDS, "ur5e_1")
    page.evaluate("room.visit.leave()")
    made.wait_for("!room.inside.value")
    page.evaluate(LOSE, [6.5, 5])
    page.evaluate("headset.device.position.set(0.7, 1.6, 0.5)")
    made.enter()
    made.wait_for("room.anchor.canPutBack")
    held = kept in page.evaluate("localStorage['mrlab.room.anchor']")
    made.act(BOARD, "tab room")
    made.act(BOARD, "put_back")
    made.frames(5)
    off = 1000 * math.dist(before[:3], page.evaluate(STANDS, "ur5e_1")[:3])
    context.close()
    return [
        _row("handle kept over 6.5 s of lost tracking and 5 refusals", int(held), "", "> 0"),
        _row("the robot then, from where it stood before", off, "mm", "< 1"),
    ]


def covering(
    browser: Any, lab: ServedLab, rng: random.Random, count: int, frames: int
) -> list[dict[str, Any]]:
    """Stand at random places before four robots; return what panels hide of one.

    frames: after which panels stand where they come to rest.
    """
    for _ in range(3):
        lab.done("spawn", "ur5e")
    found, boards = [], []
    with entered(browser, lab, furnished(rng)) as made:
        page = made.page
        made.wait_for("room.handles.size === 4 && room.panels.names.length === 4")
        for _ in range(count):
            around, away = rng.uniform(-math.pi, math.pi), rng.uniform(1.2, 3.0)
            x, z = away * math.sin(around), -1.0 + away * math.cos(around)
            page.evaluate(
                "([x, y, z, yaw]) => { headset.device.position.set(x, y, z);"
                " headset.device.quaternion.set(0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2)) }",
                [x, rng.uniform(1.2, 1.8), z, math.atan2(x, z + 1.0)],
            )
            name = rng.choice(page.evaluate(NAMES))
            page.evaluate(f"room.opened.open('{name}')")
            made.frames(frames)
            panel, by_board = page.evaluate(COVERED)
            found.append(100 * panel)
            boards.append(100 * by_board)
    share = sum(each <= 10 for each in found)
    return [
        _row("scenes in which no panel hides 10 % of a robot", share, "", f"{count} of {count}"),
        _row("of a robot behind a robot's panel, most", max(found), "%", "< 10"),
        _row("the same, mean", sum(found) / count, "%", "< 10"),
        _row("of a robot behind the board, mean", sum(boards) / count, "%", ""),
    ]


def _row(figure: str, value: float, unit: str, mark: str) -> dict[str, Any]:
    return {"figure": figure, "value": value, "unit": unit, "mark": mark}


def marks(size: Size) -> list[dict[str, Any]]:
    rng = random.Random(SEED)
    with (
        tempfile.TemporaryDirectory() as name,
        served_lab(Path(name)) as lab,
        chromium() as browser,
    ):
        lab.done("scene", "load", "empty")
        rows = placing(browser, lab, rng, size.of(1, 5, 20))
        lab.done("spawn", "ur5e", "--at", "0.6,0.4")
        rows += touching(browser, lab, rng, size.of(1, 2, 5))
        rows += losing(browser, lab, rng)
        return rows + covering(browser, lab, rng, *size.of((1, 15), (10, 150), (50, 150)))


TABLES = {"The room: where robots stand, in made-up furnished rooms": marks}
SOAKS: dict[str, Any] = {}
