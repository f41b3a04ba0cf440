"""A learning platform, as the file of `--lti` names it, and this lab's own key for it."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.classroom.lti.diagnostics import LTI_KEY_UNUSABLE
from mrlab_ros.core.base.checks import FILLED_TEXT, Text, Texts
from mrlab_ros.core.base.checks import enum_values as one_of
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.records import field, read
from mrlab_ros.core.bridge.rules import Role

if TYPE_CHECKING:
    from joserfc import jwk

ADDRESS = Text(re.compile(r"https?://\S+"), "an https:// address of the platform")
SOME = Texts(FILLED_TEXT, single=True)
# The one that LTI demands.
ALGORITHM, BITS = "RS256", 2048


@dataclass(frozen=True)
class Platform:
    """A learning platform that knows this lab as a tool."""

    issuer: str = field(ADDRESS, "Who the platform says it is.")
    client_id: str = field(FILLED_TEXT, "By which the platform knows this lab.")
    deployments: tuple[str, ...] = field(SOME, "Ids of the tool's deployments.")
    courses: tuple[str, ...] = field(SOME, "Ids of the courses whose people may come.")
    sign_in: str = field(ADDRESS, "Where the platform confirms who somebody is.")
    tokens: str = field(ADDRESS, "Where the platform gives access to its services.")
    keys: str = field(ADDRESS, "Where the platform's public keys are.")
    teacher: Role = field(one_of(Role), "Role of the course's teachers here.", Role.INSTRUCTOR)
    student: Role = field(one_of(Role), "Role of everybody else of the course.", Role.STUDENT)

    def owns(self, address: str) -> bool:
        """Return whether an address is of one of the hosts that the file names."""
        own = (self.issuer, self.sign_in, self.tokens, self.keys)
        try:
            return _origin(address) in {_origin(each) for each in own}
        except ValueError:
            return False


def read_platform(path: Path) -> Platform:
    """Read the file of `--lti`; raises BadInput that names all mistakes."""
    return read(Platform, read_yaml(path), str(path))


def own_key(path: Path) -> jwk.RSAKey:
    """Return the key by which the platform knows what this lab says; one is made where none is.

    Raises BadInput.
    """
    from joserfc import jwk

    try:
        if not path.exists():
            key = jwk.RSAKey.generate_key(BITS, {"use": "sig", "alg": ALGORITHM}, auto_kid=True)
            with replaced(path, 0o600) as file:
                file.write(json.dumps(key.as_dict(private=True)).encode())
        return jwk.RSAKey.import_key(json.loads(path.read_bytes()))
    except (OSError, ValueError) as error:
        raise BadInput(LTI_KEY_UNUSABLE(path=str(path), why=str(error))) from None


def _origin(address: str) -> tuple[str, str]:
    parts = urlsplit(address)
    return parts.scheme, parts.netloc.lower()
