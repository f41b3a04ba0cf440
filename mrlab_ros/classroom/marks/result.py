"""The result of one submission: its marks, its findings, and figures that compare it with others.

Pseudonyms are the same each time as long as the key is kept.
"""

from __future__ import annotations

import base64
import hashlib
import hmac
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from mrlab_ros.classroom.marks.diagnostics import UNREADABLE
from mrlab_ros.classroom.marks.exports import Roster, Submission, renamed
from mrlab_ros.classroom.rubrics.marking import Marks, unmarked
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.base.diagnostic import Diagnostic, plain

MARKED, REFUSED, NO_FILE = "marked", "refused", "no_file"
FAILED, TO_REPEAT = "failed", "to_repeat"
MOST_PATH = 64  # points of the tool's way that a picture has
MOST_FINDINGS = 50


@dataclass(frozen=True)
class Result:
    """The result of a submission, as plain values that JSON holds.

    outcome: MARKED, REFUSED: no file holds a motion that can be marked, NO_FILE, FAILED: the check
    did not come to its end, or TO_REPEAT: nor did it, and the machine is the reason, so that there
    is no mark at all. found: why, or the verdict, as `plain` writes a diagnostic. file: the one
    that was taken, named as it was handed in. marks, public: as `Marks.plain`; public is what the
    student may read. findings:
    as `found`. report: the hash of the check. signature: (K, J) deg, see `similarity`. path:
    (N, 3) m of tool0.
    """

    outcome: str
    found: Mapping[str, Any]
    marks: Mapping[str, Any]
    public: Mapping[str, Any]
    file: str = ""
    sha256: str = ""
    verdict: str = ""
    report: str = ""
    robot: str = ""
    tool: str = ""
    duration: float | None = None
    findings: Sequence[Mapping[str, Any]] = ()
    signature: Sequence[Sequence[float]] = ()
    path: Sequence[Sequence[float]] = ()
    has_trajectory: bool = False
    has_page: bool = False

    @property
    def points(self) -> float:
        return float(self.marks["points"])

    @property
    def of(self) -> float:
        return float(self.marks["of"])

    def plain(self) -> dict[str, Any]:
        """Return the result as a mapping for JSON."""
        return dict(vars(self))


def without_marks(rubric: Rubric, outcome: str, why: Diagnostic, file: str = "") -> Result:
    """Return the result of what could not be checked: no points, and why."""
    marks = Marks(
        tuple(unmarked(test, why) for test in rubric.tests),
        note=why,
    )
    return Result(outcome, plain(why), marks.plain(), marks.public().plain(), file)


FILE_LENGTH = 8
LENGTH = 4  # letters and digits; more where two students would have the same
READABLE = bytes.maketrans(b"IO", b"89")  # base32 without what is mistaken for another


def pseudonymous(roster: Roster, secret: bytes) -> tuple[Roster, dict[str, Submission]]:
    """Return a roster without names, in an order that says nothing either, and who is who."""
    codes = _codes([_identity(s) for s in roster.submissions], secret)
    who: dict[str, Submission] = {}
    changed = []
    for submission, code in zip(roster.submissions, codes, strict=True):
        name = f"Student {code}"
        who[name] = submission
        changed.append(renamed(submission, name, f"student-{code.lower()}"))
    changed.sort(key=lambda s: s.key)
    left_out = tuple(
        replace(
            each,
            path=f"file {n}" if each.entry is None else named(each.path, secret),
            why=UNREADABLE() if _names_a_file(each.why) else each.why,
        )
        for n, each in enumerate(roster.left_out, 1)
    )
    return Roster(roster.form, tuple(changed), left_out), who


def named(path: str, secret: bytes) -> str:
    """Return a name for a file or folder of an export that says nothing, always the same one."""
    return f"file {_coded(path, secret)[:FILE_LENGTH]}"


def _names_a_file(why: Diagnostic) -> bool:
    return not {"file", "folder", "why"}.isdisjoint(why.values)


def _identity(submission: Submission) -> str:
    return "\n".join((submission.name, submission.identifier, submission.email))


def _coded(text: str, secret: bytes) -> str:
    mac = hmac.new(secret, text.encode("utf-8", "surrogatepass"), hashlib.sha256).digest()
    return base64.b32encode(mac).translate(READABLE).decode().rstrip("=")


def _codes(identities: Sequence[str], secret: bytes) -> list[str]:
    digests = [_coded(identity, secret) for identity in identities]
    length = LENGTH
    while len({d[:length] for d in digests}) < len(set(digests)) and length < 32:
        length += 1
    seen: dict[str, int] = {}
    codes = []
    for digest in digests:
        code = digest[:length]
        seen[code] = seen.get(code, 0) + 1
        codes.append(code if seen[code] == 1 else f"{code}{seen[code]}")
    return codes
