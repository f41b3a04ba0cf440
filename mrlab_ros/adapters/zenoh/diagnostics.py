"""Diagnostics of zenoh."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

BAD_ZENOH_FILE = Code(
    "bad_zenoh_file",
    "zenoh does not accept {file}: {why:problem}.",
    "docs/bridge.md has examples.",
    meaning="A file with settings of zenoh.",
)
BAD_ZENOH_SETTINGS = Code(
    "bad_zenoh_settings",
    "zenoh does not accept mode {mode}[, listen {listen:list}][, connect {connect:list}]: "
    "{why:problem}.",
    "docs/bridge.md has examples.",
    meaning="The parameters of the bridge's links.",
)
ENDPOINT_TAKEN = Code(
    "endpoint_taken",
    "The bridge cannot listen on {endpoints:list}: another program has that port, perhaps a lab "
    "that still runs.",
    "Stop it, or choose another port with the parameter listen.",
    meaning="The port of an endpoint is in use.",
)
ZENOH_NOT_OPEN = Code(
    "zenoh_not_open",
    "The bridge cannot open zenoh on {endpoints:list}: {why:problem}.",
    "Check the parameters listen, connect and zenoh_config.",
    meaning="zenoh does not start with these settings.",
)
NO_LAB_AT = Code(
    "no_lab_at",
    "No lab answers at {endpoint}: {why:problem}.",
    meaning="A client of zenoh finds nobody at an endpoint.",
    commands=("mrlab status",),
)
NOTHING_ANSWERS = Code(
    "nothing_answers",
    "Nothing answers {key}.",
    meaning="A query of zenoh got no reply.",
    commands=("mrlab status",),
)
