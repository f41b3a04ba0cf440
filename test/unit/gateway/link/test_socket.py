from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Awaitable, Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest
from fake_lab import FakeLab
from gateway_side import Gateway
from kept import Kept
from link_side import Closed, LinkSide, error_of
from small_lab import make

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.connection import NoAnswer, Phase, Refused
from mrlab_ros.gateway.lab.diagnostics import NOBODY_ANSWERS
from mrlab_ros.gateway.link import sessions, socket
from mrlab_ros.gateway.link.frames import RecordKind
from mrlab_ros.gateway.link.limits import LinkLimits

pytestmark = pytest.mark.fast
TRIGGER = "mrlab_msgs/srv/Trigger"
JOINTS = "sensor_msgs/msg/JointState"


class Stage:
    """A gateway with a fake lab, and its clients."""

    def __init__(self, gateway: Gateway, lab: FakeLab) -> None:
        self.gateway = gateway
        self.lab = lab
        self.sides: list[LinkSide] = []

    def cookie(self, name: str = "", role: Role = Role.STUDENT) -> str:
        people = self.gateway.people
        now = people.clock()
        if name and all(account.name != name for account in people.accounts.all()):
            people.accounts.add(name, role)
        secret = people.sign_ins.begin(name or "local", role if name else Role.INSTRUCTOR, now)
        return f"{people.cookie}={secret}"

    def side(self, cookie: str | None = None, **options: Any) -> LinkSide:
        cookie = self.cookie() if cookie is None else cookie
        side = LinkSide(self.gateway.app, cookie, **options)
        self.sides.append(side)
        return side


def played(scene: Callable[[Stage], Awaitable[None]]) -> Callable[[Path], None]:
    """Return a test that plays a scene in an event loop."""

    def test(tmp_path: Path) -> None:
        async def play() -> None:
            lab = FakeLab()
            gateway = Gateway(tmp_path, lab=lab)
            stage = Stage(gateway, lab)
            try:
                await scene(stage)
            finally:
                for side in stage.sides:
                    side.leave()
                    side.thaw.set()
                await asyncio.gather(*(side.ended() for side in stage.sides))
                gateway.app.state.link.sessions.close()

        asyncio.run(play())

    return test


def trigger(lab: FakeLab, success: bool = True) -> bytes:
    return lab.definitions.encode(f"{TRIGGER}_Response", {"success": success})


def scene(
    function: Callable[[Stage], Coroutine[Any, Any, None]],
) -> Callable[[Path], None]:
    test = played(function)
    test.__name__ = function.__name__
    return test


def joints(lab: FakeLab, value: float) -> bytes:
    return lab.definitions.encode(JOINTS, {"name": ["a"], "position": [value]})


@scene
async def test_a_stream_is_paced_by_credit_and_only_its_newest_message_counts(
    stage: Stage,
) -> None:
    stage.lab.offer("ur5e_1/joint_states", JOINTS)
    side = stage.side()
    side.hello(_1="*/joint_states")
    await side.welcome()
    assert side.subprotocol == "mrlab.1"
    for value in range(5):
        stage.lab.publish("ur5e_1/joint_states", joints(stage.lab, value))
    await side.settle()
    assert not side.values
    side.grant(1)
    await side.until(lambda: side.values)
    assert side.payloads("ur5e_1/joint_states") == [joints(stage.lab, 4)]
    stage.lab.publish("ur5e_1/joint_states", joints(stage.lab, 5))
    await side.settle()
    assert side.batches == [1]
    side.grant(2)
    await side.until(lambda: len(side.values) == 2)


@scene
async def test_a_latched_topic_gives_its_newest_message_first(stage: Stage) -> None:
    stage.lab.offer("robots", "mrlab_msgs/msg/Robots", latched=True)
    stage.lab.publish("robots", {"robots": [{"name": "a"}]})
    for number in range(2):
        side = stage.side()
        side.hello(_1="robots")
        side.grant(1)
        await side.until(lambda side=side: side.values)
        (payload,) = side.payloads("robots")
        read = stage.lab.definitions.decode("mrlab_msgs/msg/Robots", payload)
        assert [robot.name for robot in read.robots] == ["a"], number


@scene
async def test_a_late_client_gets_every_message_of_a_latched_history(stage: Stage) -> None:
    stage.lab.offer("tf_static", "tf2_msgs/msg/TFMessage", latched=True)
    first = stage.side()
    first.hello(_1="tf_static")
    await first.welcome()
    for name in ("a", "b"):
        stage.lab.publish("tf_static", {"transforms": [{"child_frame_id": name}]})
    await first.until(lambda: len(first.records) == 2)
    second = stage.side()
    second.hello(_1="tf_static")
    await second.until(lambda: len(second.records) == 2)
    assert second.records == first.records


@scene
async def test_a_message_too_large_for_a_batch_comes_in_pieces(stage: Stage) -> None:
    stage.lab.offer("ur5e_1/robot_description", "std_msgs/msg/String", latched=True)
    text = "x" * 50_000
    stage.lab.publish("ur5e_1/robot_description", {"data": text})
    side = stage.side()
    side.hello(_1="*/robot_description")

    def whole() -> bool:
        side.acknowledge()
        return bool(side.records)

    await side.until(whole)
    kind, topic, payload = side.records[0]
    assert (kind, side.topics[topic]["key"]) == (RecordKind.VALUE, "ur5e_1/robot_description")
    assert stage.lab.definitions.decode("std_msgs/msg/String", payload).data == text


@scene
async def test_each_event_arrives_in_order_without_credit(stage: Stage) -> None:
    stage.lab.offer("objects/removed", "mrlab_msgs/msg/ObjectRemoved")
    side = stage.side()
    side.hello(_1="objects/removed")
    await side.welcome()
    for number in range(30):
        stage.lab.publish("objects/removed", {"name": f"cube_{number}"})
    await side.until(lambda: len(side.records) == 30)
    names = [
        stage.lab.definitions.decode("mrlab_msgs/msg/ObjectRemoved", payload).name
        for _, _, payload in side.records
    ]
    assert names == [f"cube_{number}" for number in range(30)]


@scene
async def test_what_was_not_acknowledged_comes_again_after_a_reconnect(stage: Stage) -> None:
    stage.lab.offer("objects/removed", "mrlab_msgs/msg/ObjectRemoved")
    cookie = stage.cookie()
    first = stage.side(cookie)
    first.hello(_1="objects/removed")
    token = (await first.welcome())["token"]
    stage.lab.publish("objects/removed", {"name": "a"})
    await first.until(lambda: first.records)
    first.leave()
    await first.ended()
    stage.lab.publish("objects/removed", {"name": "b"})

    second = stage.side(cookie)
    second.received = 1
    second.hello(token, received=1, _1="objects/removed")
    assert (await second.welcome())["resumed"]
    await second.until(lambda: second.records)
    assert len(second.records) == 1
    assert b"b\0" in second.records[0][2]


@scene
async def test_a_late_close_of_an_old_socket_leaves_the_new_one(stage: Stage) -> None:
    cookie = stage.cookie()
    first = stage.side(cookie)
    first.hello()
    token = (await first.welcome())["token"]
    second = stage.side(cookie)
    second.hello(token)
    assert (await second.welcome())["resumed"]
    first.leave()
    await first.ended()
    second.text(op="ping", asked=1.5)
    pong = await second.until(lambda: second.of("pong"))
    assert pong[0]["asked"] == 1.5


@scene
async def test_a_token_of_somebody_else_resumes_nothing(stage: Stage) -> None:
    first = stage.side(stage.cookie("anna"))
    first.hello()
    token = (await first.welcome())["token"]
    second = stage.side(stage.cookie("ben"))
    second.hello(token)
    assert not (await second.welcome())["resumed"]


@scene
async def test_a_service_answers_by_request_and_is_called_once(stage: Stage) -> None:
    stage.lab.serve("ur5e_1/play", TRIGGER, lambda request: {"success": True})
    side = stage.side()
    side.hello()
    side.call("ur5e_1/play", 7)
    side.call("ur5e_1/play", 7)
    side.call("ur5e_1/play", 8)
    await side.until(lambda: len(side.records) == 2)
    assert [(kind, about) for kind, about, _ in side.records] == [
        (RecordKind.RESPONSE, 7),
        (RecordKind.RESPONSE, 8),
    ]
    assert side.records[0][2] == trigger(stage.lab)
    assert len(stage.lab.calls) == 2


@scene
async def test_what_waited_while_the_gateway_was_frozen_is_refused_but_a_pause(
    stage: Stage,
) -> None:
    for name in ("play", "pause"):
        stage.lab.serve(f"ur5e_1/{name}", TRIGGER, lambda request: {"success": True})
    side = stage.side()
    side.hello()
    await side.welcome()
    freezes = stage.gateway.app.state.link.freezes
    freezes.look(time.monotonic() - 30.0)
    side.call("ur5e_1/play", 1)
    side.call("ur5e_1/pause", 2)
    await side.until(lambda: len(side.records) == 2)
    by_request = {about: (kind, about, data) for kind, about, data in side.records}
    error = error_of(by_request[1])
    assert error["code"] == "refused"
    assert by_request[2][0] == RecordKind.RESPONSE
    assert [key for key, *_ in stage.lab.calls] == ["ur5e_1/pause"]


@scene
async def test_a_pause_passes_where_all_other_calls_are_one_too_many(stage: Stage) -> None:
    for name in ("play", "pause"):
        stage.lab.serve(f"ur5e_1/{name}", TRIGGER, lambda request: {"success": True})
    stage.lab.hold("ur5e_1/play")
    limits = LinkLimits(calls_waiting=1, call_rate=0.1, call_burst=1.0)
    stage.gateway.app.state.link.limits = limits
    side = stage.side()
    side.hello()
    side.call("ur5e_1/play", 1)
    side.call("ur5e_1/play", 2)
    side.call("ur5e_1/pause", 3)
    await side.until(lambda: len(side.records) == 2)
    by_request = {about: kind for kind, about, _ in side.records}
    assert by_request == {2: RecordKind.ERROR, 3: RecordKind.RESPONSE}


@scene
async def test_a_pattern_is_no_service(stage: Stage) -> None:
    stage.lab.serve("ur5e_1/play", TRIGGER, lambda request: {"success": True})
    side = stage.side()
    side.hello()
    keys = ["**?/play", "*/play", "ur5e_1/play?x=1", "**/play", "ur5e_$*/play", "ur5e_1/play#"]
    for request, key in enumerate(keys, 1):
        side.call(key, request)
    await side.until(lambda: len(side.records) == len(keys))
    codes = {error_of(each)["diagnostic"]["code"] for each in side.records}
    assert codes == {"may_not_call"}
    assert not stage.lab.calls


@scene
async def test_all_pages_of_a_person_share_what_may_wait(stage: Stage) -> None:
    size = 4 * 1024
    stage.gateway.app.state.link.sessions._limits = LinkLimits(person_queue=3 * size)
    stage.lab.offer("tf_static", "tf2_msgs/msg/TFMessage", latched=True)
    cookie = stage.cookie("anna")
    pages, other = [stage.side(cookie) for _ in range(5)], stage.side(stage.cookie("ben"))
    for side in (*pages, other):
        side.hello(_1="tf_static")
        await side.welcome()
    stage.lab.publish("tf_static", {"transforms": [{"child_frame_id": "x" * size}]})
    await other.until(lambda: other.records)
    ends = await asyncio.gather(
        *(side.until(lambda side=side: side.records) for side in pages), return_exceptions=True
    )
    closed = [each.args[0] for each in ends if isinstance(each, Closed)]
    assert 0 < len(closed) < len(pages)
    assert set(closed) == {socket.BEHIND}


@scene
async def test_a_page_that_asks_and_does_not_read_is_closed(stage: Stage) -> None:
    side = stage.side()
    side.hello()
    await side.welcome()
    side.frozen = True
    for number in range(3000):
        side.text(op="ping", asked=number)
    await became(lambda: not side._in.qsize() or side._task.done())
    side.thaw.set()
    with pytest.raises(Closed, match=str(socket.BEHIND)):
        await side.until(lambda: False)


@scene
async def test_a_person_who_sends_too_much_is_slowed_down(stage: Stage) -> None:
    limits = LinkLimits(person_pages=1, frame_rate=1000, frame_burst=10)
    stage.gateway.app.state.link.sessions._limits = limits
    cookie = stage.cookie("anna")
    pages = [stage.side(cookie) for _ in range(3)]
    began = time.monotonic()
    for side in pages:
        side.hello()
        for number in range(40):
            side.text(op="ping", asked=number)
    for side in pages:
        await side.until(lambda side=side: len(side.of("pong")) == 40)
    # 120 frames of which 10 came at once: the rest comes at the rate of one page.
    assert time.monotonic() - began > 0.08


@scene
async def test_an_answer_waits_for_the_next_socket(stage: Stage) -> None:
    stage.lab.serve("ur5e_1/play", TRIGGER, lambda request: {"success": True})
    release = stage.lab.hold("ur5e_1/play")
    cookie = stage.cookie()
    first = stage.side(cookie)
    first.hello()
    token = (await first.welcome())["token"]
    first.call("ur5e_1/play", 1)
    while not stage.lab.calls:
        await asyncio.sleep(0)
    first.leave()
    await first.ended()
    release()
    second = stage.side(cookie)
    second.hello(token)
    second.call("ur5e_1/play", 1)
    await second.until(lambda: second.records)
    assert second.records[0][:2] == (RecordKind.RESPONSE, 1)
    assert len(stage.lab.calls) == 1


@scene
async def test_errors_of_services_say_what_they_are(stage: Stage) -> None:
    def refuse(request: object) -> dict[str, Any]:
        raise Refused("not now")

    def nobody(request: object) -> dict[str, Any]:
        raise NoAnswer(NOBODY_ANSWERS(key="b/play"))

    stage.lab.serve("a/play", TRIGGER, refuse)
    stage.lab.serve("b/play", TRIGGER, nobody)
    stage.lab.serve("c/play", TRIGGER, lambda request: {"success": True})
    stage.lab.hold("c/play")
    side = stage.side()
    side.hello()
    side.call("a/play", 1)
    side.call("b/play", 2)
    side.call("c/play", 3, timeout=0.01)
    side.call("ur5e_1/command_members", 4)
    await side.until(lambda: len(side.records) == 4)
    errors = {about: error_of((kind, about, data)) for kind, about, data in side.records}
    assert {
        about: (each["code"], each["diagnostic"]["code"]) for about, each in errors.items()
    } == {
        1: ("refused", ""),
        2: ("no_service", "nobody_answers"),
        3: ("timeout", "call_timed_out"),
        4: ("not_allowed", "may_not_call"),
    }


@scene
async def test_a_role_that_may_not_call_is_refused_and_the_lab_not_asked(stage: Stage) -> None:
    stage.lab.serve("ur5e_1/play", TRIGGER, lambda request: {"success": True})
    side = stage.side(stage.cookie("wall", Role.DISPLAY))
    side.hello()
    side.call("ur5e_1/play", 1)
    await side.until(lambda: side.records)
    error = error_of(side.records[0])
    assert (error["code"], error["diagnostic"]["code"]) == ("not_allowed", "may_not_call")
    assert error["diagnostic"]["values"] == {"role": "display", "key": "ur5e_1/play"}
    assert not stage.lab.calls


@scene
async def test_all_other_pages_are_told_who_paused_what(stage: Stage) -> None:
    stage.lab.serve("ur5e_1/pause", TRIGGER, lambda request: {"success": True})
    stage.lab.serve("ur5e_2/pause", TRIGGER, lambda request: {"success": False})
    eva, ben = (
        stage.side(stage.cookie(who, role))
        for who, role in (("eva", Role.INSTRUCTOR), ("ben", Role.STUDENT))
    )
    for side in (eva, ben):
        side.hello()
        await side.welcome()
    eva.call("ur5e_2/pause", 1)
    await eva.until(lambda: len(eva.records) == 1)
    eva.call("ur5e_1/pause", 2)
    await ben.until(lambda: ben.of("did"))
    assert ben.of("did") == [{"op": "did", "who": "eva", "service": "ur5e_1/pause"}]
    assert not eva.of("did")


@scene
async def test_only_what_comes_in_may_be_published(stage: Stage) -> None:
    side = stage.side()
    side.hello()
    side.put("latency/clients", b"\0\1\0\0")
    side.put("robots", b"\0\1\0\0")
    await side.until(lambda: side.of("refused"))
    assert stage.lab.sent == [("latency/clients", b"\0\1\0\0")]
    (told,) = side.of("refused")
    assert (told["key"], told["diagnostic"]["code"]) == ("robots", "may_not_publish")


@scene
async def test_people_say_where_they_are_by_their_own_names_and_see_all_others(
    stage: Stage,
) -> None:
    name = "mrlab_msgs/msg/Presence"
    encode, decode = stage.lab.definitions.encode, stage.lab.definitions.decode
    anna, ben = (
        stage.side(stage.cookie(who, role))
        for who, role in (("anna", Role.INSTRUCTOR), ("ben", Role.STUDENT))
    )
    anna.hello()
    ben.hello(_1="presence")
    await ben.welcome()
    await anna.welcome()
    anna.put("presence", encode(name, {"id": "quest", "name": "ben"}))
    await anna.until(lambda: stage.lab.sent)
    ben.put("presence", encode(name, {"id": "quest"}))
    await ben.until(lambda: ben.of("refused"))
    assert ben.of("refused")[0]["diagnostic"]["code"] == "display_taken"
    # Of several displays the newest message each counts, not the newest of all.
    (sent,) = stage.lab.sent
    stage.lab.offer("presence", name)
    for payload in (
        encode(name, {"id": "pico"}),
        encode(name, {"id": "pico", "part": 1}),
        sent[1],
    ):
        stage.lab.publish("presence", payload)
    ben.grant(1)
    await ben.until(lambda: len(ben.values) == 2)
    seen = [decode(name, payload) for payload in ben.payloads("presence")]
    assert [(each.id, each.name, each.part) for each in seen] == [
        ("pico", "", 1),
        ("quest", "anna", 2),
    ]
    anna.leave()
    await anna.ended()
    last = decode(name, stage.lab.sent[-1][1])
    assert (last.id, last.name, last.away) == ("quest", "anna", True)


@scene
async def test_an_instructor_alone_shows_where_to_look_by_the_name_of_the_sign_in(
    stage: Stage,
) -> None:
    name = "mrlab_msgs/msg/LookHere"
    encode, decode = stage.lab.definitions.encode, stage.lab.definitions.decode
    anna, ben = (
        stage.side(stage.cookie(who, role))
        for who, role in (("anna", Role.INSTRUCTOR), ("ben", Role.OPERATOR))
    )
    anna.hello()
    ben.hello(_1="look_here")
    await ben.welcome()
    await anna.welcome()
    ben.put("look_here", encode(name, {}))
    await ben.until(lambda: ben.of("refused"))
    anna.put("look_here", encode(name, {"name": "ben", "point": {"x": 1.0, "y": 2.0, "z": 0.5}}))
    await anna.until(lambda: stage.lab.sent)
    ((key, sent),) = stage.lab.sent
    found = decode(name, sent)
    assert (key, found.name, found.point.y) == ("look_here", "anna", 2.0)
    stage.lab.publish("look_here", sent)
    ben.grant(1)
    await ben.until(lambda: ben.payloads("look_here"))
    anna.put("look_here", encode(name, {"point": {"x": float("nan")}}))
    await anna.ended()
    assert len(stage.lab.sent) == 1


@scene
async def test_only_topics_of_the_allow_list_are_given(stage: Stage) -> None:
    side = stage.side()
    side.hello(_1="rosout", _2="**", _3="robots")
    await side.until(lambda: len(side.of("refused")) == 2)
    assert {text["key"] for text in side.of("refused")} == {"rosout", "**"}


@scene
async def test_trajectories_of_others_are_not_seen(stage: Stage) -> None:
    name = "mrlab_msgs/msg/TrajectoryCatalogue"
    stage.lab.offer("trajectories", name, latched=True)
    infos = [
        {"id": "quintic"},
        {"id": "anna/own", "owner": "anna"},
        {"id": "ben/own", "owner": "ben"},
        {"id": "ben/class", "owner": "ben", "shared": True},
    ]
    stage.lab.publish("trajectories", {"trajectories": infos})
    seen = {}
    for person, role in (("anna", Role.STUDENT), ("eva", Role.INSTRUCTOR)):
        side = stage.side(stage.cookie(person, role))
        side.hello(_1="trajectories")
        side.grant(1)
        await side.until(lambda side=side: side.values)
        found = stage.lab.definitions.decode(name, side.payloads("trajectories")[0])
        seen[person] = [info.id for info in found.trajectories]
    assert seen == {
        "anna": ["quintic", "anna/own", "ben/class"],
        "eva": ["quintic", "anna/own", "ben/own", "ben/class"],
    }


@scene
async def test_an_operator_loads_what_the_operator_sees(stage: Stage) -> None:
    kept = Kept.opened(stage.gateway.settings.state_dir)
    for owner in ("anna", "olga"):
        kept.save(make("ur5e", f"{owner}/secret"))
    load = "mrlab_msgs/srv/LoadTrajectory"
    stage.lab.serve("ur5e_1/load", load, lambda request: {"success": True, "message": request.id})
    side = stage.side(stage.cookie("olga", Role.OPERATOR))
    side.hello()
    definitions = stage.lab.definitions
    wanted = ["anna/secret", "anna/nothing", "olga/secret", ""]
    for request, name in enumerate(wanted, 1):
        payload = definitions.encode(f"{load}_Request", {"id": name})
        side.call("ur5e_1/load", request, payload)
    await side.until(lambda: len(side.records) == len(wanted))
    answers = {
        request: definitions.decode(f"{load}_Response", data) for _, request, data in side.records
    }
    assert [answers[n].code for n in (1, 2)] == ["no_trajectory_of_name"] * 2
    assert [answers[n].message for n in (3, 4)] == ["olga/secret", ""]
    assert "anna" not in answers[1].message.replace("anna/secret", "")


@scene
async def test_the_lab_that_goes_takes_its_keys_along(stage: Stage) -> None:
    stage.lab.offer("robots", "mrlab_msgs/msg/Robots", latched=True)
    side = stage.side()
    side.hello()
    await side.until(lambda: side.of("lab"))
    assert side.of("lab")[-1]["topics"] == {"robots": "mrlab_msgs/msg/Robots"}
    stage.lab.set_phase(Phase.LOST)
    await side.until(lambda: side.of("lab")[-1]["phase"] == "lost")
    assert side.of("lab")[-1]["topics"] == {}


@scene
async def test_another_lab_at_the_same_address_takes_the_place_of_the_first(
    stage: Stage,
) -> None:
    kind, read = "mrlab_msgs/msg/Robots", stage.lab.definitions.decode
    stage.lab.offer("robots", kind, latched=True)
    for _ in range(5):
        stage.lab.publish("robots", {"lab": "first", "robots": [{"name": "a"}]})
    side = stage.side()
    side.hello(_1="robots")
    side.grant(9)
    await side.until(lambda: side.values)
    stage.lab.set_phase(Phase.LOST)
    await side.until(lambda: side.of("lab")[-1]["phase"] == "lost")
    # The bridge of the second counts its messages from the beginning.
    stage.lab._sequence.clear()
    stage.lab.set_phase(Phase.OPEN)
    stage.lab.offer("robots", kind, latched=True)
    stage.lab.publish("robots", {"lab": "second"})
    await side.until(lambda: read(kind, side.payloads("robots")[-1]).lab == "second")
    late = stage.side()
    late.hello(_1="robots")
    late.grant(1)
    await late.until(lambda: late.values)
    assert [read(kind, said).lab for said in late.payloads("robots")] == ["second"]


@scene
async def test_a_client_that_does_not_read_costs_no_memory(stage: Stage) -> None:
    stage.lab.offer("objects/removed", "mrlab_msgs/msg/ObjectRemoved")
    stage.lab.offer("ur5e_1/joint_states", JOINTS)
    side = stage.side()
    side.hello(_1="objects/removed", _2="*/joint_states")
    await side.welcome()
    side.frozen = True
    (client,) = stage.gateway.app.state.link.sessions._clients.values()
    motion = joints(stage.lab, 1.0)
    event = stage.lab.definitions.encode("mrlab_msgs/msg/ObjectRemoved", {"name": "x" * 3000})
    for _ in range(3000):
        stage.lab.publish("ur5e_1/joint_states", motion)
        stage.lab.publish("objects/removed", event)
    assert client.session.size < 9_000_000
    assert client.session.failed.code == "too_much_waits"
    side.frozen = False
    side.thaw.set()
    with pytest.raises(Closed, match="4409"):
        await side.until(lambda: False)


@scene
async def test_a_silent_client_is_closed(stage: Stage) -> None:
    before, socket.SILENCE_S = socket.SILENCE_S, 0.05
    try:
        side = stage.side()
        side.hello()
        with pytest.raises(Closed, match="4408"):
            await side.until(lambda: False)
    finally:
        socket.SILENCE_S = before


@scene
async def test_another_version_is_named(stage: Stage) -> None:
    side = stage.side(protocols=("mrlab.2",))
    with pytest.raises(Closed, match="4001"):
        await side.until(lambda: False)
    assert side.subprotocol == "mrlab.2"
    (told,) = side.of("closing")
    assert (told["code"], told["diagnostic"]["code"]) == (4001, "other_protocol")
    assert told["diagnostic"]["values"] == {"ours": "mrlab.1", "theirs": "mrlab.2"}


@scene
async def test_nobody_who_is_not_signed_in_gets_a_socket(stage: Stage) -> None:
    side = stage.side("")
    with pytest.raises(Closed, match="4003"):
        await side.until(lambda: False)
    assert side.of("closing")[0]["diagnostic"]["code"] == "not_signed_in"


@scene
async def test_a_foreign_origin_is_refused_at_the_door(stage: Stage) -> None:
    side = stage.side(origin="https://evil.example")
    with pytest.raises(Closed, match="1008"):
        await side.until(lambda: False)


@scene
async def test_a_revoked_sign_in_ends_the_socket_and_the_session(stage: Stage) -> None:
    side = stage.side(stage.cookie("anna"))
    side.hello()
    await side.welcome()
    people = stage.gateway.people
    (row,) = people.sign_ins.all(people.clock(), "anna")
    people.sign_ins.end(row.id)
    await people.sign_ins.check(people.clock())
    with pytest.raises(Closed, match="4003"):
        await side.until(lambda: False)
    assert side.of("closing")[0]["diagnostic"]["code"] == "sign_in_ended"
    assert not stage.gateway.app.state.link.sessions._clients


@scene
async def test_a_flood_is_closed(stage: Stage) -> None:
    stage.gateway.app.state.link.limits = LinkLimits(frame_rate=1.0, frame_burst=20.0)
    side = stage.side()
    side.hello()
    for _ in range(100):
        side.grant(1)
    with pytest.raises(Closed, match="4029"):
        await side.until(lambda: False)


@scene
async def test_the_first_client_of_a_gateway_gets_every_message_of_a_latched_history(
    stage: Stage,
) -> None:
    stage.lab.offer("tf_static", "tf2_msgs/msg/TFMessage", latched=True, history=100)
    for name in ("base_1", "base_2", "base_3"):
        stage.lab.publish("tf_static", {"transforms": [{"child_frame_id": name}]})
    side = stage.side()
    side.hello(_1="tf_static")
    await side.until(lambda: len(side.records) == 3)


@pytest.fixture(autouse=True)
def no_delay(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(socket, "FULL_S", 0.0)


@scene
async def test_an_instructor_comes_in_where_others_took_all_places(stage: Stage) -> None:
    stage.gateway.app.state.link.sessions._limits = LinkLimits(pages=1)
    first = stage.side(stage.cookie("anna"))
    first.hello()
    await first.welcome()
    second = stage.side(stage.cookie("ben"))
    second.hello()
    with pytest.raises(Closed, match="4029"):
        await second.until(lambda: False)
    teacher = stage.side(stage.cookie("teacher", Role.INSTRUCTOR))
    teacher.hello()
    await teacher.welcome()


@pytest.mark.parametrize(
    "frame", [b"", b"\x09" * 8, b"\x03", b"\x01\0\xff\xff" + bytes(8), b"\x01\0\1\0" + bytes(6)]
)
def test_a_broken_frame_is_named(tmp_path: Path, frame: bytes) -> None:
    async def broken(stage: Stage) -> None:
        side = stage.side()
        side.hello()
        side.bytes(frame)
        with pytest.raises(Closed, match="4400"):
            await side.until(lambda: False)

    played(broken)(tmp_path)


MOVE = "mrlab_msgs/srv/MoveObject"


async def became(condition: Callable[[], Any]) -> None:
    """Return once a condition of the gateway holds, of which no frame tells."""
    deadline = asyncio.get_running_loop().time() + 5
    while not condition():
        assert asyncio.get_running_loop().time() < deadline
        await asyncio.sleep(0.001)


def carried(lab: FakeLab, name: str, held: bool = True) -> bytes:
    pose = {"position": {"z": 0.5}, "orientation": {"w": 1.0}}
    return lab.definitions.encode(f"{MOVE}_Request", {"name": name, "pose": pose, "held": held})


@scene
async def test_who_goes_lets_go_what_was_in_the_hand_and_nothing_else(stage: Stage) -> None:
    before, sessions.LET_GO_S = sessions.LET_GO_S, 0.02
    lab = stage.lab
    lab.serve("physics/move_object", MOVE, lambda request: {"success": request.name != "table"})
    try:
        first, second = stage.side(), stage.side(stage.cookie("ada", Role.INSTRUCTOR))
        for side in (first, second):
            side.hello()
            await side.welcome()
        for number, name in enumerate(("cube", "rod", "ball", "table")):
            first.call("physics/move_object", number + 1, carried(lab, name))
        await first.until(lambda: len(first.records) == 4)
        first.call("physics/move_object", 5, carried(lab, "ball", held=False))
        await first.until(lambda: len(first.records) == 5)
        for name, height in (("cube", 0.7), ("ball", 0.7), ("cube", math.nan)):
            where = {"position": {"z": height}, "orientation": {"w": 1.0}}
            fields = {"hand": "h", "sequence": 1, "object": name, "pose": where}
            first.put("moves", lab.definitions.encode("mrlab_msgs/msg/Move", fields))
        second.call("physics/move_object", 1, carried(lab, "rod"))
        await second.until(lambda: second.records)
        asked = len(lab.calls)
        first.leave()
        await became(lambda: len(lab.calls) > asked)
        assert [request.name for _, request in lab.calls[asked:]] == ["cube"]
        last = lab.calls[-1][1]
        assert (last.name, last.held, last.pose.position.z) == ("cube", False, 0.7)
        # The lab gets what is in a hand of this page, and no place that is none.
        assert [key for key, _ in lab.sent if key == "moves"] == ["moves"]
    finally:
        sessions.LET_GO_S = before


@scene
async def test_the_last_page_is_forgotten_and_its_hands_let_go_once_the_lab_answers(
    stage: Stage,
) -> None:
    before = sessions.LET_GO_S, sessions.RESUME_S
    sessions.LET_GO_S, sessions.RESUME_S = 0.02, 0.2
    lab, known = stage.lab, stage.gateway.app.state.link.sessions
    away: list[str] = []

    def move(request: Any) -> dict[str, bool]:
        if not request.held and len(away) < 2:
            away.append(request.name)
            raise NoAnswer(NOBODY_ANSWERS(key="physics/move_object"))
        return {"success": True}

    lab.serve("physics/move_object", MOVE, move)
    try:
        side = stage.side()
        side.hello()
        await side.welcome()
        side.call("physics/move_object", 1, carried(lab, "cube"))
        await side.until(lambda: side.records)
        (token,) = known._clients
        side.leave()
        await became(lambda: len(away) == 2 and not known.hands.held_by(token))
        assert token in known._clients
        await became(lambda: not known._clients)
    finally:
        sessions.LET_GO_S, sessions.RESUME_S = before


@scene
async def test_who_comes_back_at_once_drops_nothing(stage: Stage) -> None:
    before, sessions.LET_GO_S = sessions.LET_GO_S, 0.05
    lab = stage.lab
    lab.serve("physics/move_object", MOVE, lambda request: {"success": True})
    try:
        cookie = stage.cookie()
        first = stage.side(cookie)
        first.hello()
        token = (await first.welcome())["token"]
        first.call("physics/move_object", 1, carried(lab, "cube"))
        await first.until(lambda: first.records)
        first.leave()
        await first.ended()
        second = stage.side(cookie)
        second.hello(token)
        assert (await second.welcome())["resumed"]
        waiting = stage.gateway.app.state.link.sessions._letting_go
        await became(lambda: not waiting)
        assert len(lab.calls) == 1
    finally:
        sessions.LET_GO_S = before
