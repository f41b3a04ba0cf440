"""The coordinator in a real graph with a lab, playbacks and a catalogue."""

from __future__ import annotations

import json
import threading
from types import SimpleNamespace

import pytest
import small_lab
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from small_lab import (
    labels,
    listen_state,
    listen_systems,
    load,
    make_system,
    spawn,
    state_of,
    value_of,
)

from mrlab_ros.messages import qos
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.ros import services


@pytest.fixture
def lab(graph: Graph):
    return small_lab.start(graph)


def test_a_system_stages_its_members_and_starts_them_at_one_stamp(graph, lab):
    ur, kuka = spawn(graph), spawn(graph, "kuka_kr6_r900_sixx")
    states = {robot: listen_state(graph, robot) for robot in (ur, kuka)}
    systems = graph.listen(msg.RobotSystems, "/systems", qos.EVENTS)
    answer = make_system(graph, {ur: "wave", kuka: "kuka"})
    assert answer.success, answer.message
    refused = graph.call(Trigger, f"/{ur}/play")
    assert not refused.success
    assert refused.code == "driven_by_system"
    answer = graph.call(Trigger, "/cell/play")
    assert answer.success, answer.message

    def ended() -> bool:
        # READY comes again where more than the state has changed
        order = [s.label for m in systems for s in m.systems]
        return "COMPLETE" in order and order[-1] == "READY"

    wait_for(ended, "the system's end")
    starts = {
        s.clock.stamp.sec * 10**9 + s.clock.stamp.nanosec
        for inbox in states.values()
        for s in inbox
        if s.label == "PLAYING"
    }
    assert len(starts) == 1
    for inbox in states.values():
        assert "COMPLETE" in labels(inbox)
    order = [s.label for m in systems for s in m.systems]
    assert [x for i, x in enumerate(order) if i == 0 or order[i - 1] != x] == [
        "READY", "STAGING", "PLAYING", "COMPLETE", "READY",
    ]  # fmt: skip


def test_a_system_pauses_plays_on_and_stops_as_one(graph, lab):
    a, b = spawn(graph), spawn(graph)
    states = {robot: listen_state(graph, robot) for robot in (a, b)}
    assert make_system(graph, {a: "long", b: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: all(s.last().frame > 5 for s in states.values()), "frames")
    assert graph.call(Trigger, "/cell/pause").success
    wait_for(lambda: {s.last().label for s in states.values()} == {"PAUSED"}, "the pause")
    frames = {s.last().frame for s in states.values()}
    assert max(frames) - min(frames) <= 1
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: {s.last().label for s in states.values()} == {"PLAYING"}, "playing on")
    assert graph.call(Trigger, "/cell/stop").success
    wait_for(lambda: {s.last().label for s in states.values()} == {"READY"}, "the stop")


def test_a_robot_is_in_one_system_and_free_after_it(graph, lab):
    a, b = spawn(graph), spawn(graph)
    assert make_system(graph, {a: "wave", b: "wave"}).success
    answer = make_system(graph, {a: "wave"}, "other")
    assert not answer.success
    assert answer.code == "member_of_system"
    assert graph.call(srv.Remove, "/lab/remove_robot", name=b).success
    wait_for(lambda: graph.call(Trigger, f"/{a}/play").success, "independence")


@pytest.mark.parametrize(
    ("members", "code"),
    [
        ({}, "no_members"),
        ({"ghost": "wave"}, "no_robot_in_scene"),
        ({"ur5e_1": "nothing"}, "no_trajectory_of_name"),
        ({"ur5e_1": "kuka"}, "of_another_model"),
    ],
)
def test_a_system_that_cannot_be_is_refused_and_leaves_nothing_behind(graph, lab, members, code):
    robot = spawn(graph)
    load(graph, robot, "wave")
    answer = make_system(graph, members)
    assert not answer.success
    assert answer.code == code
    assert graph.call(Trigger, f"/{robot}/play").success


def test_a_refused_system_changes_no_robot(graph, lab):
    a, b = spawn(graph), spawn(graph)
    load(graph, a, "long")
    assert graph.call(srv.Seek, f"/{a}/seek", position=2.0).success
    states = {robot: listen_state(graph, robot) for robot in (a, b)}
    seen = {robot: len(states[robot]) for robot in (a, b)}
    answer = make_system(graph, {a: "wave", b: "wave"}, waits={b: ["frame 99: after a.frame 1"]})
    assert not answer.success
    assert answer.code == "wait_beyond_end"
    answer = make_system(graph, {a: "wave", b: "nothing"})
    assert not answer.success
    assert graph.call(Trigger, f"/{a}/play").success
    wait_for(lambda: states[a].last() and states[a].last().label == "PLAYING", "the motion")
    assert states[a].last().trajectory_id == "long"
    assert not [s for s in states[a][seen[a] :] if s.system]
    answer = make_system(graph, {a: "wave"})
    assert not answer.success
    said = [answer.code, *(each.value for each in answer.values)]
    assert any("not_standing" in each for each in said)


def test_members_that_wait_for_each_other_are_refused_with_the_circle(graph, lab):
    a, b = spawn(graph), spawn(graph)
    waits = {a: [f"frame 10: after {b}.frame 20"], b: [f"frame 10: after {a}.frame 20"]}
    answer = make_system(graph, {a: "wave", b: "wave"}, waits=waits)
    assert not answer.success
    assert answer.code == "waiting_circle"
    steps = json.loads(value_of(answer, "steps"))
    assert {step["robot"] for step in steps} == {a, b}


def test_a_play_that_waits_when_its_system_is_dissolved_is_answered(graph, lab):
    a = spawn(graph)
    assert make_system(graph, {a: "wave"}).success
    clients = {
        service: graph.client.create_client(kind, service)
        for kind, service in (
            (Trigger, "/cell/play"),
            (srv.Remove, "/coordinator/dissolve_system"),
        )
    }
    assert all(client.wait_for_service(15.0) for client in clients.values())
    held, go_on = threading.Event(), threading.Event()
    # The worker is busy, so both requests wait.
    lab.coordinator.worker.send(lambda: (held.set(), go_on.wait(15.0)))
    assert held.wait(15.0)
    gone = clients["/coordinator/dissolve_system"].call_async(srv.Remove.Request(name="cell"))
    waiting = [clients["/cell/play"].call_async(Trigger.Request()) for _ in range(3)]
    go_on.set()
    wait_for(lambda: gone.done() and all(answer.done() for answer in waiting), "all answers")
    assert gone.result().success
    assert not any(answer.result().success for answer in waiting if not answer.result().message)


def test_what_waited_long_behind_a_busy_coordinator_moves_no_robot(graph, lab, monkeypatch):
    assert make_system(graph, {spawn(graph): "wave"}).success
    asked: list[float] = []
    late = threading.Event()

    def monotonic() -> float:
        asked.append(10.0 if late.is_set() else 0.0)
        return asked[-1]

    clients = [graph.client.create_client(Trigger, f"/cell/{name}") for name in ("play", "stop")]
    assert all(client.wait_for_service(15.0) for client in clients)
    monkeypatch.setattr(services, "time", SimpleNamespace(monotonic=monotonic))
    held = threading.Event()
    lab.coordinator.worker.send(lambda: (held.set(), late.wait(15.0)))
    assert held.wait(15.0)
    answers = [client.call_async(Trigger.Request()) for client in clients]
    wait_for(lambda: len(asked) == len(answers), "the requests to be taken")
    late.set()
    wait_for(lambda: all(answer.done() for answer in answers), "the answers")
    played, stopped = (answer.result() for answer in answers)
    assert not played.success
    assert (played.code, value_of(played, "waited")) == ("waited_too_long", "10.0")
    assert stopped.success, "a stop is carried out however late"
    monkeypatch.undo()
    assert graph.call(Trigger, "/cell/play").success


def test_a_sequential_system_shows_each_share_and_seeks_across_them(graph, lab):
    a, b = spawn(graph), spawn(graph)
    systems = listen_systems(graph)
    answer = make_system(graph, {a: "wave", b: "long"}, mode=msg.RobotSystem.SEQUENTIAL)
    assert answer.success, answer.message
    shares = [(m.start, m.duration) for m in answer.system.members]
    assert shares == [(0.0, 0.59), (0.59, 9.99)]
    assert graph.call(srv.Seek, "/cell/seek", position=5.59).success
    states = {
        robot: graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.LATCHED)
        for robot in (a, b)
    }
    wait_for(lambda: states[b] and states[b][-1].frame == 500, "b in the middle")
    wait_for(lambda: states[a] and states[a][-1].frame == 59, "a at its end")
    stepped = graph.call(srv.Step, "/cell/step", frames=-3)
    assert stepped.code == "at_position"
    assert float(value_of(stepped, "position")) == pytest.approx(5.56)
    assert graph.call(srv.SetRate, "/cell/set_rate", rate=4.0).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: state_of(systems).code == "played_to_end", "the end")


def test_settings_of_a_system_are_checked(graph, lab):
    a = spawn(graph)
    assert make_system(graph, {a: "wave"}).success
    answer = graph.call(srv.SetMode, "/cell/set_mode", mode=7)
    assert (answer.success, answer.code) == (False, "bad_mode")
    answer = graph.call(srv.SetRate, "/cell/set_rate", rate=9.0)
    assert (answer.success, answer.code) == (False, "bad_speed")
    answer = graph.call(srv.Seek, "/cell/seek", position=99.0)
    assert (answer.success, answer.code) == (False, "bad_position")
    assert graph.call(SetLoop, "/cell/set_loop", loop=True).success


def test_a_collision_of_one_member_halts_the_system_until_it_is_clear(graph, lab):
    a, b = spawn(graph), spawn(graph)
    systems = listen_systems(graph)
    states = {robot: listen_state(graph, robot) for robot in (a, b)}
    assert make_system(graph, {a: "long", b: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: all(s.last() and s.last().frame > 5 for s in states.values()), "frames")
    collision = graph.client.create_publisher(msg.Collision, f"/{a}/collision", qos.LATCHED)
    collision.publish(msg.Collision(colliding=True))
    wait_for(lambda: state_of(systems).label == "COLLISION_HALT", "the halt")
    wait_for(lambda: states[b].last().label == "PAUSED", "the other member's pause")
    assert not graph.call(Trigger, "/cell/play").success
    collision.publish(msg.Collision(colliding=False))
    wait_for(lambda: state_of(systems).label == "PAUSED", "the pause")
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: {s.last().label for s in states.values()} == {"PLAYING"}, "playing on")


def test_a_member_waits_for_what_another_holds(graph, lab):
    a, b = spawn(graph), spawn(graph)
    systems = listen_systems(graph)
    wait = f"frame 20: object cube_1 held by {a}"
    answer = make_system(graph, {a: "wave", b: "wave"}, waits={b: [wait]})
    assert answer.success, answer.message
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: systems and state_of(systems).members[1].waiting_for == wait, "the wait")
    grasp = graph.client.create_publisher(msg.Grasp, f"/{a}/grasp", qos.LATCHED)
    grasp.publish(msg.Grasp(state=msg.Grasp.HOLDING, object="cube_1"))
    wait_for(lambda: state_of(systems).code == "played_to_end", "the end")


def test_a_killed_playback_host_pauses_the_system_and_the_next_play_goes_on(graph, lab):
    a, b = spawn(graph), spawn(graph)
    systems = listen_systems(graph)
    assert make_system(graph, {a: "long", b: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: systems and state_of(systems).label == "PLAYING", "the start")
    graph.drop(lab.host)
    graph.add(PlaybackHostNode)
    wait_for(lambda: state_of(systems).code == "member_lost", "the loss")
    assert state_of(systems).label == "PAUSED"
    answer = graph.call(Trigger, "/cell/play")
    assert answer.success, answer.message
    wait_for(lambda: state_of(systems).label == "PLAYING", "a new run")
