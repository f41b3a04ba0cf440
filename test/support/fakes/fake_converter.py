"""The converter's services on a FakeLab, over a real catalogue in the gateway's store."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from fake_lab import FakeLab
from small_lab import make

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import ObjectStore
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.trajectory.catalogue import TrajectoryName
from mrlab_ros.core.trajectory.document import metadata

SERVICES = {
    "convert": "ConvertTrajectory",
    "publish": "PublishTrajectory",
    "share": "ShareTrajectory",
    "delete": "Remove",
    "restore": "RestoreTrajectory",
}
REJECTED, ACCEPTED = 0, 1
HEAD = metadata(make("ur5e", "pick"))


class FakeConverter:
    """Takes every file whose bytes begin with `good` as a motion, and refuses the others."""

    def __init__(self, lab: FakeLab, store: ObjectStore) -> None:
        self.store = store
        self.catalogue = CatalogueWriter(store)
        self.catalogue.open()
        for name, kind in SERVICES.items():
            lab.serve(f"converter/{name}", f"mrlab_msgs/srv/{kind}", self._answer(name))

    def _answer(self, name: str) -> Any:
        def answer(request: Any) -> dict[str, Any]:
            try:
                return {"success": True, **getattr(self, name)(request)}
            except LabError as error:
                return {"success": False, "message": str(error)}

        return answer

    def convert(self, request: Any) -> dict[str, Any]:
        data = self.store.get(request.upload)
        file = keys.name_of(request.upload.rsplit("/", 1)[1])
        if not data.startswith(b"good"):
            rows = np.arange(1, 6, dtype=np.uint32)
            finding = {"severity": 2, "code": "joint_limit", "message": "too far", "value": 4.0,
                       "limit": float("nan"), "first_row": 2, "last_row": 3,
                       "fixes": [{"option": "units", "value": "deg"}]}  # fmt: skip
            values = np.full(30, np.nan, np.float32)
            values[:6] = 1
            return {
                "success": False,
                "outcome": REJECTED,
                "message": f"{file} was refused",
                "diagnostics": [finding],
                "preview": {"variable": "q", "rows": rows, "columns": 6, "values": values},
            }
        trajectory = make("ur5e", request.id or "pick")
        made = io.BytesIO()
        npz_file.write(trajectory, made)
        self.store.put(request.draft, made.getvalue())
        info = {"id": trajectory.id, "robot_model": "ur5e", "source_file": file,
                "frame_rate": 100.0, "frame_count": trajectory.frame_count,
                "owner": request.owner}  # fmt: skip
        note = {"severity": 1, "code": "rate", "message": "100 Hz was taken"}
        return {"outcome": ACCEPTED, "message": "taken", "trajectory": info, "diagnostics": [note]}

    def publish(self, request: Any) -> dict[str, Any]:
        name = TrajectoryName(request.owner, request.id.rsplit("/", 1)[-1] or "pick")
        head = {**HEAD, "id": name.name}
        record, version = self.catalogue.publish(name, head, request.draft, shared=request.shared)
        return {"trajectory": {"id": record.id, "version": version.number}}

    def share(self, request: Any) -> dict[str, Any]:
        self.catalogue.share(request.id, request.shared)
        return {}

    def delete(self, request: Any) -> dict[str, Any]:
        self.catalogue.delete(request.name)
        return {}

    def restore(self, request: Any) -> dict[str, Any]:
        record = self.catalogue.restore(request.id, request.version)
        return {"trajectory": {"id": record.id, "version": record.newest.number}}
