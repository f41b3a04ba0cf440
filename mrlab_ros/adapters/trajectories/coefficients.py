"""The coefficients of the torque proxy, read from config/torque_proxy.yaml."""

from __future__ import annotations

from pathlib import Path

import yaml

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.trajectory.channels import ProxyCoefficients


def load_coefficients(path: Path) -> ProxyCoefficients:
    """Read config/torque_proxy.yaml; raise BadInput where it is wrong."""
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(f"{path.name} cannot be read: {error}; restore config/") from None
    if not isinstance(values, dict):
        raise BadInput(f"{path.name} holds {values!r}; expected the coefficients by name")
    return ProxyCoefficients.from_mapping(values)
