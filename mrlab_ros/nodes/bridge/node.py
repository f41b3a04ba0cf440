"""Forwards the graph over zenoh in both directions, as raw CDR.

zenoh's configuration of the bridge, from its parameters.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mrlab_msgs.msg import Latency, Robots, RobotSystems

from mrlab_ros.adapters import share, threads
from mrlab_ros.adapters.yaml_files import Loader
from mrlab_ros.adapters.zenoh.configuration import LOOPBACK, configuration, log_logins
from mrlab_ros.adapters.zenoh.port import Query, Session
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.base.diagnostic import Diagnostic, of_text
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.access import bounds
from mrlab_ros.core.bridge.diagnostics import (
    ALLOW_LIST_NOT_READ,
    CLIENT_WITHOUT_ROUTER,
    CONFIG_AND_KEYS,
)
from mrlab_ros.core.bridge.guests import Guests, Share
from mrlab_ros.core.bridge.latency import Ledger, clock_answer
from mrlab_ros.core.bridge.links import (
    EVERYWHERE,
    Pace,
    check_endpoints,
    check_router,
    local_endpoint,
)
from mrlab_ros.core.bridge.rules import (
    Direction,
    LiveRules,
    Rules,
    ServiceRule,
    TopicRule,
)
from mrlab_ros.core.runtime.identity import Neighbours
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import latency_to_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.bridge.assets import AssetRoutes
from mrlab_ros.nodes.bridge.inward import GuestWatch, Inward
from mrlab_ros.nodes.bridge.outward import Outward
from mrlab_ros.nodes.bridge.routes import BridgeContext, Kept
from mrlab_ros.nodes.bridge.services import Services
from mrlab_ros.nodes.bridge.stops import STOP, StopsLeft
from mrlab_ros.nodes.parameters import AUTOMATIC, BridgeParameters
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.graph_changes import GraphChanges
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.spinning import SpunNode

if TYPE_CHECKING:
    from typing_extensions import Unpack

# zenoh's setting of the sessions of all people together, and its least value.
MAX_SESSIONS = "transport/unicast/max_sessions"
LEAST_SESSIONS = 200


def zenoh_settings(values: BridgeParameters, rules: Rules) -> tuple[Any, Guests | None]:
    """Return zenoh's configuration, and who may connect; None: anybody who reaches it.

    rules: the allow-list, whose bounds hold for all. Raises BadInput where parameters contradict
    each other, and where the keys are not in order.
    """
    file, folder, mode = values.zenoh_config, values.keys, values.mode
    connect, listen, lease = values.connect, values.listen, values.lease
    if AUTOMATIC in listen:
        listen = () if folder and connect else EVERYWHERE if folder else LOOPBACK
    if file and folder:
        raise BadInput(CONFIG_AND_KEYS(file=file, folder=folder))
    if folder and mode == "client" and not connect:
        raise BadInput(CLIENT_WITHOUT_ROUTER(folder=folder))
    if file:
        return configuration(Path(file)), None
    check_endpoints(listen, values.insecure, bool(folder))
    limits = bounds(rules, values.prefix)
    # A client of a router listens nowhere.
    door = values.socket if mode != "client" else ""
    if door:
        listen = (*listen, local_endpoint(door))
    if not folder:
        settings = configuration(
            mode=mode, listen=listen, connect=connect, lease=lease, security=limits
        )
        return settings, None
    # Here: a lab without keys needs no cryptography in its memory.
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(Path(folder))
    keys.check(now())
    guests: Guests | None = None
    if connect:
        check_router(mode, listen, connect)
        security = keys.lab_settings(now())
    else:
        security = keys.settings(rules, values.prefix, now(), local=bool(door)) | limits
        share_of_each = Share(values.sessions_each, values.guest_rate, values.guest_burst)
        guests = Guests(
            keys.people(now()), share_of_each, by_certificate=keys.login.by_certificate
        )
        security[MAX_SESSIONS] = max(LEAST_SESSIONS, guests.room)
    log_logins(passwords=keys.login.by_password)
    settings = configuration(
        mode=mode,
        listen=listen,
        connect=connect,
        lease=lease,
        base=share.directory() / "config" / "zenoh" / "lab.json5",
        security=security,
    )
    return settings, guests


STATISTICS = "/@mrlab/bridge/statistics"
CLOCK = "/@mrlab/bridge/clock"
KEPT = "/@mrlab/bridge/kept"
REPORT_PERIOD_S = 1.0
# How often calls that have waited too long are refused, s.
LATE_PERIOD_S = 0.2
# How long the forwarding thread may wait for another Python thread, s; Python's own is 5 ms.
SWITCH_INTERVAL_S = 5e-4


class BridgeNode(
    ParameterNode[BridgeParameters], name="bridge", kind=BridgeParameters, others=parameters.ALL
):
    """Checks the graph, forwards what the allow-list names, closes the routes of what is gone."""

    def __init__(self, session: Session | None = None, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        self._rules = _rules(Path(self.parameters.allow_list))
        self._topic_rules = LiveRules(self._rules.topic)
        self._service_rules = LiveRules(self._rules.service)
        prefix = self.parameters.prefix
        settings, guests = zenoh_settings(self.parameters, self._rules)
        self._session: Session = session or ZenohSession(settings)
        self._lab_clock = LabClock(self)
        self._started = time.monotonic()
        self._logged: set[str] = set()
        # The forwarding publishers, subscriptions and clients are on a node of their own.
        streams = self.hidden_node("streams")
        self._bridge = BridgeContext(self._session, streams, prefix, self._warn_once)
        self._ledger = Ledger()
        self._pace = Pace(self.parameters.discovery_period)
        self._graph: GraphChanges | None = None
        self._outward = Outward(self._bridge, self._ledger, self.parameters.lab_id, self._wake)
        self._inward = Inward(self._bridge)
        self._neighbours = Neighbours(self.parameters.lab_id)
        if self.parameters.lab_id:
            for said, topic in ((Robots, "/robots"), (RobotSystems, "/systems")):
                subscribe(self, said, topic, self._on_lab, qos.LATCHED)
        # By service: how many servers it had at the last check.
        self._servers: dict[str, int] = {}
        self._stops = StopsLeft(
            self, self.parameters.state_dir, self.parameters.lab_id, self._server_gone
        )
        self._service_routes = Services(
            self._bridge,
            self._why_not,
            keyed=bool(self.parameters.keys),
            left={STOP: self._stops.leave},
            is_down=lambda service: service == STOP and self._stops.down,
        )
        self._assets = AssetRoutes(self._bridge, share.directory(), self._rules.types)
        self._streams = SpunNode(streams)
        sys.setswitchinterval(SWITCH_INTERVAL_S)
        zid = self._session.zid
        self._declared = [
            self._session.token(rules.bridge_token(zid)),
            self._session.queryable(self._bridge.key(STATISTICS), self._answer_statistics),
            self._session.queryable(self._bridge.key(CLOCK), self._answer_clock),
        ]
        self._watch: GuestWatch | None = None
        if guests is not None:
            self._watch = GuestWatch(guests, self.get_logger().warning)
            self._declared.append(self._session.follow_links(self._watch.on_link))
        self._reports = self.create_publisher(Latency, "latency", qos.LATCHED)
        for kind, topic in ((Latency, "latency/clients"), (DiagnosticArray, "diagnostics")):
            # Subscribed, the newest reports of clients stay in the graph for late joiners, too.
            kept = Kept(self, kind, topic, qos.LATCHED_EVENTS)
            key = self._bridge.key(f"{KEPT}/{topic}")
            self._declared.append(self._session.queryable(key, kept.answer))
        self._reported = time.monotonic()
        every(self, REPORT_PERIOD_S, self._report)
        every(self, LATE_PERIOD_S, self._service_routes.refuse_late)
        self._graph = GraphChanges(self._bridge.streams, "bridge_graph", self._turn)
        self.get_logger().info(
            f"carries what {len(self._rules.topics)} rules for topics and "
            f"{len(self._rules.services)} for services name, under '{prefix or '/'}', zenoh {zid}"
        )

    def parameters_changed(self) -> None:
        self._pace.period = self.parameters.discovery_period
        self._wake()

    def _wake(self) -> None:
        if self._graph is not None:
            self._graph.wake()

    def _turn(self, changed: bool) -> float:
        """Check the graph where that is due; return the time until it is due again, s."""
        now = time.monotonic()
        if changed:
            self._pace.changed(now)
        try:
            if self._pace.wait(now) == 0.0:
                self._check(thorough=self._pace.check(now))
            self._outward.match()
        except Exception as error:
            # A failure after the shutdown of the context is no mistake.
            if self.context.ok():
                threads.name_error("bridge_graph", error)
        return self._pace.wait(time.monotonic())

    def _check(self, thorough: bool) -> None:
        """Open and close routes as the graph changed."""
        going_out: dict[str, tuple[TopicRule, str]] = {}
        coming_in: dict[str, tuple[TopicRule, str]] = {}
        for name, type_name, rule in self._topic_rules.of(self.get_topic_names_and_types()):
            out = rule.direction is Direction.OUT
            (going_out if out else coming_in).setdefault(name, (rule, type_name))
        self._outward.keep(going_out, thorough)
        self._inward.keep(coming_in, thorough)
        called: dict[str, tuple[ServiceRule, str]] = {}
        servers: dict[str, int] = {}
        # A client keeps its service's name in the graph, and the bridge has clients itself.
        for name, type_name, service in self._service_rules.of(self.get_service_names_and_types()):
            self._bridge.give_way()
            if count := self.count_services(name):
                called.setdefault(name, (service, type_name))
                servers[name] = count
        self._servers = servers
        self._service_routes.keep(called)

    def _why_not(self, service: str) -> Diagnostic | None:
        """Return why a service is not called now: another lab would carry out the call, too."""
        servers = self._servers.get(service, 0)
        return self._neighbours.why_not(service, servers, time.monotonic())

    def _server_gone(self, service: str) -> None:
        self._service_routes.server_gone(service)

    def _on_lab(self, message: Robots | RobotSystems) -> None:
        self._neighbours.notice(message.lab, time.monotonic())

    def _report(self) -> None:
        """Publish the delays from the graph to zenoh since the last report."""
        now = time.monotonic()
        window, self._reported = now - self._reported, now
        now_ns = self.get_clock().now().nanoseconds
        delays = self._ledger.report(self._bridge.give_way)
        report = latency_to_message(now_ns, "bridge", window, delays)
        self._reports.publish(report)

    def statistics(self) -> dict[str, Any]:
        """Return the traffic since the start: totals and each key's."""
        heard = self._outward.heard()
        counts = self._bridge.counts.copy()
        keys = {
            key: {**vars(count), **({"heard": heard[key]} if key in heard else {})}
            for key, count in sorted(counts.items())
        }
        every = [*counts.values(), self._bridge.gone]
        return {
            "zid": self._session.zid,
            "prefix": self._bridge.prefix,
            "uptime_s": round(time.monotonic() - self._started, 3),
            "messages": sum(count.messages for count in every),
            "bytes": sum(count.bytes for count in every),
            "refused": sum(count.refused for count in every),
            "lost": sum(count.lost for count in every),
            "keys": keys,
        }

    def _answer_statistics(self, query: Query) -> None:
        nodes = sorted(set(self.get_node_names()))
        query.reply(json.dumps({**self.statistics(), "nodes": nodes}).encode())

    def _answer_clock(self, query: Query) -> None:
        received = self._lab_clock.now_ns()
        query.reply(clock_answer(received, self._lab_clock.now_ns()))

    def _warn_once(self, text: str) -> None:
        if text not in self._logged:
            self._logged.add(text)
            self.get_logger().warning(text)

    def destroy_node(self) -> None:
        """Close everything and log the totals."""
        total = self.statistics()
        if self._graph is not None:
            self._graph.close()
        for declared in self._declared:
            declared.undeclare()
        if self._watch is not None:
            self._watch.stop()
        self._assets.stop()
        self._service_routes.stop()
        self._outward.stop()
        self._inward.keep({})
        self._streams.close()
        self._session.close()
        # Not by the node's logger: after a signal the context is shut down, and /rosout with it.
        print(
            f"bridge: carried {total['messages']} messages and {total['bytes']} bytes over "
            f"{len(total['keys'])} keys in {total['uptime_s']:.1f} s",
            flush=True,
        )
        super().destroy_node()


def _rules(path: Path) -> rules.Rules:
    path = path if path.name else share.directory() / "config" / "bridge.yaml"
    try:
        document = yaml.load(path.read_text(), Loader=Loader)
    except (OSError, yaml.YAMLError) as error:
        why = of_text(str(error))
        raise BadInput(ALLOW_LIST_NOT_READ(path=str(path), why=why)) from error
    return rules.parse(document)
