"""A learning platform over HTTP that speaks LTI 1.3: launches, deep linking, Names and Roles, and
Assignment and Grade Services, strict about what a tool sends."""

from __future__ import annotations

import functools
import html
import json
import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlencode, urlsplit

from joserfc import jwk, jwt

CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"
DL = "https://purl.imsglobal.org/spec/lti-dl/claim/"
AGS = "https://purl.imsglobal.org/spec/lti-ags/"
NRPS = "https://purl.imsglobal.org/spec/lti-nrps/"
MEMBERSHIP = "http://purl.imsglobal.org/vocab/lis/v2/membership#"


def new_key() -> jwk.RSAKey:
    kid = {"kid": secrets.token_hex(4), "use": "sig", "alg": "RS256"}
    return jwk.RSAKey.generate_key(2048, kid)


# One for all tests: a key takes seconds on a busy machine.
some_key = functools.cache(new_key)


@dataclass
class Someone:
    """A person of the course."""

    sub: str
    name: str
    role: str = "Learner"
    email: str = ""


@dataclass
class LearningPlatform:
    """One platform with one course. tool_keys: gives the tool's public keys. clock: s since 1970.

    claims: put over the right ones of the next launches; None leaves a claim out.
    """

    tool_keys: Callable[[], Any]
    clock: Callable[[], float]
    client_id: str = "mrlab-tool"
    deployment: str = "7"
    course: str = "robotics-1"
    claims: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.people = {
            "t": Someone("t", "Grace Teacher", "Instructor", "grace@uni.example"),
            "a": Someone("a", "Anna Ärmel", email="anna@uni.example"),
            "b": Someone("b", "Ben Bauer"),
            "c": Someone("c", "Cleo Klein"),
        }
        self.key = self.signs_with = some_key()
        self.columns: list[dict[str, Any]] = []
        self.scores: dict[str, dict[str, Any]] = {}
        self.linked: list[dict[str, Any]] = []
        self.keys_asked = 0
        self._tokens: dict[str, set[str]] = {}
        platform = self

        class Handler(BaseHTTPRequestHandler):
            def log_message(self, *_: object) -> None:
                pass

            def _answer(self, method: str) -> None:
                size = int(self.headers.get("content-length") or 0)
                body = self.rfile.read(size)
                status, headers, content = platform.answer(method, self.path, self.headers, body)
                self.send_response(status)
                for name, value in headers.items():
                    self.send_header(name, value)
                self.send_header("content-length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            def do_GET(self) -> None:
                self._answer("GET")

            def do_POST(self) -> None:
                self._answer("POST")

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self._server.server_port}"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()

    def rotate(self) -> None:
        """Sign with a new key; the one before is gone."""
        self.key = self.signs_with = new_key()

    def settings(self) -> dict[str, Any]:
        """Return what the file of `--lti` says."""
        return {
            "issuer": self.url, "client_id": self.client_id, "deployments": [self.deployment],
            "courses": [self.course], "sign_in": f"{self.url}/auth?site=1",
            "tokens": f"{self.url}/token", "keys": f"{self.url}/keys",
        }  # fmt: skip

    def begins(self, who: str, kind: str = "open") -> dict[str, str]:
        """Return what the browser sends to the tool's login."""
        return {
            "iss": self.url, "login_hint": who, "client_id": self.client_id,
            "target_link_uri": "https://lab.example.org/class", "lti_message_hint": kind,
            "lti_deployment_id": self.deployment,
        }  # fmt: skip

    def launched(self, url: str) -> dict[str, str]:
        """Return the form that the browser posts to the tool, after its request to /auth."""
        asked = {name: values[0] for name, values in parse_qs(urlsplit(url).query).items()}
        assert urlsplit(url).path == "/auth"
        assert asked["site"] == "1"
        assert (asked["scope"], asked["response_type"]) == ("openid", "id_token")
        assert (asked["response_mode"], asked["prompt"]) == ("form_post", "none")
        assert asked["client_id"] == self.client_id
        token = self.token(asked["login_hint"], asked["nonce"], asked["lti_message_hint"])
        return {"state": asked["state"], "id_token": token}

    def token(self, who: str, nonce: str, kind: str) -> str:
        """Return the ID token of a launch. kind: open, or link for deep linking."""
        person, now = self.people[who], round(self.clock())
        claims: dict[str, Any] = {
            "iss": self.url, "aud": self.client_id, "sub": person.sub, "iat": now,
            "exp": now + 60, "nonce": nonce, "name": person.name, "email": person.email,
            f"{CLAIM}version": "1.3.0",
            f"{CLAIM}deployment_id": self.deployment,
            f"{CLAIM}roles": [f"{MEMBERSHIP}{person.role}"],
            f"{CLAIM}context": {"id": self.course, "title": "Robotics 1"},
            f"{CLAIM}launch_presentation": {"locale": "de"},
        }  # fmt: skip
        if kind == "link":
            claims |= {
                f"{CLAIM}message_type": "LtiDeepLinkingRequest",
                f"{DL}deep_linking_settings": {
                    "deep_link_return_url": f"{self.url}/linked",
                    "accept_types": ["ltiResourceLink"],
                    "data": "of the platform",
                },
            }
        else:
            task = "task-1" if kind == "open" else kind
            claims |= {
                f"{CLAIM}message_type": "LtiResourceLinkRequest",
                f"{CLAIM}resource_link": {"id": task, "title": "Pick and place"},
                f"{CLAIM}target_link_uri": "https://lab.example.org/class",
                f"{NRPS}claim/namesroleservice": {
                    "context_memberships_url": f"{self.url}/members?course=1",
                    "service_versions": ["2.0"],
                },
                f"{AGS}claim/endpoint": {
                    "scope": [f"{AGS}scope/score", f"{AGS}scope/lineitem"],
                    "lineitems": f"{self.url}/columns?course=1",
                },
            }
        claims |= self.claims
        kept = {name: value for name, value in claims.items() if value is not None}
        return jwt.encode({"alg": "RS256", "kid": self.key.kid}, kept, self.signs_with)

    def answer(
        self, method: str, path: str, headers: Any, body: bytes
    ) -> tuple[int, dict[str, str], bytes]:
        """Return status, headers and body."""
        url = urlsplit(path)
        query = {name: values[0] for name, values in parse_qs(url.query).items()}
        match (method, url.path):
            case ("GET", "/course"):
                return self._page(query["tool"])
            case ("GET", "/auth"):
                return _posting(query["redirect_uri"], self.launched(path))
            case ("GET", "/keys"):
                self.keys_asked += 1
                return _json({"keys": [self.key.as_dict(private=False)]})
            case ("POST", "/token"):
                return self._access(body)
            case ("POST", "/linked"):
                sent = parse_qs(body.decode())["JWT"][0]
                self.linked.append(self._of_tool(sent, self.url))
                return 200, {"content-type": "text/html"}, b"<h1>Added</h1>"
        scopes = self._tokens.get(headers.get("authorization", "").removeprefix("Bearer "), set())
        match (method, url.path):
            case ("GET", "/members") if f"{NRPS}scope/contextmembership.readonly" in scopes:
                assert "membershipcontainer+json" in headers["accept"]
                return self._members(query)
            case ("GET", "/columns") if f"{AGS}scope/lineitem" in scopes:
                assert query["course"] == "1"
                wanted = query["resource_link_id"]
                return _json([c for c in self.columns if c["resourceLinkId"] == wanted])
            case ("POST", "/columns") if f"{AGS}scope/lineitem" in scopes:
                assert headers["content-type"] == "application/vnd.ims.lis.v2.lineitem+json"
                made = json.loads(body)
                assert made["scoreMaximum"] > 0
                assert made["label"]
                made["id"] = f"{self.url}/columns/{len(self.columns) + 1}?course=1"
                self.columns.append(made)
                return _json(made, 201)
            case ("POST", "/columns/1/scores") if f"{AGS}scope/score" in scopes:
                assert headers["content-type"] == "application/vnd.ims.lis.v1.score+json"
                assert query["course"] == "1"
                score = json.loads(body)
                if score["userId"] not in self.people:
                    return 404, {}, b""
                assert score["scoreGiven"] >= 0
                assert score["gradingProgress"] == "FullyGraded"
                before = self.scores.get(score["userId"])
                assert before is None or before["timestamp"] < score["timestamp"]
                self.scores[score["userId"]] = score
                return 204, {}, b""
        return 401, {}, b""

    def _access(self, body: bytes) -> tuple[int, dict[str, str], bytes]:
        sent = {name: values[0] for name, values in parse_qs(body.decode()).items()}
        assert sent["grant_type"] == "client_credentials"
        assert sent["client_assertion_type"].endswith("jwt-bearer")
        said = self._of_tool(sent["client_assertion"], f"{self.url}/token")
        assert said["sub"] == self.client_id
        assert said["jti"]
        token = secrets.token_hex()
        self._tokens[token] = set(sent["scope"].split())
        answer = {"access_token": token, "token_type": "bearer", "scope": sent["scope"]}
        return _json(answer | {"expires_in": 3600})

    def _of_tool(self, token: str, audience: str) -> dict[str, Any]:
        """Return the claims of the tool, whose key must have signed them."""
        keys = jwk.KeySet.import_key_set(self.tool_keys())
        claims = dict(jwt.decode(token, keys, algorithms=["RS256"]).claims)
        assert (claims["iss"], claims["aud"]) == (self.client_id, audience)
        assert claims["exp"] > claims["iat"]
        return claims

    def _members(self, query: dict[str, str]) -> tuple[int, dict[str, str], bytes]:
        """Return one member a page."""
        every = list(self.people.values())
        number = int(query.get("page", 0))
        person = every[number]
        answer = {
            "id": "1", "context": {"id": self.course},
            "members": [{
                "user_id": person.sub, "name": person.name, "email": person.email,
                "roles": [f"{MEMBERSHIP}{person.role}"], "status": "Active",
            }],
        }  # fmt: skip
        status, headers, content = _json(answer)
        if number + 1 < len(every):
            following = urlencode({"course": 1, "page": number + 1})
            headers["link"] = f'<{self.url}/members?{following}>; rel="next"'
        return status, headers, content

    def _page(self, tool: str) -> tuple[int, dict[str, str], bytes]:
        """Return the page of the course, from which each person opens the tool."""
        forms = [
            f'<form method="post" action="{html.escape(tool)}/api/lti/login">'
            + "".join(
                f'<input type="hidden" name="{n}" value="{html.escape(v)}">'
                for n, v in self.begins(who, kind).items()
            )
            + f"<button>{kind} as {html.escape(person.name)}</button></form>"
            for who, person in self.people.items()
            for kind in ("open", "link")
        ]
        page = f"<!doctype html><meta charset=utf-8><h1>Robotics 1</h1>{''.join(forms)}"
        return 200, {"content-type": "text/html"}, page.encode()


def _json(content: Any, status: int = 200) -> tuple[int, dict[str, str], bytes]:
    return status, {"content-type": "application/json"}, json.dumps(content).encode()


def _posting(action: str, fields: dict[str, str]) -> tuple[int, dict[str, str], bytes]:
    """Return a page that posts a form by itself, as platforms do."""
    inputs = "".join(
        f'<input type="hidden" name="{n}" value="{html.escape(v)}">' for n, v in fields.items()
    )
    page = (
        f'<!doctype html><form method="post" action="{html.escape(action)}">{inputs}</form>'
        "<script>document.forms[0].submit()</script>"
    )
    return 200, {"content-type": "text/html"}, page.encode()
