"""Which messages are of this lab: a ROS domain may hold one of another user or machine too."""

from __future__ import annotations

import re
from collections.abc import Callable


class Identity:
    """The id of this lab, and those of others that were met. log: takes a sentence for each.

    Without an id, in the graph of a single node for instance, every message is of this lab; so is
    one that names none.
    """

    def __init__(self, lab: str, log: Callable[[str], None]) -> None:
        self.lab = lab
        self._log = log
        self.others: set[str] = set()

    @property
    def namespace(self) -> str:
        """What a name in the graph ends with that another lab must not have; may be empty."""
        return f"/lab_{re.sub('[^0-9A-Za-z]', '', self.lab)}" if self.lab else ""

    def accepts(self, lab: str) -> bool:
        """Return whether a message that names `lab` is of this one."""
        if not lab or not self.lab or lab == self.lab:
            return True
        if lab not in self.others:
            self.others.add(lab)
            self._log(self.sentence(lab))
        return False

    def sentence(self, lab: str) -> str:
        """Return what to say of another lab."""
        return (
            f"another lab ({lab}) is on this ROS domain; this one ({self.lab}) ignores it. Give "
            "one of them another ROS_DOMAIN_ID"
        )
