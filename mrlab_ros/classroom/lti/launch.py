"""Launches: a platform says who somebody is, and from which course and task they come.

The browser begins at the platform, so the state of a sign-in is kept by the browser alone: it is
signed, bound to the browser by a cookie, and its nonce follows from it. What is used is noted, so
that no launch counts twice.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import secrets
from base64 import urlsafe_b64decode
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from mrlab_ros.classroom.lti.diagnostics import (
    COURSE_SILENT,
    LTI_NOT_UNDERSTOOD,
    LTI_OTHER_COURSE,
    LTI_OTHER_DEPLOYMENT,
    LTI_OTHER_PLATFORM,
    LTI_USED,
)
from mrlab_ros.classroom.lti.platform import Platform
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.gateway.errors import NotAllowed
from mrlab_ros.gateway.people.diagnostics import NOT_CONFIRMED, SIGN_IN_NOT_BEGUN
from mrlab_ros.gateway.people.oidc import (
    ALGORITHMS,
    CLOCK_SLACK_S,
    PENDING_LIFETIME_S,
    TIMEOUT_S,
    NotBegun,
    NotConfirmed,
)
from mrlab_ros.gateway.people.sign_ins import Database, digest

if TYPE_CHECKING:
    from joserfc import jwk

CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"
MEMBERS = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice"
SCORES = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"
LINKING = "https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings"
TEACHER = ("http://purl.imsglobal.org/vocab/lis/v2/membership#Instructor", "Instructor")
OPENS, LINKS = "LtiResourceLinkRequest", "LtiDeepLinkingRequest"
# Between two looks at the platform's keys for one that is not known, s.
KEYS_PERIOD_S = 10.0
DIGITS = 12  # of an instant, s since 1970
USED = "launch"  # the kind of link that a launch is


@dataclass(frozen=True)
class Launch:
    """Who comes, from where. subject: by which the platform knows the person. links: the teacher
    chooses what the course shall open. task: id of the link that was opened, empty: `links`.
    linking: what the platform says of the choice. members: address of the list of the
    course's people; scores: claim of the gradebook; both empty where they are not offered."""

    subject: str
    name: str
    email: str
    teacher: bool
    course: str
    course_title: str
    deployment: str
    links: bool = False
    task: str = ""
    task_title: str = ""
    locale: str = ""
    linking: Mapping[str, Any] = field(default_factory=dict)
    members: str = ""
    scores: Mapping[str, Any] = field(default_factory=dict)


class Launches:
    """Takes the launches of one platform. database: of people, where used launches are noted.

    Times are s since 1970.
    """

    def __init__(self, platform: Platform, database: Database) -> None:
        self.platform = platform
        self._database = database
        self._keys: jwk.KeySet | None = None
        self._asked = 0.0

    def begin(self, asked: Mapping[str, str], redirect: str, now: float) -> tuple[str, str]:
        """Return where the platform confirms who comes, and the state for the browser's cookie.

        asked: what the platform sends to begin. Raises NotConfirmed for another platform.
        """
        own = self.platform
        client = asked.get("client_id") or own.client_id
        if asked.get("iss") != own.issuer or client != own.client_id:
            raise NotConfirmed(LTI_OTHER_PLATFORM(issuer=visible(asked.get("iss", "")[:200])))
        state = f"{round(now)}.{secrets.token_urlsafe(24)}"
        sent = {
            "scope": "openid", "response_type": "id_token", "response_mode": "form_post",
            "prompt": "none", "client_id": own.client_id, "redirect_uri": redirect,
            "state": state, "nonce": self._nonce(state),
            "login_hint": asked.get("login_hint", ""),
        }  # fmt: skip
        if "lti_message_hint" in asked:
            sent["lti_message_hint"] = asked["lti_message_hint"]
        return f"{own.sign_in}{'&' if '?' in own.sign_in else '?'}{urlencode(sent)}", state

    async def finish(self, form: Mapping[str, str], cookie: str, now: float) -> Launch:
        """Return who comes; form: as the platform lets the browser post it.

        Raises NotBegun where the launch was not begun in this browser or took too long,
        NotConfirmed where the platform does not vouch for it or it was used, NotAllowed where it
        is of a course that does not belong here, Unavailable where the platform is silent.
        """
        state = form.get("state", "")
        began = state.partition(".")[0]
        if (
            not state
            or not hmac.compare_digest(state.encode(), cookie.encode())
            or not (began.isascii() and began.isdigit() and len(began) <= DIGITS)
            or not 0 <= now - int(began) + 1 <= PENDING_LIFETIME_S
        ):
            raise NotBegun(SIGN_IN_NOT_BEGUN())
        if form.get("error"):
            raise NotConfirmed(NOT_CONFIRMED(why=visible(form["error"][:200])))
        claims = await self._claims(form.get("id_token", ""), self._nonce(state), now)
        launch = self._launch(claims)
        self._use(state, now)
        return launch

    def _nonce(self, state: str) -> str:
        said = f"lti\n{self.platform.issuer}\n{self.platform.client_id}\n{state}".encode()
        return hmac.new(self._database.secret, said, hashlib.sha256).hexdigest()

    async def _claims(self, token: str, nonce: str, now: float) -> dict[str, Any]:
        from joserfc import jwt
        from joserfc.errors import JoseError

        own = self.platform
        try:
            head = token.partition(".")[0]
            kid = json.loads(urlsafe_b64decode(head + "=" * (-len(head) % 4))).get("kid")
            keys = await self._keys_with(kid, now)
            claims = dict(jwt.decode(token, keys, algorithms=ALGORITHMS).claims)
            jwt.JWTClaimsRegistry(
                now=round(now),
                leeway=CLOCK_SLACK_S,
                iss={"essential": True, "value": own.issuer},
                aud={"essential": True, "value": own.client_id},
                sub={"essential": True},
                exp={"essential": True},
                iat={"essential": True},
                nonce={"essential": True, "value": nonce},
            ).validate(claims)
            several = isinstance(claims["aud"], list) and len(claims["aud"]) > 1
            if claims.get("azp", "" if several else own.client_id) != own.client_id:
                raise ValueError("azp")
        except (JoseError, KeyError, ValueError, AttributeError, TypeError) as error:
            why = f"{type(error).__name__}: {error}"[:300]
            raise NotConfirmed(NOT_CONFIRMED(why=why)) from error
        return claims

    async def _keys_with(self, kid: object, now: float) -> jwk.KeySet:
        """Return the platform's keys, asked for again where one is not among them."""
        known = self._keys
        if known is not None and (kid is None or any(key.kid == kid for key in known)):
            return known
        if known is not None and now - self._asked < KEYS_PERIOD_S:
            return known
        import httpx
        from joserfc import jwk
        from joserfc.errors import JoseError

        self._asked = now
        try:
            async with httpx.AsyncClient(timeout=TIMEOUT_S) as client:
                answer = await client.get(self.platform.keys)
                self._keys = jwk.KeySet.import_key_set(answer.raise_for_status().json())
        except (httpx.HTTPError, ValueError, JoseError, KeyError, TypeError) as error:
            why = f"{type(error).__name__}: {error}"
            raise Unavailable(COURSE_SILENT(issuer=self.platform.issuer, why=why)) from error
        return self._keys

    def _launch(self, claims: Mapping[str, Any]) -> Launch:
        own = self.platform
        kind, version = claims.get(f"{CLAIM}message_type"), claims.get(f"{CLAIM}version")
        if version != "1.3.0" or kind not in (OPENS, LINKS):
            raise NotConfirmed(LTI_NOT_UNDERSTOOD(why=f"{version} {kind}"))
        deployment = str(claims.get(f"{CLAIM}deployment_id", ""))
        if deployment not in own.deployments:
            said = LTI_OTHER_DEPLOYMENT(deployment=deployment[:100], known=own.deployments)
            raise NotAllowed(said)
        course, task = (_mapping(claims, f"{CLAIM}{n}") for n in ("context", "resource_link"))
        course_id, title = str(course.get("id", "")), str(course.get("title", ""))[:200]
        if course_id not in own.courses:
            said = LTI_OTHER_COURSE(course=course_id[:100], title=title, known=own.courses)
            raise NotAllowed(said)
        if kind == OPENS and not task.get("id"):
            raise NotConfirmed(LTI_NOT_UNDERSTOOD(why="resource_link"))
        roles = claims.get(f"{CLAIM}roles")
        name = claims.get("name") or " ".join(
            str(claims[part]) for part in ("given_name", "family_name") if claims.get(part)
        )
        return Launch(
            str(claims["sub"]),
            str(name or claims.get("email") or claims["sub"])[:200],
            str(claims.get("email", ""))[:200],
            isinstance(roles, list) and any(role in TEACHER for role in roles),
            course_id,
            title,
            deployment,
            kind == LINKS,
            str(task.get("id", "")),
            str(task.get("title", ""))[:200],
            str(_mapping(claims, f"{CLAIM}launch_presentation").get("locale", "")),
            _mapping(claims, LINKING),
            str(_mapping(claims, MEMBERS).get("context_memberships_url", "")),
            _mapping(claims, SCORES),
        )

    def _use(self, state: str, now: float) -> None:
        """Note that a launch was used; raise NotConfirmed where it was."""
        with self._database.writing() as connection:
            connection.execute("DELETE FROM links WHERE kind = ? AND expires <= ?", (USED, now))
            row = (digest(state), USED, "", now + PENDING_LIFETIME_S)
            made = connection.execute("INSERT OR IGNORE INTO links VALUES (?, ?, ?, ?)", row)
        if made.rowcount == 0:
            raise NotConfirmed(LTI_USED())


def _mapping(claims: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    found = claims.get(name)
    return found if isinstance(found, Mapping) else {}
