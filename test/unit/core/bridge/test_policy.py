"""One policy: what the gateway asks it, and what zenoh's rules allow, are the same."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
import zenoh

from mrlab_ros.core.bridge import rules as br
from mrlab_ros.core.bridge.access import role_rules
from mrlab_ros.core.bridge.policy import Policy, Verb
from mrlab_ros.core.bridge.rules import Direction, Role

ROOT = Path(__file__).parents[4]
SHIPPED = br.parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text()))
# The messages that a verb of a client is, and the way they go as the bridge sees it.
MESSAGES = {
    Verb.CALL: ("query", "ingress"),
    Verb.PUBLISH: ("put", "ingress"),
    Verb.RECEIVE: ("put", "egress"),
}


def keys() -> list[str]:
    """Return a key for each line of the allow-list, and some that none names."""
    names = [rule.name for rule in (*SHIPPED.topics, *SHIPPED.services)]
    listed = [name[1:].replace("**", "a/b").replace("*", "ur5e_1") for name in names]
    return [*dict.fromkeys(listed), "ur5e_1/command_members", "nothing/at/all"]


def zenoh_allows(role: Role, verb: Verb, key: str, prefix: str) -> bool:
    """Decide as zenoh does: a rule counts where it includes the whole key; deny wins."""
    message, flow = MESSAGES[verb]
    wanted = zenoh.KeyExpr(f"{prefix}/{key}" if prefix else key)
    found = {
        rule["permission"]
        for rule in role_rules(SHIPPED, role, prefix)
        if message in rule["messages"]
        and flow in rule["flows"]
        and any(zenoh.KeyExpr(expression).includes(wanted) for expression in rule["key_exprs"])
    }
    return found == {"allow"}


def is_topic(key: str) -> bool:
    return any(rule.pattern.fullmatch(f"/{key}") for rule in SHIPPED.topics)


@pytest.mark.parametrize("prefix", ["", "campus/lab_1"])
@pytest.mark.parametrize("role", Role)
def test_zenoh_s_rules_and_the_policy_are_the_same(role: Role, prefix: str) -> None:
    policy = Policy(SHIPPED)
    for key in keys():
        verbs = [Verb.PUBLISH]
        # Over zenoh the newest message of a topic is a query, and a subscription to what nobody
        # publishes is allowed.
        verbs.append(Verb.RECEIVE if is_topic(key) else Verb.CALL)
        for verb in verbs:
            expected = policy.may(role, verb, key)
            assert zenoh_allows(role, verb, key, prefix) == expected, (role, verb, key)


@pytest.mark.parametrize("role", Role)
def test_assets_and_definitions_are_for_everybody(role: Role) -> None:
    for key in ("assets/mrlab_ros/robots/ur5e.urdf", "assets/index.json", "schema/mrlab_msgs"):
        assert Policy(SHIPPED).may(role, Verb.RECEIVE, key)


def test_every_right_is_of_the_last_role_which_the_gateway_has() -> None:
    policy = Policy(SHIPPED)
    for key in keys():
        for verb in Verb:
            for own in (False, True):
                if any(policy.may(role, verb, key, own=own) for role in Role):
                    assert policy.may(list(Role)[-1], verb, key)


def test_nobody_passes_for_the_lab() -> None:
    policy = Policy(SHIPPED)
    for rule in SHIPPED.topics:
        if rule.direction is Direction.OUT:
            key = rule.name[1:].replace("*", "ur5e_1")
            assert not any(policy.may(role, Verb.PUBLISH, key) for role in Role)


def test_what_is_ones_own_widens_and_never_narrows() -> None:
    services = {"services": [
        {"name": "/a", "own": "student"},
        {"name": "/b", "role": "display"},
        {"name": "/c", "role": "student", "own": "operator"},
    ]}  # fmt: skip
    policy = Policy(br.parse(services))
    needed = {
        (key, own): policy.needed(Verb.CALL, key, own=own)
        for key in "abc"
        for own in (False, True)
    }
    assert needed == {
        ("a", False): Role.INSTRUCTOR, ("a", True): Role.STUDENT,
        ("b", False): Role.DISPLAY, ("b", True): Role.DISPLAY,
        ("c", False): Role.STUDENT, ("c", True): Role.STUDENT,
    }  # fmt: skip


def test_of_several_types_the_strictest_role_counts() -> None:
    services = {"services": [
        {"name": "/a", "type": "p/srv/A", "role": "display"},
        {"name": "/*", "type": "p/srv/B", "role": "operator"},
        {"name": "/**", "role": "student"},
        {"name": "/a", "role": "instructor"},
    ]}  # fmt: skip
    policy = Policy(br.parse(services))
    assert policy.needed(Verb.CALL, "a") is Role.OPERATOR
    assert policy.needed(Verb.CALL, "a/b") is Role.STUDENT
    assert policy.needed(Verb.RECEIVE, "a") is None
