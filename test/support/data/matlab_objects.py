"""Builds MATLAB's objects as MATLAB stores them, and writes them with mat-io."""

import tempfile
from pathlib import Path

import numpy as np
from matio import save_to_mat
from matio.utils.matclass import MatlabContainerMap, MatlabOpaque

__all__ = ["MatlabContainerMap", "MatlabOpaque"]
EMPTY = np.zeros((0, 0))


def saved(version="v7", **variables):
    """Return the bytes of a workspace file of the version v6, v7 or v7.3."""
    form = {"v6": "v7"}.get(version, version)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "x.mat")
        save_to_mat(str(path), variables, version=form, do_compression=version != "v6")
        return path.read_bytes()


def struct(**fields):
    """Return a 1x1 struct."""
    made = np.empty((1, 1), dtype=[(name, object) for name in fields])
    for name, value in fields.items():
        made[name][0, 0] = value
    return made


def cell(*values, shape=None):
    """Return a cell array, a row if no shape is given."""
    made = np.empty(len(values), dtype=object)
    for i, value in enumerate(values):
        made[i] = value
    return made.reshape(shape or (1, len(values)), order="F")


def obj(classname, **properties):
    return MatlabOpaque(properties=properties, classname=classname)


def timeseries(data, times=None, *, step=None, name="", unit="", time_unit="seconds"):
    """Return a timeseries with its own times, (N,), or with a step and a start of 0."""
    data = np.asarray(data)
    count = len(times) if times is not None else len(data)
    info = obj(
        "tsdata.timemetadata",
        Units=time_unit,
        Length=np.float64(count),
        Time_=EMPTY if times is None else np.asarray(times, float).reshape(-1, 1),
        Increment_=EMPTY if step is None else np.float64(step),
        Start_=EMPTY if step is None else np.float64(0),
    )
    return obj(
        "timeseries",
        Name=name,
        DataInfo=obj("tsdata.datametadata", Units=unit),
        TimeInfo=info,
        Data_=data,
        Time_=EMPTY,
        IsTimeFirst_=np.bool_(data.shape[0] == count),
    )


def duration(seconds):
    return obj("duration", millis=np.asarray(seconds, float).reshape(-1, 1) * 1e3, fmt="s")


def datetime(seconds, since=1.7e12):
    """Return datetimes, s after a moment in 2023; parts of a ms in the imaginary part."""
    millis = np.asarray(seconds, float).reshape(-1, 1) * 1e3
    whole = np.floor(millis)
    if (whole == millis).all():
        return obj("datetime", data=since + millis, tz="", fmt="")
    return obj("datetime", data=(since + whole) + 1j * (millis - whole), tz="", fmt="")


def string(text):
    codes = np.frombuffer(text.encode("utf-16-le"), np.uint16)
    codes = np.concatenate([codes, np.zeros(-len(codes) % 4, np.uint16)])
    head = np.array([1, 2, 1, 1, len(text)], np.uint64)
    return obj("string", any=np.concatenate([head, codes.view(np.uint64)])[None, :])


def table(columns, units=(), rows=None):
    """Return a table of named columns."""
    names = cell(*columns)
    props = struct(
        useVariableNamesOriginal=np.bool_(False),
        VariableNamesOriginal=np.empty((0, 0), object),
        versionSavedFrom=np.float64(4),
        VariableUnits=cell(*units) if units else np.empty((0, 0), object),
    )
    count = rows if rows is not None else len(next(iter(columns.values())))
    return obj(
        "table",
        data=cell(*columns.values()),
        varnames=names,
        nrows=np.float64(count),
        nvars=np.float64(len(columns)),
        rownames=np.empty((0, 0), object),
        ndims=np.float64(2),
        props=props,
    )


def timetable(columns, times, units=(), name="Time"):
    """Return a timetable; times: a duration, a datetime or a struct of a regular one."""
    count = len(next(iter(columns.values())))
    stored = struct(
        versionSavedFrom=np.float64(6),
        data=cell(*columns.values()),
        useVarNamesOrig=np.bool_(False),
        useDimNamesOrig=np.bool_(False),
        dimNames=cell(name, "Variables"),
        varNames=cell(*columns),
        numRows=np.float64(count),
        numVars=np.float64(len(columns)),
        varUnits=cell(*units) if units else np.empty((0, 0), object),
        rowTimes=times,
    )
    return obj("timetable", any=stored)


def regular(*, rate=None, step=1.0, origin=0.0):
    """Return the row times of a timetable made with a SampleRate or a TimeStep, s."""
    return struct(
        origin=duration([origin]),
        specifiedAsRate=np.bool_(rate is not None),
        stepSize=duration([step]),
        sampleRate=np.float64(rate or np.nan),
    )


def dataset(*elements):
    """Return a Simulink.SimulationData.Dataset as MATLAB saves it since 2016."""
    storage = obj(
        "Simulink.SimulationData.Storage.RamDatasetStorage",
        Elements=np.empty((0, 0), object),
        any=struct(Version=np.float64(2), Elements=cell(*elements)),
    )
    inner = struct(Name="", Version=np.float64(3), Storage=storage)
    return obj("Simulink.SimulationData.Dataset", Version_=np.float64(3), Name="", any=inner)


def signal(values, name):
    return obj("Simulink.SimulationData.Signal", Name=name, Values=values, PortIndex=np.float64(1))


def simulation_output(**logged):
    return obj("Simulink.SimulationOutput", Data=struct(**logged))
