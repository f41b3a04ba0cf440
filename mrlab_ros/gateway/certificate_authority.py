"""The lab's own authority over HTTP: its certificate, and how a browser comes to trust it.

What reads certificates is imported by the first request: most labs have no authority.
"""

from __future__ import annotations

from pathlib import Path

from fastapi import APIRouter, Request, Response

from mrlab_ros.core.base.foreign_text import for_html
from mrlab_ros.gateway.diagnostics import NO_AUTHORITY
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.settings import Settings

router = APIRouter(include_in_schema=False)

# Without a script: it is read before anything is trusted.
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>MR-Lab: certificate</title>
<link rel="icon" href="/favicon.svg">
<link rel="stylesheet" href="/ca.css">
<main>
<h1>The certificate of this lab</h1>
<p>This lab has an authority of its own, so browsers warn before they open its pages. You can go
on past the warning, or install the authority's certificate once.</p>
<p>First compare this fingerprint (SHA-256) with the one that your instructor shows you, which
<code>mrlab keys list</code> prints on the lab's machine:</p>
<pre>{fingerprint}</pre>
<p><a class="button" href="/ca.pem" download="mrlab-{name}.pem">Download the certificate</a></p>
<p class="second">{subject}, valid until {end}</p>
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

# The look of the pages, whose own style sheet has another name after each build.
STYLE = """:root { color-scheme: light dark; --page: #F7F8FA; --card: #FFFFFF; --ink: #16202B;
  --second: #4A5766; --border: #7B8896; --accent: #0B5CAD; --on-accent: #FFFFFF }
@media (prefers-color-scheme: dark) { :root { --page: #12161C; --card: #1B2129; --ink: #E8EDF2;
  --second: #A9B5C2; --border: #74818F; --accent: #6CB6FF; --on-accent: #12161C } }
body { margin: 0; padding: 24px 16px; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, sans-serif }
main { max-width: 640px; margin: 0 auto; padding: 24px; background: var(--card);
  border-radius: 12px; box-shadow: 0 1px 4px #0002 }
h1 { margin: 0 0 16px; font-size: 25px; line-height: 1.2 }
h2 { margin: 24px 0 8px; font-size: 20px }
pre { padding: 12px; border: 1px solid var(--border); border-radius: 8px; font-size: 14px;
  white-space: pre-wrap; overflow-wrap: anywhere; font-variant-numeric: tabular-nums }
li { margin: 8px 0 }
a { color: var(--accent) }
.button { display: inline-block; padding: 10px 16px; border: 0; border-radius: 8px;
  min-height: 44px; box-sizing: border-box; font: inherit; cursor: pointer;
  background: var(--accent); color: var(--on-accent); text-decoration: none; font-weight: 600 }
.second { color: var(--second); font-size: 14px }
"""


def authority_file(settings: Settings) -> Path:
    """Return the file of the authority; raises NotFound where the lab has none of its own."""
    if settings.keys is None or settings.certificate is not None:
        raise NotFound(NO_AUTHORITY())
    return settings.keys / "ca.pem"


@router.get("/ca")
def page(request: Request) -> Response:
    """Say how to trust this lab's authority."""
    from mrlab_ros.adapters.keys import certificates

    found = certificates.read_certificate(authority_file(request.app.state.settings))
    shown = certificates.fingerprint(found)
    text = PAGE.format(
        fingerprint=shown,
        name=shown[:5].replace(":", "").lower(),
        subject=for_html(certificates.common_name(found)),
        end=f"{certificates.validity(found)[1]:%d %B %Y}",
    )
    return Response(text, media_type="text/html; charset=utf-8")


@router.get("/ca.css")
def style() -> Response:
    """Send the page's style sheet: the policy allows none inside the page."""
    return Response(STYLE, media_type="text/css; charset=utf-8")


@router.get("/ca.pem")
def certificate(request: Request) -> Response:
    """Send the authority's certificate; no key is in it."""
    from cryptography.hazmat.primitives.serialization import Encoding

    from mrlab_ros.adapters.keys.certificates import read_certificate

    found = read_certificate(authority_file(request.app.state.settings))
    return Response(found.public_bytes(Encoding.PEM), media_type="application/x-x509-ca-cert")
