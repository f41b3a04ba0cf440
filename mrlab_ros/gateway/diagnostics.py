"""Diagnostics of requests, of settings, and of the assets that the gateway passes on."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import WARNING, Code

# A role in a sentence.
ROLE = "display=a display|student=a student|operator=an operator|instructor=an instructor"

# requests
NOTHING_AT = Code("nothing_at", "There is nothing at {path}.")
METHOD_NOT_POSSIBLE = Code("method_not_possible", "{method} is not possible at {path}.")
HTTP_ERROR = Code("http_error", "The request was not accepted: {detail:problem}.")
BAD_REQUEST = Code(
    "bad_request",
    "This request is not understood: {mistakes:reasons}.",
    "/api/openapi.json describes it.",
    meaning="A body, a path or a query does not have the described fields.",
)
FIELD_UNKNOWN = Code(
    "field_unknown",
    "there is no '{field}'",
    meaning="A request has a field that there is none of.",
)
FIELD_MISSING = Code(
    "field_missing", "'{field}' is missing", meaning="A request lacks a field that it must have."
)
FIELD_OUT_OF_RANGE = Code(
    "field_out_of_range",
    "'{field}' is {found}; expected [at least {least:exact}][at most {most:exact}]",
    meaning="A number in a request, or the length of a text, is out of range.",
)
FIELD_REFUSED = Code(
    "field_refused",
    "'{field}' is {found}: {why:problem}",
    meaning="A field of a request is not what it must be; what the reader of requests says.",
)
GATEWAY_FAULT = Code(
    "gateway_fault",
    "The gateway failed at this request.",
    "Its log, on the lab's machine, says why.",
    meaning="A fault of the gateway.",
)
GATEWAY_WITHOUT_LAB = Code(
    "gateway_without_lab", "This gateway has no lab.", "Start it with the endpoint of a lab."
)
LAST_KNOWN = Code(
    "last_known",
    "This is what was last known, as the store does not answer. {why:problem}",
    severity=WARNING,
    meaning="The list of trajectories is from the gateway's memory.",
)
NOT_SIGNED_IN = Code(
    "not_signed_in", "Nobody is signed in, or the sign-in has ended.", "Sign in first."
)
ROUTE_WITHOUT_POLICY = Code(
    "route_without_policy",
    "{method} {path} has no line in gateway/policy.py, so nobody may use it.",
    meaning="A fault of the gateway: a route without a policy is open to nobody.",
)
ROLE_TOO_LOW = Code(
    "role_too_low",
    f"{{person}} is {{role:choice {ROLE}}}, and this needs {{needed:choice {ROLE}}}.",
    "Ask your instructor.",
)
NO_ROLE_MAY = Code(
    "no_role_may", "No role may do this in this lab.", "Its allow-list says who may do what."
)
WRONG_HOST = Code(
    "wrong_host",
    "This gateway is not called '{host}'.",
    "Open it by the address that it printed when it started.",
    meaning="The Host of a request is no name of this gateway; DNS rebinding looks like this.",
)
WRONG_ORIGIN = Code(
    "wrong_origin",
    "This request does not come from the pages of this gateway[, but from {origin}].",
    "The header Origin must be {expected}.",
)
WRONG_CSRF = Code(
    "wrong_csrf",
    "The header X-CSRF-Token is missing or old.",
    "Take the csrf of GET /api/session.",
)
BODY_STOPPED = Code(
    "body_stopped",
    "Nothing of '{file}' came for {wait:time}, and nothing was kept.",
    "Send it again.",
)
TOO_MANY_REQUESTS = Code(
    "too_many_requests",
    "Too many {what:choice uploads=uploads|conversions=conversions|checks=checks"
    "|sign_ins_by_address=sign-ins from this address|sign_ins_by_name=sign-ins with this name"
    "|links=links from this address|pairings=pairings from this address|tries=tries"
    "|launches=launches from this address|hand_ins=files that are handed in}.",
    "Try again in {wait:time}.",
)

# settings
ALLOW_LIST_UNREADABLE = Code(
    "allow_list_unreadable", "The allow-list {path} cannot be read: {why:problem}."
)
BAD_PUBLIC_URL = Code(
    "bad_public_url",
    "{url} is no address of a site.",
    "Expected one such as https://lab.example.org.",
)
INSECURE_WITH_KEYS = Code(
    "insecure_with_keys",
    "The pages cannot be open to everybody and have keys at the same time.",
    "Leave out one of the two.",
)
CERTIFICATE_WITHOUT_KEY = Code(
    "certificate_without_key",
    "HTTPS needs a certificate and its key; one of the two is missing.",
    "Name both.",
)
OPEN_TO_NETWORK = Code(
    "open_to_network",
    "On {host}:{port:integer} anybody in the network could read and change everything.",
    "Give the lab keys, listen on 127.0.0.1 only, or accept it explicitly.",
    meaning="The pages would be served beyond this machine without keys.",
)
NO_HTTPS_FILE = Code(
    "no_https_file",
    "There is no file {path}, which HTTPS needs.",
    "Make one, or name your own certificate and its key.",
)
BAD_ADDRESS = Code(
    "bad_listen_address",
    "'{address}' is no address to listen on.",
    "Expected HOST:PORT such as 127.0.0.1:8080 or 0.0.0.0:8080.",
)
HTTPS_UNUSABLE = Code(
    "https_unusable",
    "{certificate} and {key} cannot serve HTTPS: {why:problem}.",
    "Expected a certificate and its key without password (PEM).",
)
PORT_TAKEN = Code(
    "pages_not_served",
    "The pages cannot be served on {host}:{port:integer}: {why:problem}.",
    "Another lab may have that port; choose another one.",
)
NO_AUTHORITY = Code(
    "no_authority",
    "This gateway has no authority of its own, so there is nothing to install.",
)

# assets
ASSET_CHANGED = Code("asset_changed", "{asset} changed while it was sent.", "Load it again.")
ASSET_UNSTEADY = Code(
    "asset_unsteady", "{asset} changes again and again.", "Try again when it is complete."
)
ASSET_UNANSWERED = Code(
    "asset_unanswered",
    "The lab does not answer for {asset}.",
    "Check that the lab runs, then try again.",
)
ROBOT_NOWHERE = Code(
    "robot_nowhere",
    "The robot is neither here nor in the lab: {here:problem}; {lab:problem}.",
)
ASSET_TOO_LARGE = Code(
    "asset_too_large", "{asset} has {size:bytes}, which is too large for a robot."
)
