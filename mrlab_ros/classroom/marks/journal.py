"""What teachers did to the marks of a class, one entry after another, and what holds after all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from mrlab_ros.classroom.marks.diagnostics import (
    CLASS_IS_LOCKED,
    MARK_WITHOUT_REASON,
    NOTHING_TO_UNDO,
    SECOND_IS_FIRST,
    SECOND_MARKS_DIFFER,
)
from mrlab_ros.core.base.diagnostic import Diagnostic

MARK, SECOND, COMMENT, ASSIGN, ENROL, LOCK, RELEASE, UNDO, ADOPT, TAKE_BACK = ACTS = (
    "mark", "second", "comment", "assign", "enrol", "lock", "release", "undo", "adopt",
    "take_back",
)  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """One act. at: s since 1970. key, test: whose mark, test "points": all of them. points: None
    takes a mark back. text: reason of a mark, or the comment; empty: no comment. ASSIGN gives the
    file `text` to the student `key`, empty: to nobody; ENROL the student `key` the row `text` of
    the platform's table, empty: none."""

    at: float
    who: str
    did: str
    key: str = ""
    test: str = ""
    points: float | None = None
    text: str = ""


@dataclass
class State:
    """What holds. marks, seconds: by key and test; comments by key. owners: keys by path of files;
    rows: of the platform's table, by key. locked, released: by whom. done: acts that can be
    undone, the last one first to go."""

    marks: dict[str, dict[str, Entry]] = field(default_factory=dict)
    seconds: dict[str, dict[str, Entry]] = field(default_factory=dict)
    comments: dict[str, Entry] = field(default_factory=dict)
    owners: dict[str, str] = field(default_factory=dict)
    rows: dict[str, str] = field(default_factory=dict)
    locked: Entry | None = None
    released: Entry | None = None
    done: list[Entry] = field(default_factory=list)

    def columns(self, key: str) -> dict[str, float]:
        """Return the points that teachers give a student, by test."""
        found = self.marks.get(key, {})
        return {test: e.points for test, e in found.items() if e.points is not None}

    def comment(self, key: str) -> str:
        """Return the comment for a student, empty without one."""
        return self.comments[key].text if key in self.comments else ""


def state_of(entries: Iterable[Entry]) -> State:
    """Return what holds after all entries; an undo takes the last act back."""
    state = State()
    for entry in entries:
        if entry.did == UNDO:
            del state.done[-1:]
        elif entry.did not in (ADOPT, TAKE_BACK):
            state.done.append(entry)
    for entry in state.done:
        if entry.did in (MARK, SECOND):
            of = state.marks if entry.did == MARK else state.seconds
            own = of.setdefault(entry.key, {})
            own[entry.test] = entry
            if entry.points is None:
                del own[entry.test]
        elif entry.did == COMMENT:
            state.comments[entry.key] = entry
            if not entry.text:
                del state.comments[entry.key]
        elif entry.did == ASSIGN:
            state.owners[entry.text] = entry.key
        elif entry.did == ENROL:
            state.rows[entry.key] = entry.text
        else:
            state.locked = state.locked or entry
            state.released = entry if entry.did == RELEASE else state.released
    return state


def refusal(
    state: State, entry: Entry, points: Mapping[tuple[str, str], float]
) -> Diagnostic | None:
    """Return why an act is not done, None where it is. points: that hold, by key and test."""
    if entry.did == UNDO:
        return None if state.done else NOTHING_TO_UNDO()
    if state.released or (state.locked and entry.did != RELEASE):
        return CLASS_IS_LOCKED(who=(state.released or state.locked or entry).who)
    if entry.did == MARK and entry.points is not None and not entry.text.strip():
        return MARK_WITHOUT_REASON()
    first = state.marks.get(entry.key, {}).get(entry.test)
    if entry.did == SECOND and first is not None and first.who == entry.who:
        return SECOND_IS_FIRST(who=entry.who)
    if entry.did in (LOCK, RELEASE) and (count := differing(state, points)):
        return SECOND_MARKS_DIFFER(count=count)
    return None


def differing(state: State, points: Mapping[tuple[str, str], float]) -> int:
    """Return how many marks of a second marker are others than those that hold."""
    return sum(
        entry.points != points.get((key, test), entry.points)
        for key, tests in state.seconds.items()
        for test, entry in tests.items()
    )
