"""Meaning of the properties of MATLAB's classes: data, times, names and units.

Depth and number of parts are bounded; a class that means nothing to a converter stays closed.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.diagnostics import (
    CATEGORIES,
    ENUMERATION,
    NUMBERS_DIFFER,
    TOO_MANY_PARTS,
)
from mrlab_ros.adapters.workspaces.matlab.elements import index
from mrlab_ros.adapters.workspaces.matlab.mat5 import DEEPEST, LONGEST_TEXT
from mrlab_ros.adapters.workspaces.matlab.object_values import (
    as_rows,
    cells,
    decoded_strings,
    elements,
    inner,
    is_numbers,
    key_of,
    kind_of,
    names_of,
    number,
    places,
    shape_of,
    struct,
    text,
    texts,
    unit_of,
)
from mrlab_ros.adapters.workspaces.sinks import Digests, Found, ObjectSink, WithinObjects, digest
from mrlab_ros.core.conversion.workspace import shortened

MOST_PARTS = 50_000  # properties, fields and cells that are visited in one file
# seconds in a unit of time, as a timeseries names it
SECONDS = {
    "nanoseconds": 1e-9,
    "microseconds": 1e-6,
    "milliseconds": 1e-3,
    "seconds": 1.0,
    "minutes": 60.0,
    "hours": 3600.0,
    "days": 86_400.0,
    "weeks": 604_800.0,
}
# classes whose parts are no data of a motion: transforms, cameras, symbols, graphics
CLOSED = re.compile(
    r"(calendarDuration|quaternion|SE[23]|SO[23]|Twist|sym|.*Camera.*|Cuboid|.*[Mm]esh.*|"
    r"matlab\.(ui|graphics)\..*)$"
)
ROBOTS = re.compile(r"(SerialLink|robot)$")
# what a SerialLink and its links have that says how it moves, in new and in old toolboxes
LINK_PARTS = (
    *("theta", "d", "D", "a", "A", "alpha", "offset"),
    *("mdh", "flip", "sigma", "jointtype", "qlim"),
)
ROBOT_PARTS = ("name", "base", "tool", "mdh", "manufacturer", "manuf")


class TooMany(Exception):
    """The objects have more parts than are visited."""


class Opener:
    """Walks over what mat-io loaded, and hands the numbers inside objects to a sink."""

    def __init__(self, found: ObjectSink, known: Digests) -> None:
        from matio.utils.matclass import MatlabFunction, MatlabObject, MatlabOpaque

        self.closed = found.closed
        self.sink = WithinObjects(found.sink)
        self.known = known
        self.opened: set[str] = set()
        self._function, self._old, self._opaque = MatlabFunction, MatlabObject, MatlabOpaque
        self._parts = 0
        self._times_seen: dict[bytes, str] = {}
        self._above: set[int] = set()
        self._classes: dict[str, Callable[[str, dict[str, Any], str], None]] = {
            "timeseries": self._timeseries,
            "timetable": self._timetable,
            "table": self._table,
            "datetime": self._datetime,
            "duration": self._duration,
            "string": self._string,
            "categorical": self._categorical,
            "containers.Map": self._map,
            "dictionary": self._dictionary,
            "Simulink.SimulationOutput": self._simulation_output,
            "Simulink.SimulationData.Dataset": self._dataset,
            "rigidBodyTree": self._rigid_body_tree,
            "robotics.RigidBodyTree": self._rigid_body_tree,
        }

    def variable(self, name: str, value: Any) -> None:
        """Open the objects in one variable of the workspace."""
        try:
            self._walk(name, value, inside=False)
        except TooMany:
            self.sink.add(Found(name, "object", (), note=TOO_MANY_PARTS(most=MOST_PARTS)))

    # every kind of value

    def _walk(self, path: str, value: Any, *, inside: bool, label: str = "") -> None:
        """Hand on what `value` holds; plain values only `inside` of an object."""
        self._parts += 1
        if self._parts > MOST_PARTS:
            raise TooMany
        if id(value) in self._above or len(self._above) > DEEPEST:
            return
        self._above.add(id(value))
        try:
            if isinstance(value, self._opaque):
                self._object(path, value.classname, value.properties, label)
            elif isinstance(value, np.ndarray):
                self._array(path, value, inside=inside, label=label)
            elif inside:
                self.sink.add(Found(path, "sparse" if hasattr(value, "tocsc") else "unknown", ()))
        finally:
            self._above.discard(id(value))

    def _array(self, path: str, value: NDArray[Any], *, inside: bool, label: str) -> None:
        shape = tuple(int(n) for n in value.shape)
        classname = getattr(value, "classname", None)
        if isinstance(value, self._function):
            if inside:
                self.sink.add(Found(path, "function_handle", shape, is_object=True))
        elif isinstance(value, self._old):
            fields = {name: value[name].flat[0] for name in value.dtype.names or () if value.size}
            self._object(path, str(classname), fields, label)
        elif value.dtype.names:
            if inside:
                self.sink.add(Found(path, "struct", shape))
            for number, place in enumerate(places(value)):
                element = path if value.size == 1 else f"{path}({index(shape, number)})"
                for name in value.dtype.names:
                    self._walk(f"{element}.{name}", value[place][name], inside=inside)
        elif value.dtype == object:
            is_cell = classname is None
            if inside and is_cell:
                self.sink.add(Found(path, "cell", shape))
            elif not is_cell:
                self._opens(path, str(classname), shape)
                if CLOSED.match(str(classname)):
                    return
            for number, place in enumerate(places(value)):
                mark = "{%s}" if is_cell else "(%s)"
                self._walk(path + mark % index(shape, number), value[place], inside=inside)
        elif inside:
            self._plain(path, value, label=label)

    def _plain(self, path: str, value: NDArray[Any], **facts: Any) -> None:
        """Hand on an array of numbers or text."""
        shape = tuple(int(n) for n in value.shape)
        if value.dtype.kind in "US":
            text = str(value.flat[0]) if value.size == 1 else ""
            self.sink.add(
                Found(path, "char", (1, len(text)), text=text if len(text) <= LONGEST_TEXT else "")
            )
            return
        kind = {"f8": "double", "f4": "single", "b1": "logical", "c16": "double", "c8": "single"}
        name = kind.get(value.dtype.str[1:], value.dtype.name)
        if value.dtype.kind == "c":
            self.sink.add(Found(path, name, shape, note="complex"))
        elif value.dtype.kind != "f" or value.ndim < 2:
            if name == "logical" and value.size == 1:
                facts["text"] = "true" if value.flat[0] else "false"
            self.sink.add(Found(path, name, shape, **facts))
        elif value not in self.known:
            self.sink.add(Found(path, name, shape, note=NUMBERS_DIFFER()))
        else:
            self._numbers(path, name, value, **facts)

    def _numbers(self, path: str, kind: str, values: NDArray[Any], **facts: Any) -> None:
        data = values.tobytes(order="F")
        self.sink.add(Found(path, kind, values.shape, data, values.dtype.str, **facts))

    def _opens(self, path: str, kind: str, shape: tuple[int, ...] = (), **facts: Any) -> None:
        """Name an object whose parts follow."""
        self.opened.add(path)
        self.sink.add(Found(path, kind, shape, **facts))

    # objects

    def _object(self, path: str, classname: str, properties: Any, label: str) -> None:
        kind = self.closed.get(path) or classname
        if isinstance(properties, tuple):
            self._opens(path, kind, tuple(int(n) for n in properties))
        elif isinstance(properties, np.ndarray) and properties.dtype.names:
            self._enumeration(path, kind, properties)
        elif not isinstance(properties, dict):
            if path not in self.closed:
                self.sink.add(Found(path, kind, (), is_object=True))
        elif kind in self._classes:
            self._classes[kind](path, properties, label)
        elif ROBOTS.match(kind):
            self._serial_link(path, kind, properties)
        elif kind.startswith("Simulink.SimulationData.") and "Values" in properties:
            name = text(properties.get("Name")) or label
            self._opens(path, kind, (1, 1), label=name)
            self._walk(f"{path}.Values", properties["Values"], inside=True, label=name)
        else:
            self._opens(path, kind, (1, 1), label=label)
            if CLOSED.match(kind):
                return
            for name, value in properties.items():
                if not name.startswith("_"):
                    self._walk(f"{path}.{name}", value, inside=True)

    def _enumeration(self, path: str, kind: str, stored: NDArray[Any]) -> None:
        names = stored[0, 0]["ValueNames"]
        said = shortened(sorted({str(n) for n in np.ravel(names)}))
        self._opens(path, kind, shape_of(names), note=ENUMERATION(names=said))

    def _timeseries(self, path: str, properties: dict[str, Any], label: str) -> None:
        """Hand on `path.Data` with its samples as rows, and `path.Time` in s."""
        name = text(properties.get("Name")) or label
        self._opens(path, "timeseries", (1, 1), label=name)
        data = properties.get("Data_", properties.get("Data"))
        if isinstance(data, np.ndarray) and not data.size:
            storage = inner(properties.get("Storage_"))
            data = storage.get("Data_", storage.get("Data", data))
        times = self._sample_times(properties)
        time = self._time(f"{path}.Time", times)
        if not isinstance(data, np.ndarray) or data.dtype == object:
            self._walk(f"{path}.Data", data, inside=True)
            return
        if data.dtype.kind == "f" and data.size and data not in self.known:
            self._plain(f"{path}.Data", data)
            return
        unit = unit_of(inner(properties.get("DataInfo")).get("Units"))
        rows = as_rows(data, len(times) if times is not None else 0)
        facts = {"label": name, "units": (unit,) if unit else ()}
        if rows.dtype.kind == "f" and rows.ndim >= 2:
            counts = (rows.shape[0],) if rows.ndim == 2 else (rows.shape[0], rows.shape[-1])
            time = time if times is not None and len(times) in counts else ""
            self._numbers(f"{path}.Data", kind_of(rows), rows, time=time, **facts)
        else:
            self._plain(f"{path}.Data", data, **facts)

    def _time(self, path: str, times: NDArray[Any] | None) -> str:
        """Hand on times, (N, 1) s, unless it was done before; return their path, empty: none."""
        if times is None:
            return ""
        seen = self._times_seen.setdefault(digest(times), path)
        if seen == path:
            self._numbers(path, "double", times, units=("s",))
        return seen

    def _sample_times(self, properties: dict[str, Any]) -> NDArray[Any] | None:
        """Return the times of a timeseries, (N, 1) s, None where there are none."""
        info = inner(properties.get("TimeInfo"))
        scale = SECONDS.get(text(info.get("Units")).lower(), 1.0)
        for times in (info.get("Time_"), properties.get("Time_"), properties.get("Time")):
            if times is not None and is_numbers(times) and times.size and times in self.known:
                return np.asarray(times, np.float64).reshape(-1, 1) * scale
        step, start = number(info.get("Increment_")), number(info.get("Start_"))
        length = number(info.get("Length"))
        if not (np.isfinite([step, length]).all() and 0 < length <= 1e9):
            return None
        begin = start if np.isfinite(start) else 0.0
        return (begin + step * np.arange(int(length), dtype=np.float64))[:, None] * scale

    def _timetable(self, path: str, properties: dict[str, Any], label: str) -> None:
        stored = struct(properties.get("any"))
        names = names_of(stored, "varNames", "useVarNamesOrig", "varNamesOrig")
        rows = names_of(stored, "dimNames", "useDimNamesOrig", "dimNamesOrig")
        self._opens(path, "timetable", (int(number(stored.get("numRows")) or 0), len(names)))
        times = self._row_times(stored.get("rowTimes"), int(number(stored.get("numRows")) or 0))
        time = self._time(f"{path}.{rows[0] if rows else 'Time'}", times)
        units = texts(stored.get("varUnits"))
        self._columns(path, stored.get("data"), names, units, time)

    def _row_times(self, stored: Any, count: int) -> NDArray[Any] | None:
        """Return the times of a timetable's rows, (N, 1) s from the first datetime or from 0."""
        if not (isinstance(stored, np.ndarray) and stored.dtype.names):
            return self._seconds(stored)
        regular = struct(stored)
        origin = self._seconds(regular.get("origin"))
        begin = float(origin[0, 0]) if origin is not None and origin.size else 0.0
        if bool(number(regular.get("specifiedAsRate"))):
            rate = number(regular.get("sampleRate"))
            if not rate > 0:
                return None
            return (begin + np.arange(count, dtype=np.float64) / rate)[:, None]
        step = self._seconds(regular.get("stepSize"))
        if step is None or not step.size:
            return None
        return (begin + np.arange(count, dtype=np.float64) * float(step[0, 0]))[:, None]

    def _seconds(self, value: Any) -> NDArray[Any] | None:
        """Return a duration or a datetime as (N, 1) s, a datetime from its first element."""
        if not isinstance(value, self._opaque) or not isinstance(value.properties, dict):
            return None
        if value.classname == "duration":
            millis = value.properties.get("millis")
            if millis is not None and is_numbers(millis) and millis in self.known:
                return np.asarray(millis, np.float64).reshape(-1, 1, order="F") / 1e3
        if value.classname == "datetime":
            millis = value.properties.get("data")
            if (
                isinstance(millis, np.ndarray)
                and millis.dtype.kind in "fc"
                and (millis in self.known)
            ):
                flat = millis.reshape(-1, 1, order="F")
                # the imaginary part is the rounding error of the real one
                whole = flat.real - flat.real[:1]
                return np.asarray((whole + (flat.imag - flat.imag[:1])) / 1e3)
        return None

    def _table(self, path: str, properties: dict[str, Any], label: str) -> None:
        props = struct(properties.get("props"))
        names = names_of(props, "", "useVariableNamesOriginal", "VariableNamesOriginal")
        names = names or texts(properties.get("varnames"))
        self._opens(path, "table", (int(number(properties.get("nrows")) or 0), len(names)))
        units = texts(props.get("VariableUnits"))
        self._columns(path, properties.get("data"), names, units, "")

    def _columns(
        self, path: str, data: Any, names: list[str], units: list[str], time: str
    ) -> None:
        """Hand on each variable of a table, and those of one column together as a matrix."""
        if not isinstance(data, np.ndarray) or data.dtype != object:
            return
        times = {i: self._seconds(value) for i, value in enumerate(data.reshape(-1))}
        times = {i: seconds for i, seconds in times.items() if seconds is not None}
        parts = [
            f"{path}.{name}" if name.isidentifier() else f"{path}.('{name}')" for name in names
        ]
        if not time and len(times) == 1:
            time = parts[next(iter(times))]
        singles: list[int] = []
        for i, value in enumerate(data.reshape(-1)[: len(names)]):
            unit = units[i] if i < len(units) else ""
            seconds = times.get(i)
            if seconds is not None:
                self._numbers(parts[i], value.classname, seconds, units=("s",), label=names[i])
            elif isinstance(value, np.ndarray) and value.dtype.kind in "fb" and value.ndim == 2:
                if value.shape[1] == 1 and value in self.known:
                    singles.append(i)
                facts = {"units": (unit,) if unit else (), "label": names[i], "time": time}
                self._plain(parts[i], value, **facts)
            else:
                self._walk(parts[i], value, inside=True, label=names[i])
        chosen = [data.reshape(-1)[i] for i in singles]
        if len(chosen) < 2 or len({len(values) for values in chosen}) > 1:
            return
        listed = ",".join(f"'{names[i]}'" for i in singles)
        which = ":" if len(singles) == data.size else f"{{{listed}}}"
        said = [units[i] if i < len(units) else "" for i in singles]
        self._numbers(
            f"{path}{{:,{which}}}",
            "double",
            np.column_stack(chosen).astype(np.float64),
            columns=tuple(names[i] for i in singles),
            units=tuple(said) if any(said) else (),
            time=time,
        )

    def _datetime(self, path: str, properties: dict[str, Any], label: str) -> None:
        self._times(path, "datetime", properties)

    def _duration(self, path: str, properties: dict[str, Any], label: str) -> None:
        self._times(path, "duration", properties)

    def _times(self, path: str, kind: str, properties: dict[str, Any]) -> None:
        self.opened.add(path)
        seconds = self._seconds(self._opaque(properties, kind))
        stored = properties.get("millis", properties.get("data"))
        if seconds is None or not seconds.size:
            self.sink.add(Found(path, kind, shape_of(stored)))
        else:
            shape = shape_of(stored)
            values = seconds.reshape(shape, order="F") if len(shape) == 2 else seconds
            self._numbers(path, kind, values, units=("s",))

    def _string(self, path: str, properties: dict[str, Any], label: str) -> None:
        strings = list(decoded_strings(properties.get("any")))
        only = strings[0] if len(strings) == 1 and len(strings[0]) <= LONGEST_TEXT else ""
        self._opens(path, "string", (1, len(strings)), text=only)

    def _categorical(self, path: str, properties: dict[str, Any], label: str) -> None:
        note = CATEGORIES(names=shortened(list(texts(properties.get("categoryNames")))))
        self._opens(path, "categorical", shape_of(properties.get("codes")), note=note)

    def _map(self, path: str, properties: dict[str, Any], label: str) -> None:
        stored = struct(properties.get("serialization"))
        keys, values = cells(stored.get("keys")), cells(stored.get("values"))
        self._opens(path, "containers.Map", (len(keys), 1))
        for key, value in zip(keys, values, strict=False):
            self._walk(f"{path}({key_of(key)})", value, inside=True, label=text(key))

    def _dictionary(self, path: str, properties: dict[str, Any], label: str) -> None:
        stored = struct(properties.get("data"))
        keys, values = stored.get("Key"), stored.get("Value")
        self._opens(path, "dictionary", ())
        if not isinstance(values, np.ndarray) or values.dtype != object:
            return
        if isinstance(keys, self._opaque) and isinstance(keys.properties, dict):
            marks = [f'"{name}"' for name in decoded_strings(keys.properties.get("any"))]
        else:
            marks = [key_of(key) for key in cells(keys)]
        for mark, value in zip(marks, values.reshape(-1), strict=False):
            self._walk(f"{path}{{{mark}}}", value, inside=True, label=mark.strip('"'))

    def _simulation_output(self, path: str, properties: dict[str, Any], label: str) -> None:
        self._opens(path, "Simulink.SimulationOutput", (1, 1))
        for name, value in struct(properties.get("Data")).items():
            self._walk(f"{path}.{name}", value, inside=True, label=name)

    def _dataset(self, path: str, properties: dict[str, Any], label: str) -> None:
        found = cells(elements(properties, 4))
        self._opens(path, "Simulink.SimulationData.Dataset", (1, len(found)))
        for number_, value in enumerate(found, 1):
            name = text(inner(value).get("Name"))
            self._walk(f"{path}{{{number_}}}", value, inside=True, label=name)

    # kinematics

    def _serial_link(self, path: str, kind: str, properties: dict[str, Any]) -> None:
        """Hand on the parts of a SerialLink, or of an old toolbox's robot, that move it."""
        self._opens(path, kind, (1, 1), label=text(properties.get("name")))
        for name in ROBOT_PARTS:
            value = properties.get(name)
            value = inner(value).get("data", value)
            if isinstance(value, np.ndarray):
                self._walk(f"{path}.{name}", value, inside=True)
        links = properties.get("links", properties.get("link"))
        if not isinstance(links, np.ndarray):
            links = np.array([[links]], dtype=object)
        for number_, link in enumerate(links.reshape(-1, order="F"), 1):
            parts = inner(link)
            for name in LINK_PARTS:
                if isinstance(parts.get(name), np.ndarray):
                    self._walk(f"{path}.links({number_}).{name}", parts[name], inside=True)

    def _rigid_body_tree(self, path: str, properties: dict[str, Any], label: str) -> None:
        """Hand on the joints of a rigidBodyTree under the names that MATLAB shows them by."""
        tree = inner(properties.get("TreeInternal")) or properties
        self._opens(path, "rigidBodyTree", (1, 1))
        for number_, body in enumerate(cells(tree.get("Bodies")), 1):
            parts = inner(body)
            parts = inner(parts.get("BodyInternal")) or parts
            joint = inner(parts.get("JointInternal", parts.get("Joint")))
            place = f"{path}.Bodies{{{number_}}}"
            wanted = {
                "Name": parts.get("NameInternal", parts.get("Name")),
                "ParentIndex": parts.get("ParentIndex"),
                "Joint.Name": joint.get("NameInternal", joint.get("Name")),
                "Joint.Type": joint.get("Type"),
                "Joint.JointAxis": joint.get("JointAxisInternal", joint.get("JointAxis")),
                "Joint.JointToParentTransform": joint.get("JointToParentTransform"),
                "Joint.ChildToJointTransform": joint.get("ChildToJointTransform"),
                "Joint.PositionLimits": joint.get(
                    "PositionLimitsInternal", joint.get("PositionLimits")
                ),
            }
            for name, value in wanted.items():
                if isinstance(value, np.ndarray):
                    self._walk(f"{place}.{name}", value, inside=True)
