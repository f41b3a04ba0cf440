"""Diagnostics of the physics node's services."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

OBJECT_SPAWNED = Code(
    "object_spawned",
    "{object} is at {place:position}.",
    severity=INFO,
    meaning="An object was added to the scene.",
    page=False,
)
OBJECT_MOVED = Code(
    "object_moved",
    "{object} is {state:choice held=held|released=released}.",
    severity=INFO,
    meaning="An object was moved by a person.",
    page=False,
)
OBJECT_REMOVED = Code(
    "object_removed",
    "{object} is removed.",
    severity=INFO,
    meaning="An object was taken out of the scene.",
    page=False,
)
OBJECTS_REMOVED = Code(
    "objects_removed",
    "{count:count object is|objects are} removed.",
    severity=INFO,
    meaning="All objects were taken out of the scene.",
    page=False,
)
SURFACES_SET = Code(
    "surfaces_set",
    "The room has {count:count surface|surfaces}[; {inside:list} stand in a robot and count once "
    "it has moved out of them].",
    severity=INFO,
    meaning="The surfaces of the room were set.",
    page=False,
)
OBJECT_ATTACHED = Code(
    "object_attached",
    "{robot} holds {object}.",
    severity=INFO,
    meaning="An object was attached to a robot's hand.",
    page=False,
)
OBJECT_DETACHED = Code(
    "object_detached",
    "{robot} let go of {object}.",
    severity=INFO,
    meaning="An object was detached from a robot's hand.",
    page=False,
)
CONTENTS_SET = Code(
    "contents_set",
    "{objects:count object|objects} and {surfaces:count surface|surfaces} are set.",
    severity=INFO,
    meaning="All objects and surfaces were replaced.",
    page=False,
)
CONTENTS_FIT = Code(
    "contents_fit",
    "{objects:count object|objects} and {surfaces:count surface|surfaces} can be set.",
    severity=INFO,
    meaning="A dry run found nothing wrong with objects and surfaces.",
    page=False,
)
CONTENTS_NOT_BACK = Code(
    "contents_not_back",
    "Left out of the last run:{all:problems}",
    severity=WARNING,
    meaning="Objects or surfaces of the last run cannot be brought back.",
)
TOO_MANY_OBJECTS = Code(
    "too_many_objects",
    "{count:count object is|objects are} too many; expected {most:integer} at most (max_objects "
    "of config/physics.yaml).",
    meaning="More objects were to be set than may be active at once.",
)
CANNOT_HOLD_FIXED = Code(
    "cannot_hold_fixed",
    "{robot} cannot hold {object}: it is fixed to the room.",
    meaning="An object that never moves was to be in a robot's hand.",
)
