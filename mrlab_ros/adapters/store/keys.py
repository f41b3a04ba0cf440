"""The keys of the store: every user below a prefix of their own.

    users/USER/uploads/UPLOAD/FILE       what a user sent
    users/USER/drafts/DRAFT.npz          converted, not yet in the catalogue
    users/USER/motions/MOTION.json       what a page shows of a conversion
    trajectories/records/OWNER/NAME.json one a trajectory, `core/trajectory/catalogue.py`
    trajectories/versions/OWNER/NAME/UNIQUE.npz
    trajectories/changes.json            what changed last

A name is a segment: its letters, digits, '_', '-' and '.' as they are, every other byte of its
UTF-8 as =XX. So two names never share a segment, and none can leave its prefix.
"""

from __future__ import annotations

import hashlib
import re
import secrets

from mrlab_ros.adapters.store.diagnostics import BAD_UPLOAD_NUMBER, EMPTY_STORE_NAME, NO_UPLOAD_KEY
from mrlab_ros.core.base.errors import BadInput

RECORDS = "trajectories/records"
VERSIONS = "trajectories/versions"
CHANGES = "trajectories/changes.json"
USERS = "users"
# The segment of the lab's own trajectories: a name's '=' is always escaped, so no user has it.
LAB = "=lab"
PLAIN = frozenset(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.")
# A file system takes 255 bytes; the rest is for endings and for the names of unfinished files.
LONGEST, KEPT = 200, 120
UNIQUE = re.compile(r"[0-9a-f]{32}")
SEGMENT = r"(?!\.)(?:[A-Za-z0-9_.-]|=[0-9A-Fa-z])+"
UPLOAD = re.compile(rf"users/({SEGMENT})/uploads/[0-9a-f]{{32}}/({SEGMENT})")
DRAFT = re.compile(rf"users/({SEGMENT})/drafts/[0-9a-f]{{32}}\.npz")


def segment(name: str) -> str:
    """Return a name as one part of a key; raise BadInput for an empty one.

    A long one is cut and ends in a hash of all of it.
    """
    if not name:
        raise BadInput(EMPTY_STORE_NAME())
    data = name.encode("utf-8", "surrogatepass")
    leading_dot = name.startswith(".")
    parts = [
        chr(byte) if byte in PLAIN and not (i == 0 and leading_dot) else f"={byte:02X}"
        for i, byte in enumerate(data)
    ]
    text = "".join(parts)
    if len(text) <= LONGEST:
        return text
    kept = ""
    for part in parts:
        if len(kept) + len(part) > KEPT:
            break
        kept += part
    return f"{kept}=h{hashlib.sha256(data).hexdigest()}"


def name_of(text: str) -> str:
    """Return the name of a segment; of one that was cut its beginning and an ellipsis."""
    begin, cut, _ = text.partition("=h")
    data = re.sub(rb"=([0-9A-F]{2})", lambda m: bytes([int(m[1], 16)]), begin.encode())
    return data.decode("utf-8", "replace" if cut else "surrogatepass") + ("…" if cut else "")


def unique() -> str:
    """Return an id that nobody can guess and that never comes again."""
    return secrets.token_hex(16)


def user(name: str) -> str:
    """Return the prefix of all that a user sent; an empty name: an operator of the lab itself."""
    return f"{USERS}/{segment(name) if name else LAB}"


def upload(name: str, number: str, file: str) -> str:
    """Return the key of an upload; number: its `unique()`. A path's last part is the file."""
    return f"{uploads(name, number)}/{segment(file)}"


def uploads(name: str, number: str = "") -> str:
    """Return the prefix of a user's uploads, or of the one with that number."""
    return f"{user(name)}/uploads/{_checked(number)}" if number else f"{user(name)}/uploads"


def draft(name: str, number: str) -> str:
    """Return the key of a draft of a user's."""
    return f"{user(name)}/drafts/{_checked(number)}.npz"


def motion(name: str, number: str) -> str:
    """Return the key of the note of what an upload of a user's became."""
    return f"{user(name)}/motions/{_checked(number)}.json"


def record(owner: str, name: str) -> str:
    """Return the key of a trajectory's record; owner: empty for the lab's own."""
    return f"{RECORDS}/{segment(owner) if owner else LAB}/{segment(name)}.json"


def version(owner: str, name: str) -> str:
    """Return a new key for the file of a version."""
    return f"{VERSIONS}/{segment(owner) if owner else LAB}/{segment(name)}/{unique()}.npz"


def owner_of(key: str, kind: re.Pattern[str]) -> str:
    """Return the segment of the user whose upload or draft it is; raise BadInput for others."""
    match = kind.fullmatch(key)
    if match is None:
        what = "upload" if kind is UPLOAD else "draft"
        raise BadInput(NO_UPLOAD_KEY(key=key[:200], what=what))
    return match[1]


def _checked(number: str) -> str:
    if not UNIQUE.fullmatch(number):
        raise BadInput(BAD_UPLOAD_NUMBER(number=number[:64]))
    return number
