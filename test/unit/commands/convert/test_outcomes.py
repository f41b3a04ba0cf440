"""The exit codes of commands that convert files."""

from __future__ import annotations

import errno

import pytest

from mrlab_ros.adapters.workspaces.diagnostics import MISSING
from mrlab_ros.adapters.workspaces.results import failed_here, refused, unexpected
from mrlab_ros.commands.convert.outcomes import BADNESS, exit_code
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome


@pytest.mark.parametrize(
    ("why", "code"),
    [
        (MISSING(file="run.mat"), 1),
        (unexpected("run.mat", ZeroDivisionError("division by zero")), 3),
        (failed_here("run.mat", OSError(errno.EMFILE, "too many open files")), 3),
        (failed_here("run.mat", OSError(errno.ENOSPC, "no space left")), 1),
    ],
)
def test_a_fault_of_the_converter_is_no_verdict_on_the_file(why: Diagnostic, code: int) -> None:
    assert exit_code(refused("run.mat", why)) == code


def test_an_open_choice_is_2_and_less_bad_than_a_refusal() -> None:
    result = ConversionResult("run.mat", Outcome.AMBIGUOUS, None, (), (MISSING(file="run.mat"),))
    assert exit_code(result) == 2
    assert max([2, 1, 0], key=BADNESS.index) == 1
