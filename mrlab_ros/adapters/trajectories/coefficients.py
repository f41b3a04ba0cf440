"""The coefficients of the torque proxy, read from config/torque_proxy.yaml."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.trajectory.channels import ProxyCoefficients


def load_coefficients(path: Path) -> ProxyCoefficients:
    """Read config/torque_proxy.yaml; raise BadInput that names all its mistakes."""
    return ProxyCoefficients.from_mapping(read_yaml(path))
