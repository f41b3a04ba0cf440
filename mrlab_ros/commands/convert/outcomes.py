"""The exit codes of commands that convert files."""

from __future__ import annotations

from mrlab_ros.core.conversion.convert import Outcome

EXIT_CODES = {Outcome.ACCEPTED: 0, Outcome.REJECTED: 1, Outcome.AMBIGUOUS: 2}
