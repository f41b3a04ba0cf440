"""Who carries something of the scene by hand: a service says so, moves on a topic follow."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(eq=False)
class Carrier:
    """hand: an id that its client chose. sequence: of the last move that counted."""

    hand: str
    sequence: int = 0

    def follows(self, hand: str, sequence: int) -> bool:
        """Count a move; return whether it is of this hand, and newer than all before."""
        newer = hand == self.hand and sequence > self.sequence
        if newer:
            self.sequence = sequence
        return newer


def carrier(hand: str) -> Carrier | None:
    """Return the carrier of a call; None where the call names no hand."""
    return Carrier(hand) if hand else None
