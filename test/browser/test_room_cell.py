"""A cell in the room: a hand-over from one panel, recorded and played again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the headset's pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

CELL = Path(__file__).parents[2] / "examples" / "handover_cell.yaml"
PANEL = "room.systems.of('handover')"
LABEL = "room.follower.systems.value[0]?.system.label"
GIVER, TAKER = "ur5e_1", "kuka_kr6_r900_sixx_1"
# Notes who holds something, and who plays, in each frame in which that is new.
NOTES = """() => {
  window.notes = []
  let last = ''
  const look = () => {
    const robots = room.follower.robots.value
    const of = test => robots.filter(test).map(({ robot }) => robot.name).sort()
    const note = { holds: of(v => v.holding !== ''), plays: of(v => v.state === 'PLAYING') }
    const now = JSON.stringify(note)
    if (now !== last) window.notes.push(note)
    last = now
    setTimeout(look, 20)
  }
  look()
}"""


def test_a_cell_hands_over_and_its_recording_is_played_again(
    headsets: Callable[[], Headset], lab: ServedLab
) -> None:
    lab.done("scene", "load", "handover")
    lab.done("system", "create", str(CELL))
    headset = headsets()
    page = headset.page
    page.evaluate("headset.planes.clear()")  # the room's table would stand in the way
    headset.enter()
    headset.wait_for(f"{PANEL}?.panel.ids.includes('play')")
    headset.act(BOARD, "tab lab")
    headset.act(BOARD, "record")
    headset.wait_for("room.board.panel.ids.includes('end_recording')")

    # the rod goes from hand to hand
    page.evaluate(NOTES)
    headset.act(PANEL, "play")
    holds = "window.notes.map(({ holds }) => holds.join())"
    headset.wait_for(f"{holds}.includes('{TAKER}')")
    order = page.evaluate(holds)
    assert order.index(GIVER) < order.index(TAKER)
    assert page.evaluate("window.notes.some(({ plays }) => plays.length === 2)"), "both played"
    headset.act(PANEL, "stop")
    headset.wait_for(f"{LABEL} === 'READY'")

    # what was recorded is played again
    headset.act(BOARD, "end_recording")
    headset.act(BOARD, "replay 0")
    headset.wait_for("room.follower.replay.position() > 0.5")
    headset.act(BOARD, "end_replay")
    headset.wait_for("room.board.panel.ids.includes('record')")

    # as the lab began
    lab.done("scene", "load", "empty")
    lab.done("spawn", "ur5e")
