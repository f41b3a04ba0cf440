"""Each fact that keeps a lab from working is named, with what to do; nothing else is."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mrlab_ros.core.doctor import NEEDED, Certificate, Facts, Gateway, Port, examine

DAY = 24 * 3600.0
URL = "https://lab:8080"
WELL = Facts(
    python=(3, 11),
    modules={**dict.fromkeys(NEEDED, True), "pybullet": True},
    middleware="",
    middlewares=["rmw_fastrtps_cpp"],
    multicast="",
    pages=True,
    version="1.0.0",
    ports=[Port(8080, "pages", free=False, ours=True), Port(7447, "zenoh", free=True, ours=False)],
    gateway=Gateway(URL, "1.0.0", 0.0, ""),
    certificate=Certificate("lab.crt", "2026-05-30", 90 * DAY),
    state_dir="/lab",
    state_writable=True,
    free_bytes=50_000_000_000,
)


def failing(**change: object) -> dict[str, str]:
    """Return name -> finding and remedy of what is not well."""
    facts = replace(WELL, **change)
    return {each.name: f"{each.found} | {each.remedy}" for each in examine(facts) if not each.ok}


def test_a_machine_that_is_well_has_nothing_to_do():
    findings = list(examine(WELL))
    assert len(findings) > 10
    assert all(finding.ok and not finding.remedy and finding.found for finding in findings)


@pytest.mark.parametrize(
    ("change", "name", "says"),
    [
        ({"python": (3, 14)}, "python", "3.11"),
        ({"python": (3, 9)}, "python", "3.11"),
        ({"modules": {**WELL.modules, "zenoh": False}}, "wheels", "zenoh"),
        ({"modules": {**WELL.modules, "pybullet": False}}, "pybullet", "without physics"),
        ({"middlewares": []}, "middleware", "make demo"),
        ({"middleware": "rmw_zenoh_cpp"}, "middleware", "unset RMW_IMPLEMENTATION"),
        ({"multicast": "timed out"}, "multicast", "LOCALHOST"),
        ({"pages": False}, "pages", "npm run build"),
        ({"ports": [Port(8080, "pages", False, False)]}, "port 8080", "--http"),
        ({"ports": [Port(7447, "zenoh", False, False)]}, "port 7447", "--zenoh-listen"),
        ({"gateway": Gateway(URL, "", None, "refused")}, "gateway", "mrlab up"),
        ({"gateway": Gateway(URL, "0.9", 0.0, "")}, "gateway", "one version"),
        ({"gateway": Gateway(URL, "1.0.0", -4.0, "")}, "clocks", "-4.0 s"),
        ({"certificate": Certificate("c", "2026-03-04", 3 * DAY)}, "certificate", "keys renew"),
        ({"certificate": Certificate("c", "2026-02-26", -3 * DAY)}, "certificate", "keys renew"),
        ({"state_writable": False}, "store", "--state-dir"),
        ({"free_bytes": 10}, "disk", "GB"),
    ],
)
def test_what_is_wrong_is_named_alone_with_what_to_do(change, name, says):
    found = failing(**change)
    assert list(found) == [name]
    assert says in found[name]
    assert not found[name].endswith("| ")


def test_a_python_without_pybullet_is_told_which_has_it():
    found = failing(python=(3, 13), modules={**WELL.modules, "pybullet": False})
    assert "3.10 or 3.11" in found["pybullet"]
