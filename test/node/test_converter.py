"""The converter node: services and topics, with real files and a real reading process."""

import json
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
import rclpy
import scipy.io
from fakes import make_trajectory
from graph import wait_for
from kept import Kept
from mrlab_msgs.msg import Trajectory, TrajectoryCatalogue
from mrlab_msgs.srv import ConvertTrajectory, GetTrajectory, ListTrajectories, Remove
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.messages import qos
from mrlab_ros.nodes.converter.catalogue import MOST_ANNOUNCED
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.ros.spinning import spin

DEADLINE = 60.0  # s; far above what any of this takes


class ConverterGraph:
    """A converter and a client in a context of their own, spun by an executor of either kind."""

    def __init__(self, executor_class, state_dir):
        self.context = Context()
        rclpy.init(context=self.context)
        override = Parameter("state_dir", value=str(state_dir))
        self.converter = ConverterNode(context=self.context, parameter_overrides=[override])
        self.client = Node("client", context=self.context)
        self.executor = executor_class(context=self.context)
        self.executor.add_node(self.converter)
        self.executor.add_node(self.client)
        self.pool = ThreadPoolExecutor(1)
        self.stop = threading.Event()
        self.spinning = self.pool.submit(spin, self.executor, self.context, self.stop)

    def call(self, kind, service, /, **fields):
        return self.begin(kind, service, **fields)()

    def begin(self, kind, service, /, **fields):
        client = self.client.create_client(kind, f"/converter/{service}")
        assert client.wait_for_service(DEADLINE)
        future = client.call_async(kind.Request(**fields))

        def finish():
            wait_for(future.done, f"the answer of {service}", DEADLINE)
            return future.result()

        return finish

    def close(self):
        # rclpy's spin() now and then misses a shutdown() that comes as it begins to wait
        self.stop.set()
        self.spinning.result(DEADLINE)
        self.pool.shutdown()
        self.executor.shutdown()
        self.converter.destroy_node()
        self.client.destroy_node()
        rclpy.shutdown(context=self.context)


@pytest.fixture(params=[SingleThreadedExecutor, MultiThreadedExecutor])
def graph(request, tmp_path):
    graph = ConverterGraph(request.param, tmp_path / "state")
    yield graph
    graph.close()


def motion(rows=200, joints=6):
    u = np.linspace(0, 1, rows)[:, None]
    s = 10 * u**3 - 15 * u**4 + 6 * u**5
    return s * np.linspace(0.2, 0.9, joints) - 0.3


def save(folder, name="pick.mat", **variables):
    path = folder / name
    scipy.io.savemat(path, variables, do_compression=True)
    return path


def test_a_file_is_converted_announced_and_fetched(graph, tmp_path):
    catalogues, converted = [], []
    graph.client.create_subscription(
        TrajectoryCatalogue, "/trajectories", catalogues.append, qos.LATCHED
    )
    graph.client.create_subscription(
        Trajectory, "/trajectories/converted", converted.append, qos.EVENTS
    )
    wait_for(
        lambda: catalogues and graph.converter.count_subscribers("/trajectories/converted"),
        "the topics to be connected",
    )
    q = motion()
    path = save(tmp_path, q=q, fs=50.0)

    answer = graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")

    assert answer.success, answer.message
    assert answer.outcome == ConvertTrajectory.Response.ACCEPTED
    assert answer.trajectory.id == "pick"
    assert answer.trajectory.frame_rate == 50.0
    assert answer.trajectory.source_variable == "q"
    wait_for(lambda: converted and catalogues[-1].trajectories, "the announcement")
    assert [t.id for t in catalogues[-1].trajectories] == ["pick"]
    published = np.array(converted[0].positions).reshape(-1, 6)
    np.testing.assert_array_equal(published, q)

    fetched = graph.call(GetTrajectory, "get", id="pick")
    assert fetched.success
    stored = np.array(fetched.trajectory.positions).reshape(-1, 6)
    np.testing.assert_array_equal(stored, q)


def test_a_long_trajectory_is_announced_without_its_frames(graph, tmp_path):
    converted = []
    graph.client.create_subscription(
        Trajectory, "/trajectories/converted", converted.append, qos.EVENTS
    )
    wait_for(
        lambda: graph.converter.count_subscribers("/trajectories/converted"),
        "the topic to be connected",
    )
    rows = MOST_ANNOUNCED + 1
    q = motion(rows)
    path = save(tmp_path, q=q, fs=100.0)

    answer = graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")

    assert answer.success, answer.message
    wait_for(lambda: converted, "the announcement")
    assert converted[0].info.frame_count == rows
    assert len(converted[0].joint_names) == 6
    assert not converted[0].positions
    part = graph.call(GetTrajectory, "get", id="pick", begin=rows - 2, count=2)
    np.testing.assert_array_equal(np.array(part.trajectory.positions).reshape(-1, 6), q[-2:])


def test_the_limit_on_rows_is_a_parameter(graph, tmp_path):
    graph.converter.set_parameters([Parameter("row_limit", value=100)])
    path = save(tmp_path, q=motion(101), fs=100.0)
    answer = graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")
    assert not answer.success
    assert answer.code == "too_many_rows"


def test_bytes_with_a_gripper_are_converted_under_the_name_asked_for(graph, tmp_path):
    q = np.column_stack([motion(), np.arange(200) > 120])
    data = save(tmp_path, q=q).read_bytes()
    answer = graph.call(
        ConvertTrajectory,
        "convert",
        data=data,
        file_name="up load.mat",
        robot_model="ur5e",
        end_effector="parallel_gripper",
        id="mine",
    )
    assert answer.success, answer.message
    assert answer.trajectory.has_gripper
    gripper = graph.call(GetTrajectory, "get", id="mine").trajectory.gripper
    np.testing.assert_array_equal(np.array(gripper, bool), np.arange(200) > 120)
    listed = graph.call(ListTrajectories, "list", robot_model="ur5e")
    assert not listed.trajectories, "it needs a gripper that is not fitted"
    listed = graph.call(
        ListTrajectories, "list", robot_model="ur5e", end_effector="parallel_gripper"
    )
    assert [t.id for t in listed.trajectories] == ["mine"]


def test_one_file_for_two_robots_is_two_trajectories(graph, tmp_path):
    path = str(save(tmp_path, q=motion()))
    for model, name in (
        ("ur5e", "pick"),
        ("kuka_kr6_r900_sixx", "pick_kuka_kr6_r900_sixx"),
        ("kuka_kr6_r900_sixx", "pick_kuka_kr6_r900_sixx"),
        ("ur5e", "pick"),
    ):
        answer = graph.call(ConvertTrajectory, "convert", path=path, robot_model=model)
        assert answer.trajectory.id == name, answer.message
    listed = graph.call(ListTrajectories, "list").trajectories
    assert [(t.id, t.robot_model, t.version) for t in listed] == [
        ("pick", "ur5e", 2),
        ("pick_kuka_kr6_r900_sixx", "kuka_kr6_r900_sixx", 2),
    ]


def test_a_doubtful_file_offers_candidates_and_changes_nothing(graph, tmp_path):
    path = save(tmp_path, q1=motion(), q2=motion() / 2)
    answer = graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")
    assert not answer.success
    assert answer.outcome == ConvertTrajectory.Response.AMBIGUOUS
    assert sorted(c.variable for c in answer.candidates) == ["q1", "q2"]
    assert answer.diagnostics[0].code == "ambiguous"
    assert not graph.call(ListTrajectories, "list").trajectories

    chosen = graph.call(
        ConvertTrajectory, "convert", path=str(path), robot_model="ur5e", variable="q2"
    )
    assert chosen.success
    assert chosen.trajectory.source_variable == "q2"


def test_wrong_requests_get_a_sentence(graph, tmp_path):
    missing = graph.call(
        ConvertTrajectory, "convert", path=str(tmp_path / "no.mat"), robot_model="ur5e"
    )
    assert (missing.outcome, missing.diagnostics[0].code) == (0, "missing")
    unknown = graph.call(ConvertTrajectory, "convert", path="x.mat", robot_model="r2d2")
    assert not unknown.success
    assert "r2d2" in unknown.message
    assert "ur5e" in unknown.message
    named = graph.call(
        ConvertTrajectory, "convert", path="x.mat", robot_model="ur5e", id="../evil"
    )
    assert not named.success
    assert named.code == "bad_trajectory_name"
    assert not graph.call(GetTrajectory, "get", id="../../etc/passwd").success
    assert not graph.call(Remove, "delete", name="nothing").success


def test_a_trajectory_is_replaced_and_deleted_and_survives_a_restart(tmp_path):
    path = save(tmp_path, q=motion())
    for rows in (200, 300):
        path = save(tmp_path, q=motion(rows))
        graph = ConverterGraph(SingleThreadedExecutor, tmp_path / "state")
        answer = graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")
        assert answer.success, answer.message
        graph.close()
    graph = ConverterGraph(SingleThreadedExecutor, tmp_path / "state")
    (info,) = graph.call(ListTrajectories, "list").trajectories
    assert (info.id, info.frame_count, info.source_file) == ("pick", 300, "pick.mat")
    assert graph.call(Remove, "delete", name="pick").success
    assert not graph.call(ListTrajectories, "list").trajectories
    assert not graph.call(GetTrajectory, "get", id="pick").success
    graph.close()


def test_the_executor_goes_on_while_a_file_is_converted(graph, tmp_path, monkeypatch):
    entered, finish = [], []
    convert = WorkspaceReader.convert

    def held(*arguments):
        entered.append(arguments)
        wait_for(lambda: finish, "leave to go on", DEADLINE)
        return convert(*arguments)

    monkeypatch.setattr(WorkspaceReader, "convert", held)
    ticks = []
    graph.client.create_timer(0.001, lambda: ticks.append(1))
    path = save(tmp_path, q=motion())
    answer = graph.begin(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e")
    wait_for(lambda: entered, "the conversion to begin")
    seen = len(ticks)
    wait_for(lambda: len(ticks) > seen + 20, "the timer to go on")
    finish.append(1)
    assert answer().success


def test_frames_are_sent_in_parts_or_named_as_a_file(graph, tmp_path):
    q = np.column_stack([motion(), np.arange(200) > 120])
    path = save(tmp_path, q=q)
    answer = graph.call(
        ConvertTrajectory, "convert", path=str(path), robot_model="ur5e",
        end_effector="parallel_gripper",
    )  # fmt: skip
    assert answer.success, answer.message
    named = graph.call(GetTrajectory, "get", id="pick", file_only=True)
    assert named.trajectory.info == answer.trajectory
    assert not named.trajectory.positions
    np.testing.assert_array_equal(np.load(named.file)["positions"], q[:, :6])
    for begin, count, end in ((0, 50, 50), (190, 50, 200), (120, 0, 200), (199, 1, 200)):
        part = graph.call(GetTrajectory, "get", id="pick", begin=begin, count=count)
        assert part.success, part.message
        assert part.trajectory.info == answer.trajectory
        matrix = np.array(part.trajectory.positions).reshape(-1, 6)
        np.testing.assert_array_equal(matrix, q[begin:end, :6])
        assert list(part.trajectory.gripper) == list(q[begin:end, 6])
    beyond = graph.call(GetTrajectory, "get", id="pick", begin=200)
    assert (beyond.success, beyond.code) == (False, "no_such_frame")
    assert {v.key: v.value for v in beyond.values} == {"id": "pick", "frame": "200", "last": "199"}


def test_a_damaged_file_is_taken_out_of_the_catalogue_and_named(graph, tmp_path):
    catalogues = []
    graph.client.create_subscription(
        TrajectoryCatalogue, "/trajectories", catalogues.append, qos.LATCHED
    )
    for name in ("good.mat", "bad.mat"):
        path = save(tmp_path, name, q=motion())
        assert graph.call(ConvertTrajectory, "convert", path=str(path), robot_model="ur5e").success
    stored = Path(graph.call(GetTrajectory, "get", id="bad", file_only=True).file)
    content = bytearray(stored.read_bytes())
    content[5000] ^= 1
    stored.write_bytes(content)
    answer = graph.call(GetTrajectory, "get", id="bad")
    assert not answer.success
    assert answer.code == "damaged_version"
    values = {v.key: v.value for v in answer.values}
    assert json.loads(values["why"])["values"]["file"] == stored.name
    (aside,) = (tmp_path / "state" / "store" / "damaged").rglob("*.npz")
    assert values["folder"] == str(aside)
    assert aside.read_bytes() == bytes(content)
    assert not stored.exists()
    wait_for(
        lambda: catalogues and [t.id for t in catalogues[-1].trajectories] == ["good"],
        "the catalogue without it",
    )
    assert graph.call(GetTrajectory, "get", id="good").success


def test_a_start_lists_a_thousand_entries(tmp_path):
    state = tmp_path / "state"
    kept = Kept.opened(state)
    names = [f"m{i:04}" for i in range(1000)]
    for name in names:
        kept.save(make_trajectory(trajectory_id=name))
    with closing(ConverterGraph(SingleThreadedExecutor, state)) as graph:
        listed = graph.call(ListTrajectories, "list").trajectories
        assert [t.id for t in listed] == names
        assert graph.call(GetTrajectory, "get", id="m0007").success
