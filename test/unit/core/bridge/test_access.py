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
    access_control,
    overlap,
    role_rules,
)
from mrlab_ros.core.bridge.keys import key_of
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
        assert permits(rules, "put", "ingress", key) == (topic.direction is Direction.IN)
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


@pytest.mark.parametrize("file", sorted((ROOT / "config" / "zenoh").glob("*.json5")), ids=str)
def test_zenoh_reads_the_shipped_files(file):
    zenoh.Config.from_file(str(file))


def test_a_role_includes_those_before_it():
    assert [[role.may(needed) for needed in Role] for role in Role] == [
        [True, False, False, False],
        [True, True, False, False],
        [True, True, True, False],
        [True, True, True, True],
    ]
