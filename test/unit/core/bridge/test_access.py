"""Access-control rules from the allow-list and the people's roles."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
import zenoh
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.bridge import rules as br
from mrlab_ros.core.bridge.access import (
    Login,
    Person,
    Policy,
    Verb,
    access_control,
    overlap,
    role_rules,
)
from mrlab_ros.core.bridge.links import key_of
from mrlab_ros.core.bridge.rules import Direction, Role

ROOT = Path(__file__).parents[4]
SHIPPED = br.parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text()))
ANNA = Person("anna", Role.OPERATOR, "anna.1")
BEN = Person("ben", Role.DISPLAY, "ben.2")
PARTS = st.sampled_from(["a", "b", "*", "**"])
PATTERNS = st.lists(PARTS, min_size=1, max_size=5)
NAMES = st.lists(st.sampled_from(["a", "b", "c"]), min_size=1, max_size=5)


def permits(rules, message, flow, key):
    """Decide as zenoh does: a rule counts where it includes the whole key; deny wins."""
    wanted = zenoh.KeyExpr(key)
    found = {
        rule["permission"]
        for rule in rules
        if message in rule["messages"]
        and flow in rule["flows"]
        and any(zenoh.KeyExpr(expression).includes(wanted) for expression in rule["key_exprs"])
    }
    return found == {"allow"}


def fits(pattern, name):
    return br.TopicRule("/" + "/".join(pattern)).pattern.fullmatch("/" + "/".join(name))


@pytest.mark.parametrize("prefix", ["", "campus/lab_1"])
@pytest.mark.parametrize("role", Role)
def test_each_role_may_call_what_the_list_gives_it_and_no_more(role, prefix):
    rules = role_rules(SHIPPED, role, prefix)
    for service in SHIPPED.services:
        name = service.name.replace("*", "ur5e_1")
        allowed = permits(rules, "query", "ingress", key_of(name, prefix))
        assert allowed == role.may(service.role), service.name
    assert not permits(rules, "query", "ingress", key_of("/**", prefix))
    assert not permits(rules, "query", "ingress", key_of("/*/command_members", prefix))


@pytest.mark.parametrize("role", Role)
def test_every_role_may_receive_everything_and_send_only_what_comes_in(role):
    rules = role_rules(SHIPPED, role)
    for topic in SHIPPED.topics:
        key = topic.name[1:].replace("*", "ur5e_1")
        assert permits(rules, "declare_subscriber", "ingress", key)
        assert permits(rules, "put", "egress", key)
        sends = topic.direction is Direction.IN and role.may(topic.role)
        assert permits(rules, "put", "ingress", key) == sends
        assert not permits(rules, "delete", "ingress", key)
        assert not permits(rules, "declare_queryable", "ingress", key)
    assert not permits(rules, "liveliness_token", "ingress", "@/ab/@ros2_lv/SS/x/y")
    assert not permits(rules, "query", "ingress", "@/**")


def test_another_lab_under_another_prefix_is_out_of_reach():
    rules = role_rules(SHIPPED, Role.INSTRUCTOR, "lab_1")
    for message in ("query", "declare_subscriber"):
        assert permits(rules, message, "ingress", "lab_1/ur5e_1/joint_states")
        assert not permits(rules, message, "ingress", "lab_2/ur5e_1/joint_states")
        assert not permits(rules, message, "ingress", "*/ur5e_1/joint_states")


SERVICE = {"name": "/*/stop", "role": "operator"}
STRICT = {"name": "/recorder/stop", "type": "mrlab_msgs/srv/Trigger"}


@pytest.mark.parametrize(
    ("services", "allowed"),
    [
        ([STRICT, SERVICE], False),
        # The first that fits decides, whoever may call it ...
        ([SERVICE, STRICT], True),
        # ... but where the types differ, it may be either one.
        ([{**SERVICE, "type": "mrlab_msgs/srv/Seek"}, STRICT], False),
    ],
)
def test_a_pattern_does_not_open_a_stricter_service(services, allowed):
    rules = role_rules(br.parse({"services": services}), Role.OPERATOR)
    assert permits(rules, "query", "ingress", "ur5e_1/stop")
    assert permits(rules, "query", "ingress", "recorder/stop") == allowed


def test_a_topic_does_not_open_a_service_of_its_name_nor_another_topic():
    document = {
        "topics": [{"name": "/a/x"}, {"name": "/**", "direction": "in", "role": "display"}],
        "services": [{"name": "/a/*"}],
    }
    rules = role_rules(br.parse(document), Role.DISPLAY)
    assert not permits(rules, "query", "ingress", "a/x")
    assert not permits(rules, "put", "ingress", "a/x")
    assert permits(rules, "put", "ingress", "b/x")


@given(PATTERNS, PATTERNS, NAMES)
def test_patterns_that_share_a_name_overlap(one, other, name):
    if fits(one, name) and fits(other, name):
        assert overlap(one, other)
    assert overlap(one, other) == overlap(other, one)


@given(PATTERNS)
def test_every_pattern_of_the_list_becomes_a_key_expression_of_zenoh(pattern):
    name = "/" + "/".join(pattern)
    rules = br.parse({"services": [{"name": name, "role": "display"}]})
    keys = role_rules(rules, Role.DISPLAY)[2]["key_exprs"]
    assert str(zenoh.KeyExpr(keys[0])) == keys[0]
    assert zenoh.KeyExpr(keys[0]) == zenoh.KeyExpr.autocanonize(name[1:])


@pytest.mark.parametrize(
    ("login", "fields"),
    [
        (Login.CERTIFICATE, {"cert_common_names": ["anna.1"]}),
        (Login.PASSWORD, {"usernames": ["anna"]}),
        (Login.BOTH, {"cert_common_names": ["anna.1"], "usernames": ["anna"]}),
    ],
)
def test_a_person_is_known_by_what_the_login_proves(login, fields):
    found = access_control(SHIPPED, [ANNA], login)
    assert found["subjects"] == [{"id": "anna", "link_protocols": ["tls", "quic"], **fields}]


def test_this_machine_s_user_does_everything_through_the_socket_and_nobody_else():
    without = access_control(SHIPPED, [ANNA], Login.CERTIFICATE)
    found = access_control(SHIPPED, [ANNA], Login.CERTIFICATE, local=True)
    (subject,) = [each for each in found["subjects"] if each not in without["subjects"]]
    assert subject["link_protocols"] == ["unixsock-stream"]
    (policy,) = [each for each in found["policies"] if each not in without["policies"]]
    assert policy["subjects"] == [subject["id"]]
    everybody = [each["subjects"] for each in without["policies"]]
    assert all(subject["id"] not in names for names in everybody)


def test_a_campus_s_router_keeps_each_lab_to_its_own_keys_and_shows_people_all():
    labs = {"north.1": "campus/north", "south.2": "campus/south"}
    found = access_control(SHIPPED, [BEN], Login.CERTIFICATE, "campus/*", labs)
    rules = {rule["id"]: rule for rule in found["rules"]}
    subjects = {s["cert_common_names"][0]: s["id"] for s in found["subjects"]}

    def may(common_name, message, flow, key):
        policy = next(p for p in found["policies"] if subjects[common_name] in p["subjects"])
        return permits([rules[each] for each in policy["rules"]], message, flow, key)

    for name, prefix in labs.items():
        for other in labs.values():
            key = f"{other}/ur5e_1/joint_states"
            assert may(name, "put", "ingress", key) == (other == prefix)
            assert may(name, "query", "egress", f"{other}/ur5e_1/play") == (other == prefix)
            assert may("ben.2", "put", "egress", key)
            assert not may("ben.2", "put", "ingress", key)


def test_everybody_has_the_rules_of_one_role():
    found = access_control(SHIPPED, [ANNA, BEN], Login.CERTIFICATE)
    assert found["enabled"] is True
    assert found["default_permission"] == "deny"
    policies = {policy["id"]: policy for policy in found["policies"]}
    assert set(policies) == {"display", "operator"}
    assert policies["operator"]["subjects"] == ["anna"]
    assert all(rule.startswith("operator_") for rule in policies["operator"]["rules"])
    known = [rule["id"] for rule in found["rules"]]
    assert len(known) == len(set(known))
    assert set(policies["display"]["rules"]) <= set(known)


@pytest.mark.parametrize("file", sorted((ROOT / "config" / "zenoh").rglob("*.json5")), ids=str)
def test_zenoh_reads_the_shipped_files(file):
    zenoh.Config.from_file(str(file))


def test_a_role_includes_those_before_it():
    assert [[role.may(needed) for needed in Role] for role in Role] == [
        [True, False, False, False],
        [True, True, False, False],
        [True, True, True, False],
        [True, True, True, True],
    ]


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
