"""The kinds of grippers, a row each: how they find an object, hold it and lose it.

A new kind is a row of KINDS; an end effector names its kind under `gripper` of
`robots/end_effectors/<id>/end_effector.yaml`. No other code asks for a kind by its name.
"""

from __future__ import annotations

from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.physics.diagnostics import (
    CAME_OFF_CUP,
    CAME_OFF_MAGNET,
    SIDE_OF_CUP,
    SIDE_OF_MAGNET,
)

# Coefficient of a rubber pad; an object's own coefficient is multiplied with it, as in the engine.
PAD_FRICTION = 1.5
# The same of a bare steel face.
FACE_FRICTION = 0.5
# The same of a dry cup: suppliers reckon with 0.5 on metal, glass, wood (VDI 2259 tables).
CUP_FRICTION = 1.0


@dataclass(frozen=True)
class Gripper:
    """One kind of gripper.

    closes: its fingers close on an object until they stall. pulls: its face pulls an object that
    it touches; the object comes off at once where the force does not suffice, instead of sliding.
    seals: its face holds only where its whole lip lies on the object. friction: at its contacts,
    a factor on that of the object's surface. yields: m by which its face gives way to an object;
    0: as `set_down` of the settings. beside: an object touches another side of its face alone;
    came_off: an object came off its face.
    """

    name: str
    closes: bool = False
    pulls: bool = False
    seals: bool = False
    friction: float = PAD_FRICTION
    yields: float = 0.0
    beside: Code = SIDE_OF_CUP
    came_off: Code = CAME_OFF_CUP


NONE = Gripper("none")
FINGERS = Gripper("fingers", closes=True)
CUP = Gripper("cup", pulls=True, seals=True, friction=CUP_FRICTION, yields=0.005)
MAGNET = Gripper(
    "magnet",
    pulls=True,
    friction=FACE_FRICTION,
    beside=SIDE_OF_MAGNET,
    came_off=CAME_OFF_MAGNET,
)
KINDS = {kind.name: kind for kind in (NONE, FINGERS, CUP, MAGNET)}
