"""The reasons for which a check did not come to its end."""

from __future__ import annotations

import json
import signal
from types import SimpleNamespace

import pytest
from refusals import refused

from mrlab_ros.classroom import worker
from mrlab_ros.classroom.diagnostics import WORKERS_DIFFER
from mrlab_ros.classroom.grader import Grader, _check_versions, fingerprint
from mrlab_ros.classroom.marks.result import FAILED, TO_REPEAT
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.classroom.setup import Setup
from mrlab_ros.core.scene.document import SceneDocument


@pytest.mark.parametrize(
    ("status", "outcome", "code"),
    [
        (None, TO_REPEAT, "submission_given_up"),
        (-signal.SIGALRM, TO_REPEAT, "submission_given_up"),
        (-signal.SIGKILL, TO_REPEAT, "submission_killed"),
        (-signal.SIGXCPU, FAILED, "submission_ended"),
        (-signal.SIGSEGV, FAILED, "submission_crashed"),
    ],
)
def test_what_ends_a_check_is_the_machines_or_the_submissions_fault(
    tmp_path, monkeypatch, status, outcome, code
):
    grader = Grader(Setup(Rubric("empty", ()), SceneDocument()), str(tmp_path))
    assert grader._lost(status)[0] == outcome
    assert grader._lost(status)[1].code == code
    if status == -signal.SIGSEGV:
        assert grader._lost(status)[1].values["why"] == "SIGSEGV"
        assert grader._lost(1)[1].values["why"] == "exit 1"
    grader.close()


class Cluster:
    """Workers of dask, that say what they have."""

    def __init__(self, **said):
        self.said = said

    def run(self, function):
        return self.said


def test_workers_of_a_changed_copy_are_noticed():
    _check_versions(Cluster(a=fingerprint(), b=fingerprint()), "tcp://x")
    with refused(WORKERS_DIFFER, workers=["b"]):
        _check_versions(Cluster(a=fingerprint(), b="another"), "tcp://x")


def test_what_fails_before_the_sandbox_is_shut_is_to_be_repeated(tmp_path, monkeypatch):
    def fails(**_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(worker.tempfile, "tempdir", None)
    monkeypatch.setattr(worker, "confine", lambda _: None)
    monkeypatch.setattr(worker.restrictions, "shut", fails)
    warm = SimpleNamespace(setup=Setup(Rubric("empty", ()), SceneDocument()), readable=())
    worker.work(warm, {"folder": str(tmp_path), "out": str(tmp_path)})
    found = json.loads((tmp_path / worker.RESULT).read_bytes())
    assert (found["outcome"], found["found"]["code"]) == (TO_REPEAT, "machine_refused")
