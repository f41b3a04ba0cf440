"""What a platform offers to its tools: Names and Roles, and the gradebook (Assignment and Grade
Services). This lab signs what it asks with its own key."""

from __future__ import annotations

import secrets
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from typing import Any

import httpx
from joserfc import jwk, jwt

from mrlab_ros.classroom.lti.diagnostics import (
    COURSE_LEADS_AWAY,
    COURSE_OFFERS_NOT,
    COURSE_SILENT,
    MARK_NOT_SENT,
)
from mrlab_ros.classroom.lti.platform import ALGORITHM, Platform
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Unavailable

TIMEOUT_S = 20.0
MOST_PAGES = 1000
GARBAGE = (ValueError, KeyError, TypeError)  # of an answer that is not as it should be
NRPS = "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly"
AGS = "https://purl.imsglobal.org/spec/lti-ags/scope/"
MEMBERS_TYPE = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json"
LINE_ITEM_TYPE = "application/vnd.ims.lis.v2.lineitem+json"
SCORE_TYPE = "application/vnd.ims.lis.v1.score+json"
LEARNER = ("http://purl.imsglobal.org/vocab/lis/v2/membership#Learner", "Learner")
ASSERTION = "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"


@dataclass(frozen=True)
class Score:
    """A mark for the gradebook. subject: by which the platform knows the student."""

    subject: str
    student: str
    points: float
    of: float
    comment: str


class Services:
    """Asks one platform. key: this lab's own."""

    def __init__(self, platform: Platform, key: jwk.RSAKey) -> None:
        self.platform = platform
        self.key = key

    async def members(self, address: str) -> list[dict[str, str]]:
        """Return the students of a course: subject, name and email of each. Raises LabError."""
        if not address:
            raise BadInput(COURSE_OFFERS_NOT(what="members"))
        found: list[dict[str, str]] = []
        async with self._client(NRPS) as client:
            following: str | None = address
            for _ in range(MOST_PAGES):
                if not following:
                    break
                answer = await self._asked(
                    client, "GET", following, headers={"Accept": MEMBERS_TYPE}
                )
                found += map(_member, filter(_learns, _members(answer)))
                following = answer.links.get("next", {}).get("url")
        return found

    async def send(
        self, scores: Mapping[str, Any], label: str, task: str, marks: Sequence[Score]
    ) -> tuple[int, list[Diagnostic], str]:
        """Send marks to the gradebook; return how many it took, which not, and its column.

        scores: the claim of the launch, with the column where it is known. Raises LabError where
        there is no gradebook.
        """
        scopes = scores.get("scope")
        allowed = [s for s in scopes if isinstance(s, str)] if isinstance(scopes, list) else []
        column = str(scores.get("lineitem") or "")
        columns = str(scores.get("lineitems") or "")
        if f"{AGS}score" not in allowed or not (column or columns):
            raise BadInput(COURSE_OFFERS_NOT(what="scores"))
        wanted = [s for s in (f"{AGS}score", f"{AGS}lineitem") if s in allowed]
        problems: list[Diagnostic] = []
        async with self._client(" ".join(wanted)) as client:
            if not column:
                if f"{AGS}lineitem" not in allowed:
                    raise BadInput(COURSE_OFFERS_NOT(what="scores"))
                try:
                    column = await self._column(client, columns, label, task, marks)
                except GARBAGE as error:
                    why = f"{type(error).__name__}: {error}"[:300]
                    said = COURSE_SILENT(issuer=self.platform.issuer, why=why)
                    raise Unavailable(said) from None
            place, _, query = column.partition("?")
            address = f"{place.rstrip('/')}/scores{f'?{query}' if query else ''}"
            for each in marks:
                try:
                    await self._asked(
                        client, "POST", address, headers={"Content-Type": SCORE_TYPE},
                        json=_score(each),
                    )  # fmt: skip
                except Unavailable as error:
                    problems.append(MARK_NOT_SENT(student=each.student, why=error.diagnostic))
        return len(marks) - len(problems), problems, column

    async def _column(
        self,
        client: httpx.AsyncClient,
        columns: str,
        label: str,
        task: str,
        marks: Iterable[Score],
    ) -> str:
        """Return the column of this task, a new one where the gradebook has none."""
        accepts = {"Accept": "application/vnd.ims.lis.v2.lineitemcontainer+json"}
        asked = str(httpx.URL(columns).copy_merge_params({"resource_link_id": task}))
        answer = await self._asked(client, "GET", asked, headers=accepts)
        known = answer.json()
        for each in known if isinstance(known, list) else ():
            if isinstance(each, Mapping) and each.get("resourceLinkId") == task:
                return str(each["id"])
        made = {
            "label": label, "resourceLinkId": task,
            "scoreMaximum": max((m.of for m in marks), default=1.0),
        }  # fmt: skip
        kind = {"Content-Type": LINE_ITEM_TYPE, "Accept": LINE_ITEM_TYPE}
        answer = await self._asked(client, "POST", columns, headers=kind, json=made)
        return str(answer.json()["id"])

    def _client(self, scope: str) -> httpx.AsyncClient:
        return httpx.AsyncClient(timeout=TIMEOUT_S, auth=_Access(self, scope))

    async def _asked(
        self, client: httpx.AsyncClient, method: str, address: str, **options: Any
    ) -> httpx.Response:
        """Return a good answer; raise Unavailable. No other host gets the access."""
        if not self.platform.owns(address):
            raise Unavailable(COURSE_LEADS_AWAY(address=address[:200]))
        try:
            answer = await client.request(method, address, **options)
            return answer.raise_for_status()
        except (httpx.HTTPError, httpx.InvalidURL, *GARBAGE) as error:
            why = f"{type(error).__name__}: {error}"[:300]
            raise Unavailable(COURSE_SILENT(issuer=self.platform.issuer, why=why)) from None

    def grant(self, scope: str) -> httpx.Request:
        """Return the request for access, which this lab's key signs (RFC 7523)."""
        own, now = self.platform, round(time.time())
        said = {
            "iss": own.client_id, "sub": own.client_id, "aud": own.tokens, "iat": now,
            "exp": now + 60, "jti": secrets.token_urlsafe(16),
        }  # fmt: skip
        form = {
            "grant_type": "client_credentials",
            "client_assertion_type": ASSERTION,
            "client_assertion": signed(self.key, said),
            "scope": scope,
        }
        return httpx.Request("POST", own.tokens, data=form)


class _Access(httpx.Auth):
    """Gets the access once, before the first request."""

    requires_response_body = True

    def __init__(self, services: Services, scope: str) -> None:
        self._services, self._scope, self._token = services, scope, ""

    def auth_flow(self, request: httpx.Request) -> Any:
        if not self._token:
            answer = yield self._services.grant(self._scope)
            answer.raise_for_status()
            self._token = str(answer.json()["access_token"])
        request.headers["Authorization"] = f"Bearer {self._token}"
        yield request


def signed(key: jwk.RSAKey, claims: Mapping[str, Any]) -> str:
    """Return claims as a JWT of this lab."""
    return jwt.encode({"alg": ALGORITHM, "kid": key.kid, "typ": "JWT"}, dict(claims), key)


def _members(answer: httpx.Response) -> list[Mapping[str, Any]]:
    try:
        found = answer.json()["members"]
    except (ValueError, KeyError, TypeError):
        return []
    return [each for each in found if isinstance(each, Mapping) and each.get("user_id")]


def _learns(member: Mapping[str, Any]) -> bool:
    roles = member.get("roles") or ()
    return member.get("status", "Active") == "Active" and any(role in LEARNER for role in roles)


def _member(member: Mapping[str, Any]) -> dict[str, str]:
    whole = " ".join(str(member.get(part) or "") for part in ("given_name", "family_name"))
    name = str(member.get("name") or whole.strip() or member["user_id"])
    email = str(member.get("email") or "")
    return {"subject": str(member["user_id"]), "name": name[:200], "email": email[:200]}


def _score(mark: Score) -> dict[str, Any]:
    return {
        "userId": mark.subject,
        "scoreGiven": max(mark.points, 0.0),
        "scoreMaximum": mark.of,
        "comment": mark.comment,
        "activityProgress": "Completed",
        "gradingProgress": "FullyGraded",
        "timestamp": datetime.now(timezone.utc).isoformat(timespec="milliseconds"),
    }
