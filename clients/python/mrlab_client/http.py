"""The lab's gateway over HTTP, for one person, whose token is kept for this user alone."""

from __future__ import annotations

import json
import os
import ssl
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlencode

from mrlab_client.errors import LabError, NoAnswer, of_plain

TIMEOUT_S = 75.0
ASK_PERIOD_S = 1.0
KEPT = Path("mrlab", "client.json")


class Gateway:
    """The gateway at an address."""

    def __init__(self, url: str, token: str = "", ca: str | Path = "") -> None:
        """Sign in by `token`, by the one that is kept, or by a code that a person confirms.

        Raises NoAnswer without a lab, LabError where the token is none or nobody confirms.
        """
        self.url = url.rstrip("/") if "://" in url else f"http://{url.rstrip('/')}"
        self.context = ssl.create_default_context(cafile=str(ca) if ca else None)
        kept = _kept().get(self.url, "")
        self.token = token or os.environ.get("MRLAB_TOKEN", "") or kept
        self.user: dict[str, Any] | None = self.get("/api/session")["user"]
        if self.user is None and token:
            raise LabError(f"{self.url} does not know this token.", "not_signed_in")
        if self.user is None:
            self.token = self._let_in()
            _keep(self.url, self.token)
            self.user = self.get("/api/session")["user"]

    def get(self, path: str, **query: Any) -> Any:
        return json.loads(self.bytes("GET", path, query))

    def post(self, path: str, body: Mapping[str, Any]) -> Any:
        return json.loads(
            self.bytes("POST", path, {}, json.dumps(body).encode(), "application/json")
        )

    def put(self, path: str, data: bytes, **query: Any) -> Any:
        return json.loads(self.bytes("PUT", path, query, data, "application/octet-stream"))

    def bytes(
        self,
        method: str,
        path: str,
        query: Mapping[str, Any],
        data: bytes | None = None,
        kind: str = "",
    ) -> bytes:
        """Return the body of an answer; raise LabError or NoAnswer."""
        words = {key: _word(value) for key, value in query.items()}
        headers = {"Accept": "application/json"}
        if self.token:
            headers["Authorization"] = f"Bearer {self.token}"
        if kind:
            headers["Content-Type"] = kind
        address = self.url + quote(path) + (f"?{urlencode(words)}" if words else "")
        request = urllib.request.Request(address, data, headers, method=method)
        try:
            with urllib.request.urlopen(
                request, timeout=TIMEOUT_S, context=self.context
            ) as answer:
                found: bytes = answer.read()
                return found
        except urllib.error.HTTPError as error:
            try:
                problem = json.loads(error.read())["error"]
            except (ValueError, KeyError, TypeError):
                raise NoAnswer(f"{self.url} is no lab: it answered {error.code}.") from None
            raise of_plain(problem) from None
        except (urllib.error.URLError, OSError) as error:
            why = getattr(error, "reason", error)
            raise NoAnswer(f"No lab answers at {self.url}: {why}") from None

    def _let_in(self) -> str:
        body = {"device": "Python", "program": True}
        begun = self.post("/api/pairings", body)
        print(f"Open {begun['url']}\nand confirm the code {begun['code']} there.", file=sys.stderr)
        while True:
            found = self.get(f"/api/pairings/{begun['secret']}")
            if found["state"] == "approved":
                return str(found["token"])
            if found["state"] == "expired":
                raise LabError(f"Nobody confirmed the code {begun['code']} in time.")
            time.sleep(ASK_PERIOD_S)


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


def _file() -> Path:
    home = os.environ.get("XDG_CONFIG_HOME", "") or Path.home() / ".config"
    return Path(home) / KEPT


def _kept() -> dict[str, str]:
    try:
        found: dict[str, str] = json.loads(_file().read_text())
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _keep(url: str, token: str) -> None:
    file = _file()
    file.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(_kept() | {url: token})
    made = file.with_suffix(".new")
    made.unlink(missing_ok=True)
    with os.fdopen(os.open(made, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as out:
        out.write(text)
    made.replace(file)
