"""What path, label and units say together."""

import numpy as np
import pytest
from fakes import make_model

from mrlab_ros.core.conversion.evidence.headings import name_of
from mrlab_ros.core.conversion.evidence.names import Hint
from mrlab_ros.core.conversion.workspace import Variable

VALUES = np.zeros((20, 6))


def hint(path, **facts):
    variable = Variable(path, "double", VALUES.shape, VALUES, **facts)
    return name_of(variable, "MATLAB v5 to v7", make_model(6)).hint


@pytest.mark.parametrize(
    ("path", "facts", "expected"),
    [
        ("x.Data", {}, Hint.DOUBTFUL),
        ("x.Data", {"label": "joint angles"}, Hint.POSITIONS),
        ("x.Data", {"label": "joint angles", "units": ("rad",)}, Hint.POSITIONS),
        ("x.Data", {"label": "joint angles", "units": ("deg",)}, Hint.POSITIONS),
        ("x.Data", {"units": ("rad",)}, Hint.TWO_FACED),
        ("x.Data", {"label": "motor currents"}, Hint.AGAINST),
        ("x.Data", {"units": ("m",)}, Hint.AGAINST),
        ("x.Data", {"label": "joint angles", "units": ("rad/s",)}, Hint.AGAINST),
        ("qerr.Data", {"units": ("rad",)}, Hint.DOUBTFUL),
        ("tau.Data", {"label": "joint angles", "units": ("rad",)}, Hint.AGAINST),
    ],
)
def test_label_and_units_beat_a_doubtful_name_and_no_foreign_one(path, facts, expected):
    assert hint(path, **facts) is expected
