"""Two labs with the same robot behind routers of their own, and a campus's router between them."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import ExitStack
from types import SimpleNamespace

import numpy as np
import pytest
import small_lab
import zenoh
from child_process import start_child
from graph import wait_for
from in_process import mrlab
from mrlab_msgs.msg import PlaybackState
from mrlab_msgs.srv import SetRate, Trigger
from own_port import free_endpoint
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from small_lab import TRAJECTORIES
from zenoh import ext
from zenoh_side import JOINTS

from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.bridge.node import BridgeNode

ROUTER = (sys.executable, "-m", "mrlab_ros.processes.router")
# Of a trajectory of 10 s.
RATES = {"north": 0.5, "south": 0.25}
TENTH = np.radians(0.1)


def keys(*words):
    answer = mrlab("keys", *words)
    assert answer.returncode == 0, answer.stderr
    return answer.stdout


class Site:
    """A keys folder and the router that it is for."""

    def __init__(self, folder, people, *router, hub=None):
        self.folder, self.endpoint = folder, free_endpoint("tls", "localhost")
        keys("init", "--dir", folder)
        for name, role in people.items():
            keys("add", name, "--role", role, "--dir", folder)
        keys("router", "--dir", folder, *router)
        # The port is the test's own.
        document = json.loads((folder / "router.json5").read_text())
        document["listen"]["endpoints"] = [self.endpoint]
        if hub is not None:
            document["connect"]["endpoints"] = [hub.endpoint]
        (folder / "router.json5").write_text(json.dumps(document))
        self.process = None

    def start(self):
        argv = (*ROUTER, str(self.folder / "router.json5"))
        self.process = start_child(*argv, stdout=subprocess.PIPE, text=True)
        wait_for(lambda: "routes" in self.process.stdout.readline(), "the router")

    def kill(self):
        self.process.kill()
        self.process.communicate()

    def session(self, name):
        config = zenoh.Config.from_file(str(self.folder / "clients" / f"{name}.json5"))
        config.insert_json5("connect/endpoints", json.dumps([self.endpoint]))
        return zenoh.open(config)


class Screen:
    """A client that draws one lab's robot by its clock, as pages and headsets do."""

    def __init__(self, session, prefix):
        self.clock, self.joints = None, []
        self._held = [
            ext.declare_advanced_subscriber(
                session,
                f"{prefix}/ur5e_1/playback_state",
                self._note,
                history=ext.HistoryConfig(detect_late_publishers=True),
            ),
            session.declare_subscriber(f"{prefix}/{JOINTS}", self._arrive),
        ]

    def _note(self, sample):
        state = deserialize_message(sample.payload.to_bytes(), PlaybackState)
        if state.state == PlaybackState.PLAYING:
            pair = state.clock
            self.clock = PlaybackClock(time_from_message(pair.stamp), pair.position, pair.rate)

    def _arrive(self, sample):
        self.joints.append(deserialize_message(sample.payload.to_bytes(), JointState))

    def off(self, joints):
        """Return how far the pose that is drawn at a joint state's instant is from it, rad."""
        trajectory = TRAJECTORIES["long"]
        row = self.clock.at(time_from_message(joints.header.stamp)) * trajectory.frame_rate
        columns = trajectory.positions.T
        drawn = [np.interp(row, np.arange(len(column)), column) for column in columns]
        return np.abs(np.array(drawn) - joints.position).max()


@pytest.fixture
def campus(tmp_path):
    """Run the campus's router and those of two labs."""
    hub = Site(
        tmp_path / "hub",
        {"dean": "operator", "hall": "display"},
        *("--prefix", "campus", "--lab", "north", "--lab", "south"),
    )
    labs = {
        name: Site(
            tmp_path / name,
            {"anna": "instructor"},
            *("--prefix", f"campus/{name}", "--hub", hub.folder / "labs" / f"{name}.json5"),
            *("--hub-role", "operator"),
            hub=hub,
        )
        for name in RATES
    }
    sites = [hub, *labs.values()]
    try:
        for site in sites:
            site.start()
        yield SimpleNamespace(hub=hub, labs=labs)
    finally:
        for site in sites:
            if site.process is not None:
                site.kill()


def test_labs_of_a_campus_are_drawn_right_while_a_router_is_gone(graph, other_graph, campus):
    graphs = {"north": graph, "south": other_graph}
    true = {}
    for name, each in graphs.items():
        site = campus.labs[name]
        each.add(
            BridgeNode,
            keys=str(site.folder),
            mode="client",
            connect=[site.endpoint],
            prefix=f"campus/{name}",
            discovery_period=0.02,
        )
        small_lab.start(each)
        small_lab.load(each, small_lab.spawn(each), "long")
        true[name] = each.listen(JointState, f"/{JOINTS}", qos.STREAM)
    with ExitStack() as stack:
        dean, hall = (stack.enter_context(campus.hub.session(n)) for n in ("dean", "hall"))
        screens = {name: Screen(hall, f"campus/{name}") for name in RATES}

        def call(session, name, kind, **fields):
            key = f"campus/{name}/ur5e_1/{'play' if kind is Trigger else 'set_rate'}"
            replies = list(
                session.get(key, payload=bytes(serialize_message(kind.Request(**fields))))
            )
            return [deserialize_message(r.ok.payload.to_bytes(), kind.Response) for r in replies]

        for name, rate in RATES.items():
            wait_for(lambda n=name: screens[n].joints, f"the arm of {name}")
            assert call(hall, name, Trigger) == []
            (answer,) = call(dean, name, SetRate, rate=rate)
            assert answer.success, answer.message
            (answer,) = call(dean, name, Trigger)
            assert answer.success, answer.message
        # What a lab's own people send stays in their lab.
        anna = stack.enter_context(campus.labs["south"].session("anna"))
        assert call(anna, "north", Trigger) == []

        def right(name, since):
            """Whether all poses that were sent since then, half a second at least, are drawn."""
            sent = true[name][since:]
            if len(sent) < 50:
                return False
            worst = max(screens[name].off(each) for each in sent)
            assert worst < TENTH, (name, worst)
            return True

        for name in RATES:
            wait_for(lambda n=name: screens[n].clock and screens[n].clock.rate == RATES[n], name)
            since = len(true[name])
            wait_for(lambda n=name, s=since: right(n, s), f"the motion of {name}")
        campus.labs["north"].kill()
        wait_for(lambda: call(dean, "north", SetRate, rate=1.0) == [], "the router to be gone")
        arrived, since = len(screens["north"].joints), len(true["north"])
        seen = len(screens["south"].joints)
        wait_for(lambda: right("north", since), "the motion of north, unseen")
        assert len(screens["north"].joints) == arrived
        wait_for(lambda: len(screens["south"].joints) > seen, "the motion of south meanwhile")
        campus.labs["north"].start()
        wait_for(lambda: len(screens["north"].joints) > arrived, "the motion of north again")
        for name in RATES:
            since = len(true[name])
            wait_for(lambda n=name, s=since: right(n, s), f"the motion of {name} after that")
        assert call(dean, "north", SetRate, rate=1.0)[0].success
