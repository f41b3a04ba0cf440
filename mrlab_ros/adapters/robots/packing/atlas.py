"""One picture a robot: the colours of its materials, and below them what is drawn on its links.

The top band has a column a material, the band below it is white. Drawings stand in rows under
both, each with a rim of its background, on a grid on which the picture of the finish is as sharp.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from mrlab_ros.adapters.robots.packing.surfaces import Material
from mrlab_ros.core.base.geometry import Array

BAND = 8  # pixels, of either band and of the grid
RIM = 4  # pixels about a drawing


@dataclass(frozen=True, eq=False)
class Drawing:
    """What is drawn on a link: pixels (H, W, 3), sRGB, and the material whose finish it has."""

    pixels: Array
    material: Material


class Atlas:
    """Drawings and colours in one square picture. Raises ValueError where they do not fit."""

    def __init__(
        self, palette: Sequence[Material], drawings: Sequence[Drawing], size: int
    ) -> None:
        self.palette = list(palette)
        self.drawings = list(drawings)
        self.size = size if drawings else 0
        self.corners = self._packed() if drawings else []

    @property
    def band(self) -> float:
        """The share of the height that is the band of colours."""
        return BAND / self.size if self.drawings else 1.0

    @property
    def white(self) -> tuple[float, float]:
        """A texture coordinate of white."""
        return (0.5, 1.5 * BAND / self.size)

    def of_material(self, name: str) -> tuple[float, float]:
        """Return the texture coordinate of a material's colour."""
        number = [each.name for each in self.palette].index(name)
        return ((number + 0.5) / len(self.palette), self.band / 2)

    def place(self, number: int) -> tuple[float, float, float, float]:
        """Return the texture coordinates of a drawing: left, top, right, bottom."""
        x, y = self.corners[number]
        height, width = self.drawings[number].pixels.shape[:2]
        return (x / self.size, y / self.size, (x + width) / self.size, (y + height) / self.size)

    def finish(self, number: int) -> int:
        """Return the number in the palette of a drawing's finish."""
        names = [each.name for each in self.palette]
        return names.index(self.drawings[number].material.name)

    def colours(self) -> bytes:
        """Return the picture of the colours, PNG."""
        row = np.array([[round(v * 255) for v in each.colour] for each in self.palette])
        if not self.drawings:
            return _png(row[None].astype(np.uint8))
        picture = np.full((self.size, self.size, 3), 255, dtype=np.uint8)
        picture[:BAND] = row[self._columns()]
        for (x, y), drawing in zip(self.corners, self.drawings, strict=True):
            rim = np.pad(drawing.pixels, ((RIM, RIM), (RIM, RIM), (0, 0)), mode="edge")
            picture[y - RIM : y - RIM + rim.shape[0], x - RIM : x - RIM + rim.shape[1]] = rim
        return _png(picture)

    def finishes(self) -> bytes:
        """Return the picture of roughness and metalness, green and blue, PNG."""
        row = np.array(
            [[0, round(m.roughness * 255), round(m.metalness * 255)] for m in self.palette],
            dtype=np.uint8,
        )
        if not self.drawings:
            return _png(row[None])
        picture = np.zeros((self.size // BAND, self.size // BAND, 3), dtype=np.uint8)
        picture[0] = row[self._columns()[BAND // 2 :: BAND]]
        for number, ((x, y), drawing) in enumerate(zip(self.corners, self.drawings, strict=True)):
            height, width = drawing.pixels.shape[:2]
            low_x, low_y = (x - RIM) // BAND, (y - RIM) // BAND
            high_x, high_y = -(-(x + width + RIM) // BAND), -(-(y + height + RIM) // BAND)
            picture[low_y:high_y, low_x:high_x] = row[self.finish(number)]
        return _png(picture)

    def _columns(self) -> Array:
        """Return the material of each column of pixels, (size,)."""
        count = len(self.palette)
        return np.minimum((np.arange(self.size) + 0.5) / self.size * count, count - 1).astype(int)

    def _packed(self) -> list[tuple[int, int]]:
        """Return the left upper pixel of each drawing: rows, the highest drawings first.

        Drawings that are alike are there once.
        """
        keys = [(each.pixels.tobytes(), each.material.name) for each in self.drawings]
        corners: dict[tuple[bytes, str], tuple[int, int]] = {}
        x, y, high = 0, 2 * BAND, 0
        for number in sorted(range(len(keys)), key=lambda n: -self.drawings[n].pixels.shape[0]):
            if keys[number] in corners:
                continue
            height, width = (
                -(-(length + 2 * RIM) // BAND) * BAND
                for length in self.drawings[number].pixels.shape[:2]
            )
            if x + width > self.size:
                x, y, high = 0, y + high, 0
            if x + width > self.size or y + height > self.size:
                raise ValueError(
                    f"{len(self.drawings)} drawings do not fit into {self.size} x {self.size} "
                    "pixels; draw them smaller"
                )
            corners[keys[number]] = (x + RIM, y + RIM)
            x, high = x + width, max(high, height)
        return [corners[key] for key in keys]


def _png(pixels: NDArray[np.uint8]) -> bytes:
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, "PNG", optimize=True)
    return out.getvalue()
