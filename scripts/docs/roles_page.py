"""Makes the files of config/zenoh/ whose access-control rules follow from the allow-list."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import yaml

from mrlab_ros.core.bridge.access import Login, Person, access_control, role_rules
from mrlab_ros.core.bridge.rules import Role, Rules, parse

HEAD = """\
// The rights of each role as zenoh's access-control rules, for the shipped allow-list without a
// prefix. Generated from config/bridge.yaml by `make docs`. The bridge does not read this file: it
// makes the rules from its own allow-list and prefix and adds the people (`mrlab keys config`
// prints all). Read it, or start from it for a router of your own.
"""


def page(rules: Rules) -> str:
    """Return the file's text for an allow-list."""
    lines = [json.dumps(rule) for role in Role for rule in role_rules(rules, role)]
    body = ",\n      ".join(lines)
    return f"""{HEAD}{{
  access_control: {{
    enabled: true,
    default_permission: "deny",
    rules: [
      {body}
    ],
    // People, such as {{ id: "anna", cert_common_names: ["anna.1f2e3d4c"] }}
    subjects: [],
    // Roles, such as {{ id: "display", rules: ["display_subscribes", ...], subjects: ["anna"] }}
    policies: [],
  }},
}}
"""


# Placeholders of people, routers and labs; a common name ends with a mark that is drawn anew.
SCREEN = Person("hall", Role.DISPLAY, "hall.1f2e3d4c")
ANNA = Person("anna", Role.OPERATOR, "anna.5a6b7c8d")
HUB = Person("the campus", Role.DISPLAY, "MR-Lab")
LABS = {"north.9e8f7a6b": "campus/north", "south.c5d4e3f2": "campus/south"}
CAMPUS_HEAD = """\
// {what}
// Generated from config/bridge.yaml by `make docs`; names are examples. docs/campus.md explains
// it. The same for your own people, with certificates and keys within, writes
//   {command}
"""
CAMPUS = """\
{{
  mode: "router",
  listen: {{ endpoints: ["tls/0.0.0.0:7447"] }},
  connect: {{
    endpoints: {endpoints},
    // A router that is not there yet, or no more, is tried twice a second, for ever.
    exit_on_failure: false,
    retry: {{ period_init_ms: 250, period_max_ms: 500, period_increase_factor: 1.5 }},
  }},
  scouting: {{ multicast: {{ enabled: false }}, gossip: {{ enabled: false }} }},
  adminspace: {{ enabled: false }},
  transport: {{
    unicast: {{ open_timeout: 2000, accept_timeout: 5000, accept_pending: 50, max_sessions: 200 }},
    link: {{
      // A link that is silent for so long, ms, counts as broken.
      tx: {{ lease: 1500 }},
      protocols: ["tls", "quic"],
      rx: {{ max_message_size: 16842752 }},
      tls: {{
        // {authority}
        root_ca_certificate: "ca.pem",
        listen_certificate: "server.pem",
        listen_private_key: "server.key",
        enable_mtls: true,
        close_link_on_expiration: true,{connect}
      }},
    }},
  }},
  access_control: {{
    enabled: true,
    default_permission: "deny",
    rules: [
      {rules}
    ],
    subjects: [
      {subjects}
    ],
    policies: [
      {policies}
    ],
  }},
}}
"""
CONNECT = """
        // With which this router connects to the campus's.
        connect_certificate: "north.pem",
        connect_private_key: "north.key",
        verify_name_on_connect: true,"""


def campus(rules: Rules) -> str:
    """Return the router of a campus: two labs, and a screen that sees both."""
    access = access_control(rules, [SCREEN], Login.CERTIFICATE, "campus/*", LABS)
    return _campus(
        access,
        "The router of a campus: each lab may do everything below its own prefix, and no more.",
        "mrlab keys router --prefix campus --lab north --lab south",
        authority="Of this router's own keys folder: it signed the keys of its labs and people.",
    )


def router(rules: Rules) -> str:
    """Return the router of one lab of a campus."""
    people, labs = [ANNA, HUB], {"lab.0d1c2b3a": "campus/north"}
    return _campus(
        access_control(rules, people, Login.CERTIFICATE, "campus/north", labs),
        "The router of a lab: lets its people in, and the campus as a person with one role.",
        "mrlab keys router --prefix campus/north --hub north.json5",
        authority="The lab's own authority and, behind it in the same file, that of the campus.",
        endpoints=["tls/campus.example.org:7447"],
        connect=CONNECT,
    )


def _campus(access: dict[str, Any], what: str, command: str, **parts: Any) -> str:
    used = {rule for policy in access["policies"] for rule in policy["rules"]}
    found = {
        **access,
        "rules": [rule for rule in access["rules"] if rule["id"] in used],
    }
    lists = {
        name: ",\n      ".join(map(json.dumps, found[name]))
        for name in ("rules", "subjects", "policies")
    }
    endpoints = json.dumps(parts.pop("endpoints", []))
    body = CAMPUS.format(endpoints=endpoints, **{"connect": "", **parts}, **lists)
    return CAMPUS_HEAD.format(what=what, command=command) + body


def files(root: Path) -> dict[str, str]:
    """Return the text of each file for the source tree at `root`, by its path."""
    rules = parse(yaml.safe_load((root / "config" / "bridge.yaml").read_text()))
    return {
        "config/zenoh/roles.json5": page(rules),
        "config/zenoh/campus/campus.json5": campus(rules),
        "config/zenoh/campus/router.json5": router(rules),
    }
