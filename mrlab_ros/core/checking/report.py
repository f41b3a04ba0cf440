"""The report of a check: a verdict, its grounds, and a hash by which two are equal."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mrlab_ros.core.checking.evidence import Clearance
from mrlab_ros.core.checking.findings import Finding, plain
from mrlab_ros.core.checking.hardware import CLAIM, Condition, State
from mrlab_ros.core.checking.recording import GraspChange
from mrlab_ros.core.checking.waypoints import Passed

SCHEMA = "mrlab.check.1"
READY, NOT_READY = "ready", "not_ready"
# Numbers of the report have so many decimals: a micrometre, a microsecond.
DECIMALS = 6


@dataclass(frozen=True)
class RobotReport:
    """What is said of one robot. figures: numbers by name, SI; joints: of each joint, by name."""

    name: str
    model: str
    end_effector: str
    trajectory: str = ""
    source: Mapping[str, str] = field(default_factory=dict)
    figures: Mapping[str, Any] = field(default_factory=dict)
    joints: Sequence[Mapping[str, Any]] = ()
    hardware: Sequence[Condition] = ()


@dataclass(frozen=True)
class CheckReport:
    """All that a check found. inputs: what it was computed from, digests of texts among it.

    extras: what only a cell has, as mappings for JSON.
    """

    title: str
    inputs: Mapping[str, Any]
    robots: Sequence[RobotReport]
    findings: tuple[Finding, ...]
    duration: float | None = None
    clearances: Sequence[Clearance] = ()
    grasps: Sequence[GraspChange] = ()
    points: Sequence[Passed] = ()
    extras: Mapping[str, Any] = field(default_factory=dict)

    @property
    def verdict(self) -> str:
        return NOT_READY if self.refusing else READY

    @property
    def refusing(self) -> tuple[Finding, ...]:
        return tuple(f for f in self.findings if f.refuses)

    @property
    def words(self) -> str:
        """Return the verdict in one sentence."""
        warned = len(self.findings) - len(self.refusing)
        if self.refusing:
            first = self.refusing[0]
            more = len(self.refusing) - 1
            rest = f", and {counted(more, 'more finding')} that {_refuse(more)}" if more else ""
            return f"not ready: {at(first)}{first.message.rstrip('.')}{rest}"
        unknown = sorted({c.name for r in self.robots for c in r.hardware if c.state is _U})
        words = "ready: nothing refuses it"
        if warned:
            words += f"; {counted(warned, 'warning')}"
        if unknown:
            words += f"; not known: {', '.join(unknown)}"
        return words

    def document(self) -> dict[str, Any]:
        """Return the report as JSON has it; `hash` is of all else in it."""
        document = _rounded(
            {
                "schema": SCHEMA,
                "title": self.title,
                "verdict": self.verdict,
                "summary": self.words,
                "inputs": dict(self.inputs),
                "duration": self.duration,
                "robots": [
                    {**vars(r), "hardware": [_condition(c) for c in r.hardware]}
                    for r in self.robots
                ],
                "findings": [plain(f) for f in self.findings],
                "clearances": [
                    {**vars(c), "kind": c.kind.name.lower(), "far": c.far} for c in self.clearances
                ],
                "grasps": [
                    {
                        "time": g.time,
                        "robot": g.robot,
                        "state": g.state.name.lower(),
                        "object": g.object,
                        "reason": str(g.reason or ""),
                        "mass": g.load.mass if g.load else None,
                    }
                    for g in self.grasps
                ],
                "points": [vars(p) for p in self.points],
                **self.extras,
                "claim": CLAIM,
            }
        )
        return {**document, "hash": digest(document)}


_U = State.UNKNOWN


def digest(document: Any) -> str:
    """Return the sha256 of what JSON can hold, however its mappings are ordered."""
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def counted(number: int, noun: str) -> str:
    """Return '1 finding' or '3 findings'."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def at(finding: Finding) -> str:
    """Return when a finding is, as words before it; empty: it has no instant."""
    return "" if finding.time is None else f"at {finding.time:.2f} s "


def _refuse(number: int) -> str:
    return "refuses" if number == 1 else "refuse"


def _condition(condition: Condition) -> dict[str, str]:
    return {
        "condition": condition.name,
        "state": condition.state.value,
        "words": condition.words,
    }


def _rounded(value: Any) -> Any:
    """Return plain mappings, lists and numbers: none that JSON cannot hold."""
    if isinstance(value, Mapping):
        return {str(key): _rounded(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(each) for each in value]
    if isinstance(value, bool) or value is None or isinstance(value, (int, str)):
        return value
    number = float(value)
    return round(number, DECIMALS) + 0.0 if math.isfinite(number) else None
