"""Write quintic_ur5e.mat again as quintic_ur5e_v73.mat, the way MATLAB's `save -v7.3` lays it out.

GNU Octave cannot write that format, so this imitates it with h5py, after the HDF5 files that
MATLAB R2006b and later write: a user block of 512 bytes that begins with the MAT-file header
(116 bytes of text, 8 blanks, version 0x0200, the endian mark 'IM'), one HDF5 dataset a variable
with its axes reversed because MATLAB stores columns first, and on each the attribute
MATLAB_class, a fixed-length ASCII string. What MATLAB adds beyond that (chunks with gzip) is
optional to its reader. The header's text names this script instead of MATLAB.

Run it in examples/: python make_v73.py
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
from scipy.io import loadmat

USER_BLOCK = 512
TEXT = "MATLAB 7.3 MAT-file, Platform: none, written by make_v73.py HDF5 schema 1.00 ."


def header() -> bytes:
    """Return the 128 bytes of a little-endian MAT-file header of version 7.3."""
    return TEXT.ljust(116).encode("ascii") + b" " * 8 + b"\x00\x02IM"


def write_class(dataset: h5py.Dataset, name: str) -> None:
    """Attach MATLAB_class as MATLAB does: fixed length, null-terminated type, ASCII."""
    kind = h5py.h5t.C_S1.copy()
    kind.set_size(len(name))
    attribute = h5py.h5a.create(
        dataset.id, b"MATLAB_class", kind, h5py.h5s.create(h5py.h5s.SCALAR)
    )
    attribute.write(np.array(name.encode("ascii")), mtype=kind)


def write(path: Path, variables: dict[str, np.ndarray]) -> None:
    """Write real double matrices, each (rows, columns) as MATLAB's size() gives them."""
    with h5py.File(path, "w", libver="earliest", userblock_size=USER_BLOCK) as file:
        for name, matrix in variables.items():
            write_class(file.create_dataset(name, data=matrix.T.astype("<f8")), "double")
    with path.open("r+b") as raw:
        raw.write(header())


def main() -> None:
    """Convert the shipped quintic, in the current folder."""
    source = loadmat("quintic_ur5e.mat")
    write(Path("quintic_ur5e_v73.mat"), {"q": source["q"], "fs": source["fs"]})


if __name__ == "__main__":
    main()
