"""Makes config/zenoh/roles.json5: the access-control rules that follow from the allow-list."""

from __future__ import annotations

import json
from pathlib import Path

import yaml

from mrlab_ros.core.bridge.access import role_rules
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


def current(root: Path) -> str:
    """Return the text for the source tree at `root`."""
    return page(parse(yaml.safe_load((root / "config" / "bridge.yaml").read_text())))
