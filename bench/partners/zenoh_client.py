"""The configuration of a zenoh client, as a headset has it."""

from __future__ import annotations

import json

import zenoh


def client_config(endpoint: str, **more: object) -> zenoh.Config:
    """Return a client's configuration; more: further settings, with __ for / in their keys."""
    config = zenoh.Config()
    settings = {
        "mode": "client",
        "connect/endpoints": [endpoint],
        "scouting/multicast/enabled": False,
        **{key.replace("__", "/"): value for key, value in more.items()},
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config
