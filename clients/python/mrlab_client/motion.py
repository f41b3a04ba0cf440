"""Motions of the catalogue, and what the lab finds in one."""

from __future__ import annotations

import html
import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from mrlab_client.errors import LabError
from mrlab_client.table import data_frame

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from mrlab_client.http import Gateway


@dataclass(frozen=True)
class Finding:
    """One finding. rows: first and last, from 1; 0: the whole. value, limit: in `unit`."""

    severity: str
    code: str
    message: str
    remedy: str
    joint: str
    rows: tuple[int, int]
    value: float | None
    limit: float | None
    unit: str

    def __str__(self) -> str:
        return f"{self.severity}: {self.message} {self.remedy}".rstrip()


@dataclass(frozen=True)
class Motion:
    """A trajectory of the catalogue. frame_rate: Hz; duration: s."""

    id: str
    robot_model: str
    frame_rate: float
    frame_count: int
    duration: float
    version: int
    _gateway: Gateway = field(repr=False, compare=False)
    findings: tuple[Finding, ...] = field(default=(), repr=False)

    def positions(self) -> tuple[np.ndarray[Any, Any], tuple[str, ...]]:
        """Return the positions, (N, J) rad or m, and the names of the joints."""
        path = f"/api/trajectories/{self.id}@{self.version}/file"
        found = self._gateway.get(path, format="json")
        rows = np.array(found["frames"]["q"])
        return np.deg2rad(rows), tuple(found["joint_names"])

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame of the positions: a column a joint, by time, s."""
        rows, names = self.positions()
        return data_frame(rows, np.arange(len(rows)) / self.frame_rate, names)


@dataclass(frozen=True)
class Check:
    """What the lab says of a motion. draft: names it at the lab; empty: it is refused."""

    ok: bool
    message: str
    findings: tuple[Finding, ...]
    draft: str
    page: str

    def __str__(self) -> str:
        return "\n".join([self.message, *(f"  {each}" for each in self.findings)])

    def _repr_html_(self) -> str:
        rows = "".join(
            "<tr>"
            + "".join(
                f"<td>{html.escape(str(cell))}</td>"
                for cell in (
                    each.severity,
                    each.joint,
                    each.rows[0] or "",
                    each.message,
                    each.remedy,
                )
            )
            + "</tr>"
            for each in self.findings
        )
        return f"<p>{html.escape(self.message)}</p><table>{rows}</table>"


def finding_of(one: Mapping[str, Any]) -> Finding:
    """Return a finding of the gateway's JSON."""
    return Finding(
        severity=str(one["severity"]),
        code=str(one["code"]),
        message=str(one["message"]),
        remedy=str(one["remedy"]),
        joint=str(one["joint"]),
        rows=(one["first_row"], max(one["first_row"], one["last_row"])),
        value=one["value"],
        limit=one["limit"],
        unit=str(one["unit"]),
    )


def check_of(answer: Mapping[str, Any], url: str) -> Check:
    """Return what a conversion found."""
    found = answer["conversion"]
    findings = tuple(map(finding_of, found["diagnostics"]))
    draft = found["draft"] or ""
    return Check(found["outcome"] == "accepted", found["message"], findings, draft, f"{url}/live")


def motion_of(info: Mapping[str, Any], gateway: Gateway, findings: tuple[Finding, ...]) -> Motion:
    """Return the catalogue's entry of the gateway's JSON."""
    return Motion(
        id=info["id"],
        robot_model=info["robot_model"],
        frame_rate=info["frame_rate"],
        frame_count=info["frame_count"],
        duration=(info["frame_count"] - 1) / info["frame_rate"],
        version=info["version"],
        findings=findings,
        _gateway=gateway,
    )


def packed(q: ArrayLike, fs: ArrayLike | None) -> bytes:
    """Return an array with its rate as an .npz, all bits of the numbers.

    q: (N, J) rad, m where prismatic; a further column is the gripper. fs: Hz, or (N,) s. Raises
    LabError where q is no matrix of reals, or fs no rate.
    """
    rows = np.asarray(q)
    if rows.ndim != 2 or rows.dtype.kind not in "fiu":
        raise LabError(
            f"An array of {rows.dtype} with the shape {rows.shape} is no motion; expected a "
            "matrix of real numbers, with a row a frame and a column a joint.",
            "array_shape",
        )
    content = {"q": rows.astype(np.float64)}
    if fs is not None:
        times = np.asarray(fs)
        real = times.dtype.kind in "fiu" and times.ndim < 2 and bool(np.isfinite(times).all())
        one = times.size == 1
        if not real or (one and float(times.item()) <= 0) or not (one or times.size == len(rows)):
            raise LabError(
                f"fs is {str(fs)[:60]}, which is no rate; expected a number of Hz above 0, or the "
                f"time of each of the {len(rows)} rows in s.",
                "array_rate",
            )
        content["fs" if one else "t"] = times.astype(np.float64).reshape(() if one else -1)
    made = io.BytesIO()
    np.savez(made, **content)  # type: ignore[arg-type]
    return made.getvalue()
