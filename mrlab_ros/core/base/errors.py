"""The errors of the lab: each text says what was found, what was expected, what to do next."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Diagnostic, of_text
from mrlab_ros.core.base.foreign_text import visible_lines


class LabError(Exception):
    """Base of every error that the lab raises on purpose.

    diagnostic: its code and values; its text, for a person, is that of the error. What it names
    may come from a file: nothing in it acts on a terminal.
    """

    def __init__(self, what: Diagnostic | str = "") -> None:
        self.diagnostic = what if isinstance(what, Diagnostic) else of_text(visible_lines(what))
        super().__init__(visible_lines(str(what)))


class BadInput(LabError):
    """Something from outside (a file, a request) is not what it must be."""


class Unavailable(BadInput):
    """An input names something that is in use or out of reach now; it may work a moment later."""


class Misuse(LabError):
    """A call that the present state does not allow; nothing was changed."""


class WrongUsage(Misuse):
    """Arguments that name nothing there is, contradict each other or are out of range."""


class Unreached(LabError):
    """No answer came in time; the request may have been carried out or not."""


class IllegalEvent(Misuse):
    """A state machine was asked for an event that its present state does not know."""
