"""Diagnostics of a lab's robots and their runs for a client."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

HALTED = Code(
    "halted",
    "{robot} was halted by a collision[: {why:problem}].",
    "Stop it, which takes its arm back to the first frame. So that it does not happen again, "
    "place the robot elsewhere, or take away what it touches. Then play on.",
    meaning="A run ended in a collision halt.",
)
MOVES_ALREADY = Code(
    "moves_already",
    "{robot} moves: {why:problem}.",
    "Stop it first, then play the other motion.",
    meaning="A motion was to be loaded or played while the robot moves; it was left alone.",
    commands=("mrlab stop {robot}",),
)
STILL_HALTED = Code(
    "still_halted",
    "{robot} is still in its collision halt[ ({why:problem})], which ends once its arm has been "
    "clear for a moment.",
    "Where the arm touches something still, take that away, or place the robot elsewhere. Then "
    "play on.",
    meaning="A robot that was stopped or moved in a halt waits until its arm is clear.",
)
PLAYBACK_GONE = Code(
    "playback_gone",
    "The playback of {robot} was restarted, or stood aside for a replay.",
    "Look where the robot stands, and play on from there.",
    meaning="A run was interrupted by the end of its process.",
    commands=("mrlab status", "mrlab resume {robot}"),
)
ENDED_EARLY = Code(
    "ended_early",
    "{robot} ended before its last frame[: {why:problem}].",
    meaning="A run was stopped.",
)
DOES_NOT_MOVE = Code(
    "does_not_move",
    "{robot} accepted play but does not move after {timeout:time}.",
    meaning="Nothing was heard of a run that was begun.",
    commands=("mrlab status",),
)
RUN_SILENT = Code(
    "run_silent",
    "{robot} moved and has said nothing for {silent:integer} s: it was removed, or its part of "
    "the lab has ended.",
    meaning="A robot that moves reports several times a second.",
    commands=("mrlab status",),
)
BAD_BASE_PLACE = Code(
    "bad_base_place",
    "at is {found}; expected x and y, m, such as (1.0, 0.5).",
    meaning="Where a robot is to stand.",
)
NO_SINGLE_BAG = Code(
    "no_single_bag",
    "{folder} holds {found:integer} recorded files; expected one.",
    "Name the file itself.",
    meaning="A folder was given in the place of a file to convert.",
)
NAME_A_ROBOT = Code(
    "name_a_robot",
    "Which robot is meant is not said; the lab has {robots:list}.",
    "Name one of them.",
)
