"""The policy and a real zenoh access control, held against each other: every role, key and verb.

No graph: a session with a lab's settings offers every key of the allow-list, and people connect.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
import zenoh
from graph import wait_for
from own_port import free_endpoint

from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.core.bridge.access import Login, Policy, Verb
from mrlab_ros.core.bridge.rules import Direction, Role, parse

ROOT = Path(__file__).parents[2]
RULES = parse(yaml.safe_load((ROOT / "config" / "bridge.yaml").read_text()))
POLICY = Policy(RULES)


def concrete(name: str) -> str:
    return name[1:].replace("*", "ur5e_1")


SERVICES = [concrete(rule.name) for rule in RULES.services]
TOPICS = [concrete(rule.name) for rule in RULES.topics]
OUTWARD = [concrete(rule.name) for rule in RULES.topics if rule.direction is Direction.OUT]


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> Keys:
    made = Keys.create(tmp_path_factory.mktemp("lab") / "keys", [], Login.CERTIFICATE, now())
    for role in Role:
        made.add(role.value, role, now())
    return made


class Lab:
    """A session in the place of the bridge: it answers every service and hears every topic."""

    def __init__(self, keys: Keys) -> None:
        self.endpoint = free_endpoint("tls", "localhost")
        settings = keys.settings(RULES, "", now())
        self.session = zenoh.open(configuration(listen=(self.endpoint,), security=settings))
        self.heard: set[tuple[str, str]] = set()
        self._declared = [
            self.session.declare_queryable(key, lambda query, key=key: query.reply(key, b"yes"))
            for key in [*SERVICES, *OUTWARD]
        ]
        for key in TOPICS:
            self._declared.append(self.session.declare_subscriber(key, self._hear))

    def _hear(self, sample: zenoh.Sample) -> None:
        self.heard.add((str(sample.key_expr), sample.payload.to_string()))

    def connect(self, file: Path) -> zenoh.Session:
        config = zenoh.Config.from_file(str(file))
        config.insert_json5("connect/endpoints", json.dumps([self.endpoint]))
        return zenoh.open(config)


@pytest.fixture(scope="module")
def lab(keys: Keys) -> Iterator[Lab]:
    lab = Lab(keys)
    with lab.session:
        yield lab


def answered(session: zenoh.Session, key: str) -> bool:
    return any(reply.ok for reply in session.get(key, timeout=10.0))


@pytest.mark.parametrize("who", [*Role, "gateway"])
def test_zenoh_allows_what_the_policy_does(keys: Keys, lab: Lab, who: Role | str) -> None:
    role = who if isinstance(who, Role) else list(Role)[-1]
    file = keys.client_file(who.value) if isinstance(who, Role) else keys.gateway_file
    received: set[str] = set()
    with lab.connect(file) as session:
        session.declare_subscriber("**", lambda sample: received.add(str(sample.key_expr)))
        # What this role may call is known here once its queryables are.
        open_to_all = next(key for key in SERVICES if POLICY.may(Role.DISPLAY, Verb.CALL, key))
        wait_for(lambda: answered(session, open_to_all), "the services")
        calls = {key for key in SERVICES if answered(session, key)}
        newest = {key for key in OUTWARD if answered(session, key)}
        name = who if isinstance(who, str) else who.value
        for key in [*TOPICS, *SERVICES]:
            session.put(key, name)
        # On the same way, so that what was put before has arrived or been refused.
        assert answered(session, open_to_all)
        allowed = {key for key in TOPICS if POLICY.may(role, Verb.PUBLISH, key)}
        wait_for(lambda: allowed <= {key for key, by in lab.heard if by == name}, "what is put")
        for key in OUTWARD:
            lab.session.put(key, "from the lab")
        wait_for(lambda: set(OUTWARD) <= received, "what the lab puts")
    assert calls == {key for key in SERVICES if POLICY.may(role, Verb.CALL, key)}
    assert {key for key, by in lab.heard if by == name} == allowed
    assert newest == {key for key in OUTWARD if POLICY.may(role, Verb.RECEIVE, key)}
