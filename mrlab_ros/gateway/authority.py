"""The lab's own authority over HTTP: its certificate, and how a browser comes to trust it."""

from __future__ import annotations

import html
from pathlib import Path

from cryptography.hazmat.primitives.serialization import Encoding
from fastapi import APIRouter, Request, Response

from mrlab_ros.adapters.keys import certificates
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.settings import Settings

router = APIRouter(include_in_schema=False)

# Without a script: it is read before anything is trusted.
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>MR-Lab: certificate</title>
<main>
<h1>The certificate of this lab</h1>
<p>This lab has an authority of its own, so browsers warn before they open its pages. You can go
on past the warning, or install the authority's certificate once.</p>
<p>First compare this fingerprint (SHA-256) with the one that your instructor shows you, which
<code>mrlab keys list</code> prints on the lab's machine:</p>
<pre>{fingerprint}</pre>
<p><a href="/ca.pem" download="mrlab-{name}.pem">Download the certificate</a> of {subject}, valid
until {end}.</p>
<h2>Where it goes</h2>
<ul>
<li>Windows: open the file, <i>Install Certificate</i>, <i>Trusted Root Certification
Authorities</i>.</li>
<li>macOS: open the file with Keychain Access, then set it to <i>Always Trust</i>.</li>
<li>iPhone and iPad: open the file, install the profile, then switch it on in <i>Settings,
General, About, Certificate Trust Settings</i>.</li>
<li>Android: <i>Settings, Security, Encryption and credentials, Install a certificate, CA
certificate</i>.</li>
<li>Firefox: <i>Settings, Privacy and Security, View Certificates, Authorities, Import</i>.</li>
<li>Headsets: go on past the warning, as most have no place for it. By cable none is needed; the
lab's documentation says how.</li>
</ul>
</main>
</html>
"""


def authority_file(settings: Settings) -> Path:
    """Return the file of the authority; raises NotFound where the lab has none of its own."""
    if settings.keys is None or settings.certificate is not None:
        raise NotFound("this gateway has no authority of its own, so there is nothing to install")
    return settings.keys / "ca.pem"


@router.get("/ca")
def page(request: Request) -> Response:
    """Say how to trust this lab's authority."""
    found = certificates.read_certificate(authority_file(request.app.state.settings))
    shown = certificates.fingerprint(found)
    text = PAGE.format(
        fingerprint=shown,
        name=shown[:5].replace(":", "").lower(),
        subject=html.escape(certificates.common_name(found)),
        end=f"{certificates.validity(found)[1]:%d %B %Y}",
    )
    return Response(text, media_type="text/html; charset=utf-8")


@router.get("/ca.pem")
def certificate(request: Request) -> Response:
    """Send the authority's certificate; no key is in it."""
    found = certificates.read_certificate(authority_file(request.app.state.settings))
    return Response(found.public_bytes(Encoding.PEM), media_type="application/x-x509-ca-cert")
