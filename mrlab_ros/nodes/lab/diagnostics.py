"""Diagnostics of the lab node's services and of a restart."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

ROBOT_SPAWNED = Code(
    "robot_spawned",
    "{robot} stands at {place:position}.",
    severity=INFO,
    meaning="A robot was added to the scene.",
    page=False,
)
ROBOT_PLACED = Code(
    "robot_placed",
    "{robot} is placed.",
    severity=INFO,
    meaning="The base of a robot was moved.",
    page=False,
)
END_EFFECTOR_SET = Code(
    "end_effector_set",
    "{robot} carries {end_effector}.",
    severity=INFO,
    meaning="A robot was given an end effector.",
    page=False,
)
END_EFFECTOR_REMOVED = Code(
    "end_effector_removed",
    "{robot} carries no end effector.",
    severity=INFO,
    meaning="The end effector of a robot was taken off.",
    page=False,
)
ROBOT_REMOVED = Code(
    "robot_removed",
    "{robot} is removed.",
    severity=INFO,
    meaning="A robot was taken out of the scene.",
)
SCENE_SAVED = Code(
    "scene_saved",
    "Saved {robots:count robot|robots}, {objects:count object|objects}, {surfaces:count "
    "surface|surfaces}, {systems:count system|systems} in {file}[; {missing:problem}].",
    severity=INFO,
    meaning="The scene was written to a file.",
    page=False,
)
NO_PHYSICS_TO_SAVE = Code(
    "no_physics_to_save",
    "objects and surfaces are left out: no physics runs",
    severity=INFO,
    meaning="A scene was saved in a lab without physics.",
    page=False,
)
SCENE_LOADED = Code(
    "scene_loaded",
    "Loaded {scene}: {robots:count robot|robots}[, {objects:count object|objects}]"
    "[, {surfaces:count surface|surfaces}][, {systems:count system|systems}]"
    "[; {missing:problem}].",
    severity=INFO,
    meaning="A scene took the place of what was there.",
)
NO_PLAYBACK_RUNS = Code(
    "no_playback_runs",
    "No playback runs, which the trajectories of the scene need.",
    meaning="The nodes that play trajectories are not there.",
)
NO_COORDINATOR_RUNS = Code(
    "no_coordinator_runs",
    "No coordinator runs, which the systems of the scene need.",
    meaning="The node that commands systems is not there.",
)
ROBOTS_STAY = Code(
    "robots_stay",
    "Waited {limit:time} for the playback and the physics of {robots:list} to end.",
    meaning="Other nodes still have robots that the lab has removed.",
)
PLAYBACKS_MISSING = Code(
    "playbacks_missing",
    "Waited {limit:time} for the playbacks of {robots:list}.",
    meaning="Robots that a system or the last run needs have no playback yet.",
)
GRASPS_MISSING = Code(
    "grasps_missing",
    "Waited {limit:time} for {robots:list} to hold {objects:list}.",
    meaning="Physics did not announce the grasps of a scene.",
)
NOT_AS_BEFORE = Code(
    "not_as_before",
    "The lab is not as it was:{all:problems}",
    severity=WARNING,
    meaning="A restart could not bring back all of the last run.",
)
ROBOT_LEFT_OUT = Code(
    "robot_left_out",
    "{robot} is left out: {why:problem}.",
    severity=WARNING,
    meaning="A robot of the last run cannot be brought back.",
)
SYSTEM_LEFT_OUT = Code(
    "system_left_out",
    "The system {system} is left out: its robots are not all there.",
    severity=WARNING,
    meaning="A system of the last run cannot be brought back.",
)
