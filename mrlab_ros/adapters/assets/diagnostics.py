"""Diagnostics of assets: the meshes, pictures and documents that clients read."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import WARNING, Code

NO_ASSET = Code(
    "no_asset",
    "There is no asset {asset}; {documents:list} say what there is.",
    meaning="A file that clients cannot read, or that is not there.",
)
MODEL_LEFT_OUT = Code(
    "model_left_out",
    "Robot '{robot}' is left out: {why:problem}.",
    severity=WARNING,
    meaning="The files of a robot are damaged; the others are listed.",
)
