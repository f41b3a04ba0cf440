"""MATLAB's objects are opened with their own time, labels and units."""

from pathlib import Path

import numpy as np
import pytest
from fakes import make_model
from found_matrices import matrix

from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.diagnostics import CATEGORIES, NUMBERS_DIFFER, TOO_MANY_PARTS
from mrlab_ros.adapters.workspaces.matlab import object_classes, objects
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, TooLarge
from mrlab_ros.adapters.workspaces.matlab.object_values import decoded_strings
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.adapters.workspaces.sinks import Digests, ObjectSink
from mrlab_ros.core.conversion.convert import convert
from mrlab_ros.core.conversion.options import Options

pytest.importorskip("matio", reason="mat-io needs Python 3.11")

import matlab_objects as matlab

LIMIT = 1 << 26
N = 40
TIMES = np.arange(N) / 50
Q = np.cumsum(np.random.default_rng(4).normal(size=(N, 6)), axis=0) * 0.01
VERSIONS = ["v7", "v7.3"]


class Collected(dict):
    """A sink: path -> the facts about it, `values` among them."""

    def add(self, found):
        self[found.path] = vars(found) | {"shape": tuple(found.shape), "values": matrix(found)}

    def values(self, path):
        return self[path]["values"]

    def get_fact(self, path, name):
        return self[path].get(name)


def read(data, limit=LIMIT):
    sink = Collected()
    file_formats.read(memoryview(data), "traj.mat", sink, limit)
    return sink


def opened(version, **variables):
    return read(matlab.saved(version, **variables))


def is_signal(sink, path, time, values=Q, times=TIMES, **facts):
    np.testing.assert_array_equal(sink.values(path), values)
    assert sink.get_fact(path, "time") == time
    np.testing.assert_allclose(sink.values(time)[:, 0], times, rtol=1e-15, atol=1e-12)
    assert sink.get_fact(time, "units") == ("s",)
    for name, value in facts.items():
        assert sink.get_fact(path, name) == value, name


@pytest.mark.parametrize("version", VERSIONS)
def test_a_timeseries_has_its_time_name_and_unit(version):
    sink = opened(
        version,
        ts=matlab.timeseries(Q, TIMES, name="q measured", unit="rad"),
        plain=Q,
        zagain=matlab.timeseries(Q, TIMES),
        slow=matlab.timeseries(Q, TIMES / 60 + 1, time_unit="minutes"),
        even=matlab.timeseries(np.float32(Q), step=0.25, unit=matlab.obj("Unit", Name="deg")),
    )
    is_signal(sink, "ts.Data", "ts.Time", label="q measured", units=("rad",))
    assert sink["ts"]["kind"] == "timeseries"
    assert not sink["ts"].get("is_object")
    assert sink.get_fact("zagain.Data", "time") == "ts.Time", "equal times are handed on once"
    np.testing.assert_allclose(sink.values("slow.Time")[:, 0], TIMES + 60, rtol=1e-12)
    assert sink["even.Data"]["kind"] == "single"
    assert sink.get_fact("even.Data", "units") == ("deg",)
    np.testing.assert_array_equal(sink.values("even.Time")[:, 0], np.arange(N) * 0.25)
    np.testing.assert_array_equal(sink.values("plain"), Q)


def test_the_samples_of_a_timeseries_are_rows_along_whichever_axis_its_time_runs():
    sink = opened("v7", ts=matlab.timeseries(Q.T, TIMES))
    is_signal(sink, "ts.Data", "ts.Time")


@pytest.mark.parametrize("stored", [Q.T[:, None, :], Q.T[None, :, :], np.ones((4, 4, N))])
def test_more_dimensions_of_a_timeseries_are_handed_on_as_they_are(stored):
    sink = opened("v7", ts=matlab.timeseries(stored, TIMES))
    is_signal(sink, "ts.Data", "ts.Time", stored)


def test_a_timeseries_of_whole_numbers_has_no_values():
    sink = opened("v7", b=matlab.timeseries(np.ones((N, 6), int), TIMES))
    assert (sink["b.Data"]["kind"], sink.values("b.Data")) == ("int64", None)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    "times",
    [
        matlab.duration(TIMES),
        matlab.datetime(TIMES),
        matlab.datetime(TIMES + 0.0003),
        matlab.regular(rate=50.0),
        matlab.regular(step=0.02),
    ],
    ids=["duration", "datetime", "fractions of a ms", "rate", "step"],
)
def test_a_timetable_has_its_row_times(version, times):
    sink = opened(version, TT=matlab.timetable({"q": Q}, times, units=["rad"], name="Zeit"))
    is_signal(sink, "TT.q", "TT.Zeit", label="q", units=("rad",))


@pytest.mark.parametrize("version", VERSIONS)
def test_the_columns_of_a_table_are_a_matrix_with_names_and_units(version):
    columns = {f"q{i + 1}": Q[:, [i]] for i in range(6)} | {"closed": Q[:, [0]] > 0}
    units = ["rad"] * 6 + [""]
    sink = opened(version, T=matlab.table(columns, units))
    np.testing.assert_array_equal(sink.values("T{:,:}"), np.column_stack([Q, Q[:, 0] > 0]))
    assert sink.get_fact("T{:,:}", "columns") == tuple(columns)
    assert sink.get_fact("T{:,:}", "units") == tuple(units)
    np.testing.assert_array_equal(sink.values("T.q3"), Q[:, [2]])
    assert sink.get_fact("T.q3", "units") == ("rad",)


def test_a_table_with_text_and_times_gives_its_numbers():
    columns = {
        "t": matlab.duration(TIMES),
        "q 1": Q[:, [0]],
        "q2": Q[:, [1]],
        "note": matlab.string("grasp"),
        "count": np.arange(N, dtype=np.int32)[:, None],
    }
    sink = opened("v7", T=matlab.table(columns, rows=N))
    path = "T{:,{'q 1','q2'}}"
    is_signal(sink, path, "T.t", Q[:, :2], columns=("q 1", "q2"))
    assert sink.get_fact("T.note", "text") == "grasp"
    assert sink["T.count"]["kind"] == "int32"
    np.testing.assert_array_equal(sink.values("T.('q 1')"), Q[:, [0]])


@pytest.mark.parametrize("version", VERSIONS)
def test_simulink_s_logs_are_opened(version):
    bus = matlab.struct(arm=matlab.timeseries(Q, TIMES, name="arm"))
    logs = matlab.dataset(
        matlab.signal(matlab.timeseries(Q, TIMES), "q"),
        matlab.timeseries(Q + 1, TIMES, name="qd"),
        matlab.signal(bus, "bus"),
        matlab.signal(matlab.timetable({"q": Q + 2}, matlab.duration(TIMES)), "tt"),
    )
    out = matlab.simulation_output(tout=TIMES[:, None], logsout=logs)
    sink = opened(version, out=out)
    np.testing.assert_array_equal(sink.values("out.tout")[:, 0], TIMES)
    time = "out.logsout{1}.Values.Time"
    is_signal(sink, "out.logsout{1}.Values.Data", time, label="q")
    is_signal(sink, "out.logsout{2}.Data", time, Q + 1, label="qd")
    is_signal(sink, "out.logsout{3}.Values.arm.Data", time, label="arm")
    is_signal(sink, "out.logsout{4}.Values.q", time, Q + 2)


@pytest.mark.parametrize("version", VERSIONS)
def test_maps_enumerations_and_strings_are_opened(version):
    sink = opened(
        version,
        m=matlab.MatlabContainerMap({"q": Q, "Größe": np.float64(2)}),
        s=matlab.string("UR5e"),
        c=matlab.obj(
            "categorical",
            categoryNames=matlab.cell("open", "closed", shape=(2, 1)),
            codes=np.ones((N, 1), np.uint8),
            isOrdinal=np.bool_(False),
        ),
        d=matlab.duration(TIMES),
        w=matlab.datetime(TIMES),
    )
    np.testing.assert_array_equal(sink.values("m('q')"), Q)
    assert sink.get_fact("m('q')", "label") == "q"
    assert sink.get_fact("s", "text") == "UR5e"
    assert sink.get_fact("c", "note") == CATEGORIES(names=["open", "closed"])
    for name in "dw":
        np.testing.assert_allclose(sink.values(name)[:, 0], TIMES, atol=1e-12)
        assert sink.get_fact(name, "units") == ("s",)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_class_of_one_s_own_shows_its_properties(version):
    inner = matlab.obj("Run", q=Q, fs=np.float64(50))
    sink = opened(version, log=matlab.struct(run=inner, n=np.float64(1)), c=matlab.cell(inner))
    np.testing.assert_array_equal(sink.values("log.run.q"), Q)
    np.testing.assert_array_equal(sink.values("c{1}.q"), Q)
    assert list(sink).count("log.n") == 1
    assert sink["log.run"]["kind"] == "Run"


def test_transforms_and_cameras_stay_closed():
    sink = opened("v7", T=matlab.obj("SE3", data=np.eye(4)), c=matlab.obj("CentralCamera", f=8.0))
    assert set(sink) == {"T", "c"}
    assert not sink["T"].get("is_object"), "there is nothing in it to miss"


def test_an_object_that_holds_itself_ends():
    loop = matlab.obj("Node", q=Q)
    data = matlab.saved("v7", a=loop)
    opener_sink = Collected()
    found = ObjectSink(opener_sink)
    opener = object_classes.Opener(found, Digests())
    loop.properties["next"] = loop
    opener.variable("a", loop)
    assert "a.next.next" not in opener_sink
    assert read(data)["a.q"]["values"] is not None


def test_the_number_of_parts_is_bounded(monkeypatch):
    monkeypatch.setattr(object_classes, "MOST_PARTS", 20)
    many = matlab.obj("Run", **{f"x{i}": np.float64(i) for i in range(50)})
    sink = opened("v7", many=many)
    assert sink.get_fact("many", "note") == TOO_MANY_PARTS(most=20)
    assert len(sink) < 25


def test_a_matrix_that_only_mat_io_finds_has_no_values(monkeypatch):
    monkeypatch.setattr(Digests, "__contains__", lambda self, values: values.size != Q.size)
    sink = opened("v7", ts=matlab.timeseries(Q, TIMES), r=matlab.obj("Run", q=Q))
    for path in ("ts.Data", "r.q"):
        assert sink.values(path) is None
        assert sink.get_fact(path, "note") == NUMBERS_DIFFER()


def test_without_mat_io_an_object_stays_closed_and_the_note_says_what_is_missing(monkeypatch):
    data = matlab.saved("v7", ts=matlab.timeseries(Q, TIMES), q=Q)
    monkeypatch.setattr(objects, "HAS_READER", False)
    sink = read(data)
    assert sink["ts"]["is_object"]
    assert "mat-io" in sink.get_fact("ts", "note")
    assert "Python 3.11" in sink.get_fact("ts", "note")
    np.testing.assert_array_equal(sink.values("q"), Q)


def test_mat_io_is_imported_for_objects_only(monkeypatch):
    asked = []
    monkeypatch.setattr(objects.importlib.util, "find_spec", asked.append)
    read(matlab.saved("v7", q=Q))
    read(matlab.saved("v7.3", q=Q))
    assert asked == []


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.slow
def test_damage_among_objects_is_refused_or_named(version):
    data = matlab.saved(version, ts=matlab.timeseries(Q, TIMES), q=Q)
    good = read(data)
    chance = np.random.default_rng(5)
    for _ in range(60):
        damaged = bytearray(data)
        for at in chance.integers(0, len(data), 3):
            damaged[at] ^= int(chance.integers(1, 256))
        try:
            sink = read(bytes(damaged))
        except (Damaged, TooLarge):
            continue
        if version == "v7" and sink.get("ts.Data", {}).get("values") is not None:
            np.testing.assert_array_equal(sink.values("ts.Data"), good.values("ts.Data"))


def test_strings_are_decoded():
    stored = matlab.string("Größe 1").properties["any"]
    assert list(decoded_strings(stored)) == ["Größe 1"]
    assert list(decoded_strings(stored[:, :3])) == []
    assert list(decoded_strings(np.full((1, 9), 1 << 60, np.uint64))) == []
    assert list(decoded_strings(None)) == []


LABELLED = {"name": "joint angles", "unit": "rad"}
FOUND = {
    "a.Data": {"a": matlab.timeseries(Q.T[:, None, :], TIMES)},
    "out.joints.Data": {
        "out": matlab.simulation_output(joints=matlab.timeseries(Q.T[None], TIMES))
    },
    "out.yout.signals.values": {
        "out": matlab.simulation_output(
            yout=matlab.struct(
                time=TIMES[:, None],
                signals=matlab.struct(values=Q.T[:, None, :], label="q"),
            )
        )
    },
    "x.Data": {"x": matlab.timeseries(Q, TIMES, **LABELLED)},
    "m('theta')": {"m": matlab.MatlabContainerMap({"theta": Q, "fs": np.float64(50)})},
    "q.Data": {"q": matlab.timeseries(Q, TIMES)},
    "log{1}.Values.Data": {"log": matlab.dataset(matlab.signal(matlab.timeseries(Q, TIMES), "q"))},
    "out.q.Data": {"out": matlab.simulation_output(q=matlab.timeseries(Q, TIMES))},
    "T{:,:}": {"T": matlab.table({f"q{i + 1}": Q[:, [i]] for i in range(6)}), "fs": 50.0},
    "TT.q": {"TT": matlab.timetable({"q": Q}, matlab.datetime(TIMES))},
    "m('q')": {"m": matlab.MatlabContainerMap({"q": Q, "tau": Q * 30}), "fs": 50.0},
    "run.q": {"run": matlab.obj("Run", q=Q, fs=np.float64(50))},
    "q": {"q": Q, "fs": 50.0, "tau": matlab.timeseries(Q * 30, TIMES)},
}


@pytest.fixture(scope="module")
def reader():
    with WorkspaceReader() as reader:
        yield reader


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("path", FOUND)
@pytest.mark.slow
def test_a_motion_in_an_object_is_converted(reader, version, path):
    data = matlab.saved(version, **FOUND[path])
    result = convert(
        "traj.mat",
        lambda: reader.read_bytes(data, "traj.mat"),
        Options(),
        make_model(6),
        load_coefficients(Path(__file__).parents[5] / "config" / "torque_proxy.yaml"),
    )
    assert result.trajectory is not None, result.message
    assert result.trajectory.source.variable == path
    assert result.trajectory.frame_rate == 50.0
    np.testing.assert_array_equal(result.trajectory.positions, Q)
