"""`mrlab show` as a student runs it."""

from pathlib import Path

import numpy as np
import pytest
import scipy.io
from page_document import document_in
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW
from mrlab_ros.cli import make_app
from mrlab_ros.core.base.errors import BadInput, Misuse

ROOT = Path(__file__).parents[2]
QUINTIC = ROOT / "examples" / "quintic_ur5e.mat"


def run(*arguments: object, code: int = 0) -> str:
    done = CliRunner().invoke(make_app(), ["show", *map(str, arguments)], catch_exceptions=False)
    assert done.exit_code == code, done.output
    return done.output


def test_a_workspace_becomes_one_file(tmp_path):
    page = tmp_path / "deep" / "page.html"
    said = run(QUINTIC, "--robot", "ur5e", "--end-effector", "vacuum_cup", "-o", page)
    assert str(page) in said
    shown = document_in(page)
    assert shown["verdict"] == "accepted"
    assert shown["robot"]["end_effector"] == "vacuum_cup"
    assert page.stat().st_size < 1_000_000


def test_a_refused_file_is_shown_with_its_findings(tmp_path):
    file, page = tmp_path / "bad.mat", tmp_path / "page.html"
    q = np.full((200, 6), 0.1)
    q[100:, 2] = 5.0
    scipy.io.savemat(file, {"q": q, "fs": 100.0})
    said = run(file, "--robot", "ur5e", "-o", page, code=1)
    assert str(page) in said
    assert "rejected  bad.mat" in said
    shown = document_in(page)
    assert shown["verdict"] == "refused"
    assert ("joint_limit", "elbow_joint", 101) in {
        (found["code"], found["joint"], found["first_row"]) for found in shown["findings"]
    }
    assert "elbow_joint" in page.read_text(), "without its script the page says so, too"


def test_a_trajectory_file_knows_its_robot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    convert = ["convert", str(QUINTIC), "--robot", "ur5e", "--out", str(tmp_path)]
    assert CliRunner().invoke(make_app(), convert).exit_code == 0
    run(tmp_path / "quintic_ur5e.json")
    assert document_in(tmp_path / "quintic_ur5e.html")["robot"]["model"] == "ur5e"


def test_plot_writes_the_page(tmp_path):
    page = tmp_path / "page.html"
    convert = ["convert", str(QUINTIC), "--robot", "ur5e", "--plot", str(page)]
    assert CliRunner().invoke(make_app(), convert).exit_code == 0
    assert document_in(page)["verdict"] == "accepted"


@pytest.mark.parametrize(
    ("arguments", "kind", "code"),
    [
        ((QUINTIC,), Misuse, "robot_not_named"),
        ((QUINTIC, "--robot", "ur5e", "-o", "page.pdf"), Misuse, "page_name"),
        ((QUINTIC, "--robot", "ur55e"), BadInput, "no_robot_model"),
        (("none.mat", "--robot", "ur5e"), BadInput, "missing"),
        (("none.json",), BadInput, "file_unreadable"),
    ],
)
def test_what_is_wrong_is_said(arguments, kind, code):
    with pytest.raises(kind) as caught:
        run(*arguments)
    assert caught.value.diagnostic.code == code


def test_a_file_without_a_matrix_is_refused_with_its_reason(tmp_path):
    file = tmp_path / "words.mat"
    scipy.io.savemat(file, {"note": "hello"})
    with refused(NOTHING_TO_SHOW, BadInput):
        run(file, "--robot", "ur5e", "-o", tmp_path / "page.html")
