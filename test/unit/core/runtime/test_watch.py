"""Who is silent, who reports it, and what a restarted process says."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Severity, of_text
from mrlab_ros.core.runtime.watch import Sign, Watch
from mrlab_ros.core.systems.diagnostics import SYSTEM_LOST

LOST, FULL = SYSTEM_LOST(system="cell"), of_text("the disk is full")


def heard(watch: Watch, **ages: float) -> Watch:
    for process, age in ages.items():
        watch.hear(process, 100.0 - age)
    return watch


def test_a_silent_process_is_named_with_its_age():
    watch = heard(Watch("bridge"), lab=0.5, playback=3.5)
    assert watch.silent(100.0) == {"playback": 3.5}
    assert heard(watch, playback=0.0).silent(100.0) == {}


def test_only_the_first_of_the_living_reports():
    assert heard(Watch("playback"), lab=0.5, physics=9.0).silent(100.0) == {}
    assert heard(Watch("lab"), playback=0.5, physics=9.0).silent(100.0) == {"physics": 9.0}
    assert heard(Watch("physics"), lab=4.0, playback=0.1).silent(100.0) == {"lab": 4.0}


def test_what_is_long_gone_is_forgotten():
    assert heard(Watch("lab"), playback=61.0).silent(100.0) == {}


def test_a_restarted_process_says_how_it_ended_and_what_was_lost():
    assert Sign("lab").trouble(5.0) is None
    sign = Sign("lab", 1, "SIGKILL")
    died = sign.trouble(5.0)
    assert (died.code, dict(died.values)) == ("died", {"last_exit": "SIGKILL", "ago": 5})
    assert sign.trouble(61.0) is None
    sign = Sign("lab", 1, "SIGKILL", (LOST,))
    died = sign.trouble(5.0)
    assert (died.code, died.values["lost"]) == ("died_and_lost", LOST)
    assert sign.trouble(61.0) == LOST


def test_nothing_is_called_unlost_before_it_is_known():
    sign = Sign("recorder", 1, "SIGKILL", None)
    assert sign.trouble(5.0).code == "died_and_looks"
    assert Sign("recorder", lost=None).trouble(5.0) is None


def test_what_failed_since_comes_before_what_was_lost():
    sign = Sign("recorder", 1, "SIGKILL", (LOST,), (FULL,))
    both = sign.trouble(61.0)
    assert (both.code, both.severity) == ("and_also", Severity.ERROR)
    assert (both.values["first"], both.values["then"]) == (FULL, LOST)
    both = sign.trouble(5.0)
    assert (both.values["first"], both.values["then"].code) == (FULL, "died_and_lost")


def test_a_process_that_did_not_run_blames_nobody_for_what_it_missed_and_says_so():
    watch = Watch("lab")
    watch.look(95.0)
    watch.hear("playback", 95.5)
    watch.hear("physics", 92.6)
    # From 95.8 to 99.8.
    watch.look(99.8)
    assert watch.silent(99.8) == {}
    freeze = watch.freeze(102.8)
    assert freeze is not None
    sign = Sign("lab", freeze=freeze)
    frozen = sign.trouble(500.0)
    assert (frozen.code, dict(frozen.values)) == ("did_not_run", {"frozen": 4, "ago": 3})
    # One that is silent still is reported as ever.
    for now in (100.8, 101.8, 102.8, 103.8):
        watch.look(now)
        watch.hear("playback", now)
    assert watch.silent(103.8).keys() == {"physics"}
    assert watch.freeze(160.0) is None


def test_a_process_that_runs_late_for_a_moment_was_not_frozen():
    watch = Watch("lab")
    for now in (95.0, 96.9, 99.1):
        watch.look(now)
    assert watch.freeze(99.1) is None


def test_what_a_process_said_when_it_woke_is_no_older_for_its_freeze():
    watch = Watch("lab")
    watch.look(90.0)
    watch.hear("playback", 99.0)
    watch.look(99.0)
    assert watch.silent(101.0) == {}
    assert watch.silent(102.5).keys() == {"playback"}
