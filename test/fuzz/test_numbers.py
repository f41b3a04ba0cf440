"""Files of any format with numbers of any size: each ends by itself, and none ends the converter.

The shapes are those of workspaces, the values what floating point has: the largest, the smallest,
infinite, none. `made(seed)` is one such file; the tests take some of them, all of them different.
"""

from __future__ import annotations

import contextlib
import io
import json
import random
import struct
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import orjson
import pytest
import scipy.io
from typer.testing import CliRunner

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.app.convert import Wanted, convert_files
from mrlab_ros.app.show.motion import motion_page
from mrlab_ros.cli import make_app
from mrlab_ros.commands import output
from mrlab_ros.commands.convert import report
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.conversion.options import Options

FILES = 120
FOLDER = share.directory()
LIBRARY = RobotLibrary(FOLDER / "robots")
UR5E = LIBRARY.model("ur5e")
EXTREME = (
    *(1e308, -1e308, 1e160, -1e200, 5e-324, 1e-160),
    *(np.nan, np.inf, -np.inf, 0.0, 1e18, 2.0**63),
)
NAMES = (
    *("q", "t", "fs", "dt", "Ts", "qd", "qdd"),
    *("x", "gripper", "rate", "q_deg", "T", "tool", "n"),
)
SHAPES = (
    *((100, 6), (100, 6), (100, 7), (6, 100), (2, 6), (1, 6), (100, 1), (1, 100), (1, 1), (0, 6)),
    *((0, 0), (100, 12), (4, 4, 50), (100, 1, 6), (1, 1, 1, 100, 6), (7, 7), (2,) * 8),
)
KINDS = (np.float32, np.int8, np.int64, np.uint64, np.complex128)
OPTIONS = (
    *(Options(), Options(), Options(transpose=True), Options(units="deg"), Options(unwrap=True)),
    *(Options(frame_rate=100.0), Options(variable="q"), Options(columns="1:6")),
    Options(resample=True),
)
CONVERTER_FAULTS = {"converter_failed", "reader_crashed"}


def values(chance: random.Random) -> Any:
    shape = chance.choice(SHAPES)
    made = np.linspace(0, 1, int(np.prod(shape))).reshape(shape) ** 2
    way = chance.random()
    if way < 0.3:
        made = made * chance.choice(EXTREME)
    elif way < 0.5 and made.size:
        made.flat[chance.randrange(made.size)] = chance.choice(EXTREME)
    elif way < 0.7:
        made = np.array([chance.choice(EXTREME) for _ in range(made.size)], float).reshape(shape)
    elif way < 0.8:
        made = np.cumsum(made * chance.choice(EXTREME), axis=0)
    return made.astype(chance.choice(KINDS)) if chance.random() < 0.2 else made


def made(seed: int) -> tuple[str, bytes]:
    """Return the name and the bytes of a file."""
    chance, file = random.Random(seed), io.BytesIO()
    with np.errstate(all="ignore"):
        held = {chance.choice(NAMES): values(chance) for _ in range(chance.randrange(1, 5))}
    kind = chance.randrange(5)
    if kind == 0:
        scipy.io.savemat(file, held if chance.random() < 0.6 else {"s": held})
    elif kind == 1:
        np.savez(file, **held)
        return f"{seed}.npz", file.getvalue()
    elif kind == 2:
        table = next(iter(held.values()))
        table = np.real(table.reshape(len(table), -1) if table.size else np.zeros((0, 1)))
        heads = ",".join(chance.choice(NAMES) for _ in range(table.shape[1]))
        rows = [heads] * (chance.random() < 0.5)
        rows += [",".join(repr(float(x)) for x in row) for row in table]
        return f"{seed}.csv", "\n".join(rows).encode()
    elif kind == 3:
        plain = {name: np.nan_to_num(np.real(each)).tolist() for name, each in held.items()}
        return f"{seed}.json", orjson.dumps(plain)
    else:
        with h5py.File(file, "w", userblock_size=512) as workspace:
            for name, each in held.items():
                item = workspace.create_dataset(name, data=np.real(each).T)
                item.attrs["MATLAB_class"] = np.bytes_("double")
        content = bytearray(file.getvalue())
        content[:128] = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
        return f"{seed}.mat", bytes(content)
    return f"{seed}.mat", file.getvalue()


def mat5(lengths: list[int]) -> bytes:
    """Return a v5 workspace with a q of these lengths, of 360 numbers."""

    def element(kind: int, data: bytes) -> bytes:
        return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)

    array = element(6, struct.pack("<II", 6, 0))
    array += element(5, struct.pack(f"<{len(lengths)}i", *lengths)) + element(1, b"q")
    array += element(9, struct.pack("<360d", *np.linspace(0, 0.36, 360)))
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + element(14, array)


@pytest.mark.timeout(300)
@pytest.mark.slow
def test_no_file_ends_the_converter_or_a_report(tmp_path: Path) -> None:
    wanted = []
    (tmp_path / "written").mkdir()
    for seed in range(FILES):
        name, content = made(seed)
        (tmp_path / name).write_bytes(content)
        options = random.Random(seed).choice(OPTIONS)
        wanted.append(Wanted(tmp_path / name, UR5E, options, None))
    results = convert_files(wanted)
    outcomes = set()
    for number, (each, result) in enumerate(zip(wanted, results, strict=True)):
        outcomes.add(result.outcome.name)
        faults = [d.message for d in result.diagnostics if d.code in CONVERTER_FAULTS]
        assert not faults, (each, faults)
        json.loads(orjson.dumps(report.record(each.path.name, result, None)))
        with (console := output.console()).capture():
            report.show(result, None, ["mrlab", "convert", "f"], each.options, console)
        if number % 12 == 0:
            with contextlib.suppress(LabError):  # there is nothing to show
                motion_page(result, "ur5e", None, LIBRARY, FOLDER)
        if result.trajectory is not None:
            for to in ("json", "csv", "mat", "npz", "jointtrajectory"):
                formats.writer(to)(result.trajectory, tmp_path / "written")
            formats.plot(result.trajectory, UR5E, tmp_path / "plot.png")
        elif shown := result.preview:
            formats.plot_refused(shown, result.diagnostics, "f", UR5E, tmp_path / "plot.png")
    assert outcomes == {"ACCEPTED", "REJECTED", "AMBIGUOUS"}


@pytest.mark.parametrize(
    "lengths", [[1] * 1000 + [60, 6], [60, 6] + [1] * 1000, [-1, 6], [2**31 - 1] * 40, [0] * 100]
)
def test_an_array_of_any_rank_is_one_file(tmp_path: Path, lengths: list[int]) -> None:
    (tmp_path / "odd.mat").write_bytes(mat5(lengths))
    (tmp_path / "well.mat").write_bytes(mat5([60, 6]))
    odd, well = convert_files(
        [Wanted(tmp_path / f"{name}.mat", UR5E, Options(), None) for name in ("odd", "well")]
    )
    assert odd.outcome.name == "REJECTED"
    assert {d.code for d in odd.diagnostics}.isdisjoint(CONVERTER_FAULTS)
    assert well.outcome.name == "ACCEPTED"


def test_a_file_that_no_report_can_be_made_of_does_not_end_its_batch(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("a", "b", "c"):
        (tmp_path / f"{name}.mat").write_bytes(mat5([60, 6]))
    whole = report.record

    def fails_once(given: str, result: Any, written: Path | None) -> dict[str, Any]:
        if given.endswith("b.mat") and result.trajectory is not None:
            raise ValueError("cannot convert float NaN to integer")
        return whole(given, result, written)

    monkeypatch.setattr(report, "record", fails_once)
    words = ["convert", str(tmp_path), "--robot", "ur5e", "--json"]
    done = CliRunner().invoke(make_app(["convert"]), words)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert [line["outcome"] for line in lines] == ["accepted", "rejected", "accepted"]
    assert [d["code"] for d in lines[1]["diagnostics"]] == ["converter_failed"]
    assert done.exit_code == output.BROKEN
