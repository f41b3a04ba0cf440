"""The allow-list, the keys and the rate caps of the bridge."""

from importlib import import_module
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import ONE_OF
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import rules as br
from mrlab_ros.core.bridge.diagnostics import RULE_GOES_OUT
from mrlab_ros.core.bridge.links import key_of

JOINTS = "sensor_msgs/msg/JointState"
COMMAND_MEMBERS = "mrlab_msgs/srv/CommandMembers"
ROOT = Path(__file__).parents[4]
SHIPPED = ROOT / "config" / "bridge.yaml"


def topics(*entries):
    return br.parse({"topics": list(entries)})


@pytest.mark.parametrize(
    ("rule", "name", "fits"),
    [
        ("/robots", "/robots", True),
        ("/robots", "/robots2", False),
        ("/robots", "/lab/robots", False),
        ("/*/joint_states", "/ur5e_1/joint_states", True),
        ("/*/joint_states", "/joint_states", False),
        ("/*/joint_states", "/a/b/joint_states", False),
        ("/**/joint_states", "/joint_states", True),
        ("/**/joint_states", "/a/b/joint_states", True),
        ("/camera/**", "/camera/front/image", True),
        ("/camera/**", "/camera", True),
        ("/camera/**", "/cameras", False),
    ],
)
def test_a_name_fits_part_by_part(rule, name, fits):
    assert (topics({"name": rule}).topic(name, JOINTS) is not None) == fits


def test_the_first_rule_of_the_right_type_decides():
    rules = topics(
        {"name": "/a/x", "type": "std_msgs/msg/String", "priority": 1},
        {"name": "/a/*", "type": JOINTS, "priority": 2},
        {"name": "/**", "priority": 3},
    )
    assert rules.topic("/a/x", "std_msgs/msg/String").priority == 1
    assert rules.topic("/a/x", JOINTS).priority == 2
    assert rules.topic("/b", JOINTS).priority == 3


def test_nothing_is_carried_that_is_not_named():
    assert br.Rules().topic("/robots", JOINTS) is None
    assert br.parse({}).service("/lab/spawn_robot", "mrlab_msgs/srv/Trigger") is None


@pytest.mark.parametrize(
    ("document", "words"),
    [
        (None, "is empty; expected a mapping with the fields topics and services"),
        (
            {"topic": []},
            "unknown; expected topics and services. Did you mean 'topics'?",
        ),
        ({"topics": ["/robots"]}, "expected an entry with a name"),
        ({"topics": [{"priority": 1}]}, "expected an entry with a name"),
        ({"topics": [{"name": "robots"}]}, "expected a full name"),
        ({"topics": [{"name": "/a b"}]}, "expected a full name"),
        ({"topics": [{"name": "/a", "color": 1}]}, "'color' is unknown"),
        (
            {"topics": [{"name": "/a", "priority": 0}]},
            "priority is 0; expected a whole number from 1 to 7",
        ),
        ({"topics": [{"name": "/a", "priority": "high"}]}, "priority is 'high'"),
        ({"topics": [{"name": "/a", "express": 1}]}, "express is 1; expected true or false"),
        ({"topics": [{"name": "/a", "max_rate": float("nan")}]}, "max_rate is nan"),
        ({"topics": [{"name": "/a", "direction": "both"}]}, "expected out or in"),
        ({"topics": [{"name": "/a", "type": "mrlab_msgs/srv/Trigger"}]}, "package/msg/Name"),
        ({"topics": {"name": "/a"}}, "expected a list"),
        ({"topics": [5], "services": [{"name": "b"}]}, "allow-list has 2 mistakes"),
        ({"services": [{"name": "/a", "timeout": 0}]}, "timeout is 0"),
        ({"services": [{"name": "/a", "waiting": 0}]}, "waiting is 0"),
        ({"services": [{"name": "/a", "priority": 1}]}, "'priority' is unknown"),
    ],
)
def test_a_wrong_list_is_refused_in_words(document, words):
    with pytest.raises(BadInput) as caught:
        br.parse(document)
    assert words in str(caught.value)


def test_the_shipped_list_carries_the_lab_and_keeps_the_rest_inside():
    rules = br.parse(yaml.safe_load(SHIPPED.read_text()))
    motion = rules.topic("/ur5e_1/joint_states", JOINTS)
    assert (motion.priority, motion.congestion) == (2, br.Congestion.DROP)
    assert rules.topic("/robots", "mrlab_msgs/msg/Robots").congestion is br.Congestion.BLOCK
    assert rules.topic("/rosout", "rcl_interfaces/msg/Log") is None
    assert rules.service("/ur5e_1/play", "mrlab_msgs/srv/Trigger") is not None
    assert rules.service("/ur5e_1/command_members", COMMAND_MEMBERS) is None
    assert rules.service("/lab/set_parameters", "rcl_interfaces/srv/SetParameters") is None


def test_keys_are_those_of_the_stock_bridge():
    assert key_of("/ur5e_1/joint_states") == "ur5e_1/joint_states"
    assert key_of("/robots", "campus/lab_1") == "campus/lab_1/robots"


@pytest.mark.parametrize("prefix", ["/lab", "lab/", "a//b", "a b", "*", "lab/**", "@x"])
def test_a_prefix_that_is_no_key_is_refused(prefix):
    with pytest.raises(BadInput):
        br.checked_prefix(prefix)


def test_who_may_receive_cannot_be_said_topic_by_topic():
    assert topics({"name": "/a", "direction": "in", "role": "display"}).topics[0].role
    with refused(RULE_GOES_OUT, BadInput, topic="/a"):
        topics({"name": "/a", "role": "operator"})
    with refused(ONE_OF, BadInput, choices=["display", "student", "operator", "instructor"]):
        topics({"name": "/a", "direction": "in", "role": "boss"})


def test_liveliness_tokens_are_those_of_the_stock_bridge():
    qos = br.TopicQos(reliable=True, latched=False, depth=10, type_hash="RIHS01_0a")
    assert br.bridge_token("ab") == "@/ab/@ros2_lv"
    assert br.topic_token("ab", br.Direction.OUT, "ur5e_1/joint_states", JOINTS, qos) == (
        "@/ab/@ros2_lv/MP/ur5e_1§joint_states/sensor_msgs§msg§JointState"
        "/:1:0:0,10:typehash=RIHS01_0a;"
    )
    latched = br.TopicQos(reliable=False, latched=True, depth=1)
    token = br.topic_token("ab", br.Direction.IN, "robots", "mrlab_msgs/msg/Robots", latched)
    assert token == "@/ab/@ros2_lv/MS/robots/mrlab_msgs§msg§Robots/:0:1:0,1"
    assert br.service_token("ab", "ur5e_1/play", "mrlab_msgs/srv/Trigger") == (
        "@/ab/@ros2_lv/SS/ur5e_1§play/mrlab_msgs§srv§Trigger"
    )


@given(
    st.floats(min_value=0.5, max_value=1000),
    st.lists(st.integers(min_value=0, max_value=br.SECOND // 50), min_size=1, max_size=200),
)
def test_a_rate_cap_spaces_values_and_never_loses_the_last(rate, gaps):
    cap, now, sent = br.RateCap(rate), 0, []
    for number, gap in enumerate(gaps):
        now += gap
        value = cap.take(now)
        if value is not None:
            sent.append((now, value))
        value = cap.offer(number, now)
        if value is not None:
            sent.append((now, value))
    if cap.due_ns is not None:
        assert cap.take(cap.due_ns - 1) is None
        sent.append((cap.due_ns, cap.take(cap.due_ns)))
    assert sent[-1][1] == len(gaps) - 1
    assert [value for _, value in sent] == sorted({value for _, value in sent})
    span = sent[-1][0] - sent[0][0]
    # On the grid a value may follow a late one early, but never more than the rate allows.
    assert len(sent) <= span / cap.period_ns + 2


def test_a_rate_cap_keeps_the_mean_rate_of_values_that_come_off_its_grid():
    cap = br.RateCap(100.0)
    passed = [t for t in range(0, br.SECOND, 3_000_000) if cap.offer(t, t) is not None]
    assert len(passed) == pytest.approx(100, abs=1)


def test_every_type_of_the_shipped_list_exists():
    rules = br.parse(yaml.safe_load(SHIPPED.read_text()))
    for rule in (*rules.topics, *rules.services):
        package, folder, name = rule.type.split("/")
        assert hasattr(import_module(f"{package}.{folder}"), name), rule.type


def test_rules_are_looked_for_once_and_remembered_as_long_as_their_names_are_in_the_graph():
    asked = []
    rules = br.parse({"topics": [{"name": "/*/state", "direction": "out"}]})

    def find(name, type_name):
        asked.append(name)
        return rules.topic(name, type_name)

    live = br.LiveRules(find)
    graph = [("/a/state", ["x/msg/A"]), ("/a/other", ["x/msg/A"])]
    for _ in range(2):
        assert [name for name, _, _ in live.of(graph)] == ["/a/state"]
    assert asked == ["/a/state", "/a/other"]
    assert list(live.of([])) == []
    assert len(list(live.of(graph))) == 1
    assert len(asked) == 4
