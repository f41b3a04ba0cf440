"""Sign-in by an OpenID Connect provider, such as a university's: code flow with PKCE.

What speaks with a provider is imported by the first sign-in: most labs have none.
"""

from __future__ import annotations

import fnmatch
import importlib
import re
import secrets
import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.checks import TEXT, Text
from mrlab_ros.core.base.checks import enum_values as one_of
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.base.records import field, read
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed
from mrlab_ros.gateway.people.accounts import Account, Accounts, plain_name
from mrlab_ros.gateway.people.diagnostics import (
    MAIL_NOT_ADMITTED,
    NOT_CONFIRMED,
    PROVIDER_INCOMPLETE,
    PROVIDER_OTHER,
    PROVIDER_SILENT,
    SIGN_IN_NOT_BEGUN,
    SIGN_INS_FULL,
)

if TYPE_CHECKING:
    import httpx
    from authlib.integrations.httpx_client import AsyncOAuth2Client

SCOPE = "openid profile email"
# Asymmetric ones only: with HS256 a public key would be a password.
ALGORITHMS = ["RS256", "PS256", "ES256", "ES384", "EdDSA"]
# How long somebody may take at the provider, and how many may be there at once.
PENDING_LIFETIME_S = 600.0
PENDING = 1000
TIMEOUT_S = 10.0
CLOCK_SLACK_S = 60


class NotBegun(NotAllowed):
    """Somebody comes back who did not begin here, or took too long."""

    kind = "not_begun"


class NotConfirmed(NotAllowed):
    """The provider does not confirm who somebody is."""

    kind = "not_confirmed"


@dataclass(frozen=True)
class Provider:
    """A provider, as the file of `--oidc` names it."""

    issuer: str = field(
        Text(re.compile(r"https?://\S+"), "the https:// address of the provider"),
        "Address of the provider; .well-known/openid-configuration is below it.",
    )
    client_id: str = field(TEXT, "By which the provider knows this lab.")
    client_secret: str = field(TEXT, "The secret that the provider gave; empty: none.", "")
    name_claim: str = field(TEXT, "What becomes the name here.", "preferred_username")
    emails: str = field(
        TEXT, "Who may sign in: patterns such as *@uni.example, with spaces; empty: all.", ""
    )
    role: Role = field(one_of(Role), "Role of a new user.", Role.STUDENT)


def read_provider(path: Path) -> Provider:
    """Read the file of `--oidc`; raises BadInput that names all mistakes."""
    return read(Provider, read_yaml(path), str(path))


@dataclass(frozen=True)
class Pending:
    """Somebody who is at the provider now; expires: s, monotonic."""

    nonce: str
    verifier: str
    redirect: str
    expires: float


class Oidc:
    """Signs people in by a provider. transport: a fake one of tests.

    steady: s, monotonic.
    """

    def __init__(
        self,
        provider: Provider,
        *,
        transport: httpx.AsyncBaseTransport | None = None,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self.provider = provider
        self._transport = transport
        self._steady = steady
        self._metadata: dict[str, Any] | None = None
        self._pending: dict[str, Pending] = {}

    async def begin(self, redirect: str) -> tuple[str, str]:
        """Return where to send somebody, and the state that the browser brings back.

        redirect: the URL of this gateway to come back to. Raises Unavailable.
        """
        metadata = await self._discover()
        now = self._steady()
        self._pending = {s: p for s, p in self._pending.items() if p.expires > now}
        if len(self._pending) >= PENDING:
            raise Unavailable(SIGN_INS_FULL())
        pending = Pending(
            secrets.token_urlsafe(24), secrets.token_urlsafe(48), redirect,
            now + PENDING_LIFETIME_S,
        )  # fmt: skip
        async with self._client(redirect) as client:
            url, state = client.create_authorization_url(
                metadata["authorization_endpoint"],
                nonce=pending.nonce,
                code_verifier=pending.verifier,
            )
        self._pending[state] = pending
        return str(url), str(state)

    async def finish(self, url: str, state: str) -> Mapping[str, Any]:
        """Return the claims about who came back; url: with the provider's code.

        Raises NotBegun where this is no answer to a sign-in that was begun here, NotConfirmed
        where the provider does not say who it is, Unavailable where it does not answer.
        """
        pending = self._pending.pop(state, None)
        if pending is None or pending.expires <= self._steady():
            raise NotBegun(SIGN_IN_NOT_BEGUN())
        import httpx
        from authlib.integrations.base_client import OAuthError
        from joserfc import jwk, jwt
        from joserfc.errors import JoseError

        metadata = await self._discover()
        try:
            async with self._client(pending.redirect) as client:
                token = await client.fetch_token(
                    metadata["token_endpoint"],
                    authorization_response=url,
                    state=state,
                    code_verifier=pending.verifier,
                )
                keys = jwk.KeySet.import_key_set((await client.get(metadata["jwks_uri"])).json())
            claims = jwt.decode(token["id_token"], keys, algorithms=ALGORITHMS).claims
            jwt.JWTClaimsRegistry(
                leeway=CLOCK_SLACK_S,
                iss={"essential": True, "value": metadata["issuer"]},
                aud={"essential": True, "value": self.provider.client_id},
                sub={"essential": True},
                exp={"essential": True},
                nonce={"essential": True, "value": pending.nonce},
            ).validate(claims)
        except (OAuthError, JoseError, KeyError, ValueError) as error:
            why = f"{type(error).__name__}: {error}"
            raise NotConfirmed(NOT_CONFIRMED(why=why)) from error
        except httpx.HTTPError as error:
            raise _unreachable(self.provider, error) from error
        return claims

    def account(self, claims: Mapping[str, Any], accounts: Accounts) -> Account:
        """Return the person whom claims are about, a new one where there is none yet.

        Raises NotAllowed where the person may not sign in.
        """
        self._check_email(claims)
        subject = f"{claims['iss']} {claims['sub']}"
        wanted = plain_name(str(claims.get(self.provider.name_claim) or claims["sub"]))
        return accounts.of_provider(subject, wanted, self.provider.role)

    def _check_email(self, claims: Mapping[str, Any]) -> None:
        patterns = self.provider.emails.lower().split()
        email = str(claims.get("email", "")).lower()
        if not patterns:
            return
        if claims.get("email_verified") not in (True, "true") or not any(
            fnmatch.fnmatchcase(email, pattern) for pattern in patterns
        ):
            raise NotAllowed(MAIL_NOT_ADMITTED(email=email))

    async def _discover(self) -> dict[str, Any]:
        """Return what the provider says of itself, asked once."""
        if self._metadata is None:
            import httpx

            url = f"{self.provider.issuer.rstrip('/')}/.well-known/openid-configuration"
            try:
                async with httpx.AsyncClient(
                    transport=self._transport, timeout=TIMEOUT_S
                ) as client:
                    answer = await client.get(url)
                    found = answer.raise_for_status().json()
                needed = ("authorization_endpoint", "token_endpoint", "jwks_uri")
                if missing := [name for name in needed if not isinstance(found.get(name), str)]:
                    raise Unavailable(PROVIDER_INCOMPLETE(url=url, missing=missing))
                if found.get("issuer", "").rstrip("/") != self.provider.issuer.rstrip("/"):
                    other = str(found.get("issuer", ""))
                    raise Unavailable(PROVIDER_OTHER(url=url, issuer=other))
            except (httpx.HTTPError, ValueError) as error:
                raise _unreachable(self.provider, error) from error
            self._metadata = found
        return self._metadata

    def _client(self, redirect: str) -> AsyncOAuth2Client:
        with warnings.catch_warnings():
            # It asks for the successor of httpx. This module of it has its warnings shown, so it
            # must not be imported after the next line.
            importlib.import_module("authlib.deprecate")
            warnings.simplefilter("ignore")
            from authlib.integrations.httpx_client import AsyncOAuth2Client

        return AsyncOAuth2Client(
            client_id=self.provider.client_id,
            client_secret=self.provider.client_secret or None,
            token_endpoint_auth_method=None if self.provider.client_secret else "none",
            scope=SCOPE,
            redirect_uri=redirect,
            code_challenge_method="S256",
            transport=self._transport,
            timeout=TIMEOUT_S,
        )


def _unreachable(provider: Provider, error: Exception) -> Unavailable:
    why = f"{type(error).__name__}: {error}"
    return Unavailable(PROVIDER_SILENT(issuer=provider.issuer, why=why))
