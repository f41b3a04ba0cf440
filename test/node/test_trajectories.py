"""The converter with its store: uploads and drafts, owners, versions, undo, and what fails."""

import os
import signal
import subprocess
import time
from contextlib import closing

import numpy as np
import pytest
import scipy.io
from child_process import HOST, start_child
from graph import Graph, wait_for
from kept import Kept
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from own_domain import own_domain
from s3_server import BUCKET, s3_server
from small_lab import labels, listen_state, load, make, spawn

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.messages import qos
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

LONG = 60.0  # s; far above what any of this takes


def workspace(path, scale=1.0, rows=120):
    u = np.linspace(0, 1, rows)[:, None]
    q = scale * (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.1
    scipy.io.savemat(path, {"q": q, "fs": 100.0}, do_compression=True)
    return q


def put(store, folder, user="anna", name="pick.mat", scale=1.0):
    path = folder / "sent.mat"
    q = workspace(path, scale)
    key = keys.upload(user, keys.unique(), name)
    with path.open("rb") as file:
        store.put_file(key, file)
    return key, q


def convert(graph, **fields):
    return graph.call(
        srv.ConvertTrajectory, "/converter/convert", timeout=LONG, robot_model="ur5e", **fields
    )


def as_draft(graph, store, folder, user="anna", **fields):
    key, q = put(store, folder, user, **fields)
    draft = keys.draft(user, keys.unique())
    answer = convert(graph, upload=key, draft=draft, owner=user)
    assert answer.success, answer.message
    return draft, q


def publish(graph, **fields):
    return graph.call(srv.PublishTrajectory, "/converter/publish", **fields)


@pytest.fixture(params=["folder", "s3"])
def place(request, tmp_path):
    if request.param == "folder":
        yield str(tmp_path / "state" / "store")
        return
    with s3_server():
        yield f"s3://{BUCKET}/one"


@pytest.fixture
def store(place):
    return open_store(place)


@pytest.fixture
def node(graph: Graph, tmp_path, place):
    return graph.add(ConverterNode, state_dir=str(tmp_path / "state"), store=place)


@pytest.fixture
def lab(graph: Graph, tmp_path):
    graph.add(LabNode)
    graph.add(PlaybackHostNode)
    return graph.add(ConverterNode, state_dir=str(tmp_path / "state"))


def ids(graph, service="list_any"):
    listed = graph.call(srv.ListTrajectories, f"/converter/{service}").trajectories
    return [f"{t.id}@{t.version}" for t in listed]


def test_an_upload_becomes_a_draft_and_a_draft_a_trajectory(graph, node, store, tmp_path):
    catalogues = graph.listen(msg.TrajectoryCatalogue, "/trajectories", qos.LATCHED)
    wait_for(lambda: catalogues, "the catalogue", LONG)
    draft, q = as_draft(graph, store, tmp_path, name="Übung 1.mat")
    assert ids(graph) == []
    answer = publish(graph, draft=draft, owner="anna", id="wave")
    assert answer.success, answer.message
    info = answer.trajectory
    assert (info.id, info.owner, info.version, info.shared) == ("anna/wave", "anna", 1, False)
    assert info.source_file == "Übung 1.mat"
    assert publish(graph, draft=draft, owner="anna", id="wave").trajectory == info
    assert ids(graph) == ["anna/wave@1"]
    assert ids(graph, "list") == []
    hidden = graph.call(srv.GetTrajectory, "/converter/get", id="anna/wave")
    assert not hidden.success
    assert hidden.code == "no_trajectory_of_name"
    assert {v.key: v.value for v in hidden.values} == {"id": "anna/wave", "known": "[]"}
    got = graph.call(srv.GetTrajectory, "/converter/get_any", id="anna/wave@1")
    np.testing.assert_array_equal(np.array(got.trajectory.positions).reshape(-1, 6), q)
    assert got.trajectory.info == info
    assert os.path.isfile(got.file)
    assert graph.call(srv.ShareTrajectory, "/converter/share", id="anna/wave", shared=True).success
    wait_for(lambda: catalogues.last().trajectories, "the shared one", LONG)
    assert [t.id for t in catalogues.last().trajectories] == ["anna/wave"]
    assert graph.call(srv.GetTrajectory, "/converter/get", id="anna/wave").success


def test_versions_trash_and_undo(graph, node, store, tmp_path):
    for scale in (0.4, 0.6, 0.8):
        key, _ = put(store, tmp_path, scale=scale)
        assert convert(graph, upload=key, owner="anna", shared=True).trajectory.owner == "anna"
    assert ids(graph) == ["anna/pick@3"]
    restored = graph.call(srv.RestoreTrajectory, "/converter/restore", id="anna/pick", version=1)
    assert restored.trajectory.version == 4
    one, four = (
        graph.call(srv.GetTrajectory, "/converter/get", id=name).trajectory.positions
        for name in ("anna/pick@1", "anna/pick")
    )
    assert one == four
    assert graph.call(srv.Remove, "/converter/delete", name="anna/pick").success
    assert ids(graph) == []
    again = graph.call(srv.Remove, "/converter/delete", name="anna/pick")
    assert not again.success
    assert graph.call(srv.RestoreTrajectory, "/converter/restore", id="anna/pick").success
    assert ids(graph) == ["anna/pick@4"]


def test_whose_things_are_not_taken_for_anothers(graph, node, store, tmp_path):
    key, _ = put(store, tmp_path)
    draft, _ = as_draft(graph, store, tmp_path)
    for answer in (
        convert(graph, upload=key, owner="ben"),
        convert(graph, upload="trajectories/changes.json"),
        convert(graph, upload=key, draft="trajectories/changes.json"),
        convert(graph, upload=keys.upload("anna", keys.unique(), "gone.mat")),
        publish(graph, draft=draft, owner="ben", id="mine"),
        publish(graph, draft=draft, owner="anna", id="ben/mine"),
        publish(graph, draft=key, owner="anna"),
        publish(graph, draft=keys.draft("anna", keys.unique()), owner="anna", id="x"),
    ):
        assert not answer.success
        assert answer.message
    assert ids(graph) == []


def test_fifty_uploads_at_once_are_all_answered(graph, node, store, tmp_path):
    sent = [put(store, tmp_path, f"user{i}", scale=0.5 + i / 100) for i in range(50)]
    client = graph.client.create_client(
        srv.ConvertTrajectory, "/converter/convert", qos_profile=qos.SERVICES
    )
    assert client.wait_for_service(LONG)
    asked = [
        client.call_async(
            srv.ConvertTrajectory.Request(upload=key, owner=f"user{i}", robot_model="ur5e")
        )
        for i, (key, _) in enumerate(sent)
    ]
    wait_for(lambda: all(f.done() for f in asked), "fifty answers", 2 * LONG)
    assert all(f.result().success for f in asked), [f.result().message for f in asked]
    assert ids(graph) == sorted(f"user{i}/pick@1" for i in range(50))
    for i, (_, q) in enumerate(sent):
        name = f"user{i}/pick"
        got = graph.call(srv.GetTrajectory, "/converter/get_any", id=name).trajectory
        np.testing.assert_array_equal(np.array(got.positions).reshape(-1, 6), q)


def test_a_robot_that_plays_keeps_the_version_it_loaded(graph, lab):
    kept = Kept(lab.trajectories.catalogue, lab.trajectories.files)
    kept.save(make("ur5e", "wave", frames=3000))
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "wave")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: "PLAYING" in labels(states), "the motion", LONG)
    kept.save(make("ur5e", "wave", frames=90))
    kept.catalogue.delete("wave")
    count = len(states)
    wait_for(lambda: len(states) > count + 1, "further states", LONG)
    state = states.last()
    assert (state.label, state.frame_count) == ("PLAYING", 3000)
    assert (state.trajectory_id, state.trajectory_version) == ("wave", 1)
    kept.catalogue.restore("wave", 0)
    assert graph.call(Trigger, f"/{robot}/stop").success
    load(graph, robot, "wave@1")
    wait_for(lambda: states.last().label == "READY", "the older version", LONG)
    assert (states.last().frame_count, states.last().trajectory_version) == (3000, 1)
    load(graph, robot, "wave")
    wait_for(lambda: states.last().trajectory_version == 2, "the newer version", LONG)


# --- processes that are killed and stores that go away


def host(place, state, **environment):
    options = ["--ros-args", "-p", f"state_dir:={state}", "-p", f"store:={place}"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return start_child(*HOST, "converter", *options, env=os.environ | environment, **quiet)


def killed_in_the_middle(place, state, sent, answers):
    """Start a converter, have it convert, and kill it after some answers; return the good ones.

    In a domain of its own: DDS takes 20 s to notice that it is gone.
    """
    with (
        own_domain() as domain,
        closing(Graph(domain)) as graph,
        host(place, state, ROS_DOMAIN_ID=str(domain)) as process,
    ):
        wait_for(lambda: "converter" in graph.client.get_node_names(), "the node", LONG)
        client = graph.client.create_client(
            srv.ConvertTrajectory, "/converter/convert", qos_profile=qos.SERVICES
        )
        assert client.wait_for_service(LONG)
        requests = [
            srv.ConvertTrajectory.Request(upload=key, owner="anna", robot_model="ur5e")
            for key in sent
        ]
        asked = [client.call_async(request) for request in requests]
        wait_for(lambda: sum(f.done() for f in asked) >= answers, "some answers", LONG)
        process.send_signal(signal.SIGKILL)
        process.wait()
    return sum(f.done() and f.result().success for f in asked)


def test_a_converter_that_is_killed_loses_nothing_that_it_answered(tmp_path):
    state = tmp_path / "state"
    store = open_store(str(state / "store"))
    answered = 0
    for turn in range(3):
        sent = [put(store, tmp_path, scale=0.3 + i / 50)[0] for i in range(8)]
        answered += killed_in_the_middle(store.place, state, sent, turn + 1)
        kept = Kept.opened(state)
        record, _ = kept.catalogue.find("anna/pick")
        assert record.newest.number >= answered
        for version in record.versions:
            kept.load(f"anna/pick@{version.number}")


def test_a_store_that_is_away_is_said_and_comes_back(graph, tmp_path):
    with s3_server() as server:
        server.kill()
        node = graph.add(
            ConverterNode, state_dir=str(tmp_path / "state"), store=f"s3://{BUCKET}/one"
        )
        workspace(tmp_path / "pick.mat")
        refused = convert(graph, path=str(tmp_path / "pick.mat"))
        assert not refused.success
        assert "does not answer" in refused.message
        server.start()
        wait_for(
            lambda: graph.call(srv.ConvertTrajectory, "/converter/convert",
                               path=str(tmp_path / "pick.mat"), robot_model="ur5e").success,
            "the store", LONG,
        )  # fmt: skip
        assert ids(graph) == ["pick@1"]
        server.kill()
        began = time.monotonic()
        refused = convert(graph, path=str(tmp_path / "pick.mat"))
        assert not refused.success
        assert "nothing was changed" in refused.message
        assert time.monotonic() - began < LONG
        # what was read stays in memory, so listing and what was fetched go on
        assert ids(graph) == ["pick@1"]
        server.start()
        assert convert(graph, path=str(tmp_path / "pick.mat")).success
        assert node.trajectories.catalogue.find("pick")[1].number == 2
