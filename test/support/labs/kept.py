"""Puts trajectories into a converter's catalogue and reads them, without the graph."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles
from mrlab_ros.core.trajectory.trajectory import Trajectory


class Kept:
    """A catalogue and the files of its versions."""

    def __init__(self, catalogue: CatalogueWriter, files: TrajectoryFiles) -> None:
        self.catalogue, self.files = catalogue, files

    @classmethod
    def opened(cls, state_dir: Path) -> Kept:
        """Open the store of a state folder whose lab does not run."""
        store = open_store(str(state_dir / "store"))
        catalogue = CatalogueWriter(store)
        catalogue.open()
        return cls(catalogue, TrajectoryFiles(store, state_dir / "fetched"))

    def save(self, trajectory: Trajectory, *, shared: bool = False) -> Path:
        """Publish a trajectory under its id; return the file that holds it."""
        _, version = self.catalogue.save(trajectory, shared=shared)
        return self.files.path(version)

    def load(self, text: str) -> Trajectory:
        return self.files.load(*self.catalogue.find(text))

    def ids(self) -> list[str]:
        return [record.id for record in self.catalogue.records() if not record.deleted_ns]
