"""The numbers of what a reader finds, for sinks of tests."""

import numpy as np


def matrix(found):
    """Return the numbers of a variable in MATLAB's orientation, or None where it has none."""
    if found.data is None:
        return None
    return np.frombuffer(bytes(found.data), found.dtype).reshape(found.shape, order="F")
