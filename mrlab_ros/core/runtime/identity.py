"""Which messages are of this lab: a ROS domain may hold one of another user or machine too."""

from __future__ import annotations

import re
from collections.abc import Callable

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.diagnostics import LAB_WITHOUT_ID, OTHER_LAB, SHARED_SERVICE


class Identity:
    """The id of this lab, and those of others that were met. log: takes what to say of each.

    Without an id, in the graph of a single node for instance, every message is of this lab; so is
    one that names none, but for lists of what the lab consists of.
    """

    def __init__(self, lab: str, log: Callable[[Diagnostic], None]) -> None:
        self.lab = lab
        self._log = log
        self.others: set[str] = set()

    @property
    def namespace(self) -> str:
        """Return the end of names in the graph that are this lab's alone; may be empty."""
        return f"/lab_{re.sub('[^0-9A-Za-z]', '', self.lab)}" if self.lab else ""

    def accepts(self, lab: str) -> bool:
        """Return whether a message that names `lab` is of this one."""
        if not lab or not self.lab or lab == self.lab:
            return True
        if lab not in self.others:
            self.others.add(lab)
            self._log(OTHER_LAB(other_lab=lab, lab=self.lab))
        return False

    def obeys(self, lab: str) -> bool:
        """Return whether a list that names `lab`, such as its robots, says what this one is.

        A node named lab that was started by hand has no id: its empty list would remove all
        robots.
        """
        if self.lab and not lab:
            if lab not in self.others:
                self.others.add(lab)
                self._log(LAB_WITHOUT_ID(lab=self.lab))
            return False
        return self.accepts(lab)


# A coordinator that met another lab names its systems once a second; a lab that has said nothing
# for longer is gone, s.
PRESENT_S = 5.0


class Neighbours:
    """Other labs that are on this ROS domain now.

    lab: the id of this one; without one there are no others.
    """

    def __init__(self, lab: str) -> None:
        self._lab = lab
        self._seen: dict[str, float] = {}

    def notice(self, lab: str, now: float) -> None:
        """Take a sign of life of `lab`. now: s of any clock that never goes back."""
        if self._lab and lab and lab != self._lab:
            self._seen[lab] = now

    def why_not(self, service: str, servers: int, now: float) -> Diagnostic | None:
        """Return why a call that moves something would reach another lab, too; None: it won't."""
        if servers < 2:
            return None
        present = [lab for lab, seen in self._seen.items() if now - seen < PRESENT_S]
        return SHARED_SERVICE(service=service, labs=present) if present else None
