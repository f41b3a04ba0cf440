"""Each fact that keeps a lab from working is named, with what to do; nothing else is."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mrlab_ros.core.base.diagnostic import Diagnostic, of_text
from mrlab_ros.core.runtime.doctor import NEEDED, Certificate, Facts, Gateway, Port, examine

DAY = 24 * 3600.0
URL = "https://lab:8080"
WELL = Facts(
    python=(3, 11),
    set_up=("/clone", []),
    modules={**dict.fromkeys(NEEDED, True), "pybullet": True},
    middleware="",
    middlewares=["rmw_fastrtps_cpp"],
    multicast=None,
    pages=True,
    version="1.0.0",
    ports=[Port(8080, "pages", free=False, ours=True), Port(7447, "zenoh", free=True, ours=False)],
    gateway=Gateway(URL, "1.0.0", 0.0, ""),
    certificate=Certificate("lab.crt", "2026-05-30", 90 * DAY),
    state_dir="/lab",
    state_writable=True,
    free_bytes=50_000_000_000,
    sandbox={"landlock": True, "seccomp": True},
)


def failing(**change: object) -> list[Diagnostic]:
    """Return what is not well."""
    return [each for each in examine(replace(WELL, **change)) if each.refuses]


def test_a_machine_that_is_well_has_nothing_to_do():
    findings = list(examine(WELL))
    assert len(findings) > 10
    assert not any(each.refuses or each.remedy or each.fixes for each in findings)


@pytest.mark.parametrize(
    ("change", "code", "values"),
    [
        ({"python": (3, 14)}, "python_unfit", {"version": "3.14", "last": "3.13"}),
        ({"python": (3, 9)}, "python_unfit", {"version": "3.9", "first": "3.10"}),
        ({"set_up": ("/clone", ["pages"])}, "set_up_outdated", {"steps": ["pages"]}),
        ({"modules": {**WELL.modules, "zenoh": False}}, "wheels_missing", {"modules": ["zenoh"]}),
        (
            {"modules": {**WELL.modules, "pybullet": False}},
            "module_missing",
            {"module": "pybullet"},
        ),
        ({"middlewares": []}, "middleware_none", {}),
        ({"middleware": "rmw_zenoh_cpp"}, "middleware_other", {"wanted": "rmw_zenoh_cpp"}),
        ({"multicast": "timed out"}, "multicast_blocked", {"why": of_text("timed out")}),
        ({"pages": False}, "pages_not_built", {}),
        ({"ports": [Port(8080, "pages", False, False)]}, "port_in_use", {"port": 8080}),
        ({"ports": [Port(7447, "zenoh", False, False)]}, "port_in_use", {"port": 7447}),
        ({"gateway": Gateway(URL, "", None, "refused")}, "gateway_silent", {"url": URL}),
        ({"gateway": Gateway(URL, "0.9", 0.0, "")}, "gateway_differs", {"version": "0.9"}),
        ({"gateway": Gateway(URL, "1.0.0", -4.0, "")}, "clocks_differ", {"offset": -4.0}),
        ({"certificate": Certificate("c", "2026-03-04", 3 * DAY)}, "certificate_ends", {}),
        ({"certificate": Certificate("c", "2026-02-26", -3 * DAY)}, "certificate_ends", {}),
        ({"state_writable": False}, "store_read_only", {"folder": "/lab"}),
        ({"free_bytes": 10}, "disk_almost_full", {"free": 10}),
        ({"sandbox": {"landlock": False, "seccomp": True}}, "no_landlock", {}),
        ({"sandbox": {"landlock": True, "seccomp": False}}, "no_seccomp", {}),
    ],
)
def test_what_is_wrong_is_named_alone_with_what_to_do(change, code, values):
    (found,) = failing(**change)
    assert found.code == code
    assert {name: found.values[name] for name in values} == values
    assert found.remedy


def test_a_python_without_pybullet_is_told_which_has_it():
    (found,) = failing(python=(3, 13), modules={**WELL.modules, "pybullet": False})
    assert found.code == "module_without_wheel"
