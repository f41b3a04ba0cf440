"""What people hold in their hands: nobody who goes leaves it hanging in the air."""

from __future__ import annotations

from mrlab_ros.gateway.lab.definitions import Definitions, plain

SERVICE = "physics/move_object"
REQUEST = "mrlab_msgs/srv/MoveObject_Request"


class Hands:
    """Who holds which object, by the calls that the lab has carried out."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        # By an object: the token of the client that has it, and its last call.
        self._held: dict[str, tuple[str, bytes]] = {}

    def note(self, token: str, payload: bytes) -> None:
        """Note a MoveObject of a client, as CDR, that the lab has carried out."""
        request = self._definitions.decode(REQUEST, payload)
        if request.held:
            self._held[request.name] = token, payload
        else:
            self._held.pop(request.name, None)

    def let_go(self, token: str) -> list[bytes]:
        """Forget a client; return the calls, as CDR, by which its hands let go where they were."""
        names = [name for name, (owner, _) in self._held.items() if owner == token]
        calls = []
        for name in names:
            request = plain(self._definitions.decode(REQUEST, self._held.pop(name)[1]))
            still = {"name": name, "pose": request["pose"], "held": False}
            calls.append(self._definitions.encode(REQUEST, still))
        return calls
