"""Precedence over other work: what is asked for, and what is said of it."""

from __future__ import annotations

import os

import pytest

from mrlab_ros.ros import priority


def refuse(*arguments):
    raise PermissionError


@pytest.fixture
def asked(monkeypatch):
    """Record what is asked for in place of the kernel."""
    calls = []
    monkeypatch.setattr(os, "sched_setscheduler", lambda *a: calls.append(a))
    monkeypatch.setattr(os, "setpriority", lambda *a: calls.append(a))
    return calls


def test_round_robin_is_asked_for_first_and_not_inherited(asked):
    assert priority.take_precedence() == "SCHED_RR 10"
    ((_, policy, parameter),) = asked
    assert policy == os.SCHED_RR | os.SCHED_RESET_ON_FORK
    assert parameter.sched_priority == 10


def test_a_nice_level_is_asked_for_where_round_robin_is_not_permitted(asked, monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    assert priority.take_precedence() == "nice -10"
    assert len(asked) == 1


def test_a_thread_that_gets_neither_says_so(monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    monkeypatch.setattr(os, "setpriority", refuse)
    assert priority.take_precedence().startswith("ordinary priority")
