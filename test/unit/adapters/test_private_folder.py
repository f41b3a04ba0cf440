"""A folder of a known name is relied on only where nobody else can put another in its place."""

from __future__ import annotations

import pytest

from mrlab_ros.adapters import private_folder
from mrlab_ros.adapters.diagnostics import NOT_A_FOLDER, OTHERS_EXCHANGE, OTHERS_WRITE


@pytest.fixture
def home(tmp_path):
    folder = tmp_path / "above" / "middle"
    folder.mkdir(parents=True)
    return folder


def test_what_is_ones_own_all_the_way_is_relied_on(home):
    assert private_folder.why_not(home / "run") is None
    private_folder.make(home / "run")
    assert private_folder.why_not(home / "run") is None


@pytest.mark.parametrize("above", [0, 1])
def test_a_folder_above_that_others_can_change_is_none(home, above):
    (home, home.parent)[above].chmod(0o777)
    found = private_folder.why_not(home / "run")
    assert found is not None
    assert found.code == OTHERS_EXCHANGE.code


def test_a_sticky_folder_above_lets_nobody_exchange_it(home):
    home.parent.chmod(0o1777)
    assert private_folder.why_not(home / "run") is None


@pytest.mark.parametrize("kind", ["link", "file", "open"])
def test_what_stands_there_already(home, kind):
    run = home / "run"
    if kind == "open":
        run.mkdir()
        run.chmod(0o777)
    elif kind == "link":
        run.symlink_to(home)
    else:
        run.touch()
    found = private_folder.why_not(run)
    assert found is not None
    assert found.code == (OTHERS_WRITE if kind == "open" else NOT_A_FOLDER).code
