"""Names that say nothing of a student, and are the same each time as long as the key is kept."""

from __future__ import annotations

import base64
import hashlib
import hmac
from collections.abc import Sequence

from mrlab_ros.core.classroom.exports import Roster, Submission, renamed

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
    left_out = tuple((f"file {n}", why) for n, (_, why) in enumerate(roster.left_out, 1))
    return Roster(roster.form, tuple(changed), left_out), who


def _identity(submission: Submission) -> str:
    return "\n".join((submission.name, submission.identifier, submission.email))


def _codes(identities: Sequence[str], secret: bytes) -> list[str]:
    digests = []
    for identity in identities:
        mac = hmac.new(secret, identity.encode(), hashlib.sha256).digest()
        digests.append(base64.b32encode(mac).translate(READABLE).decode().rstrip("="))
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
