"""Python programs of ours, which import nothing from the folder that they are started in.

`python -m` puts the current folder first on the path of imports, and an empty part of PYTHONPATH
means it, too: a `yaml.py` that lies there would run. What is started here, and what that starts
itself (joblib's workers and their tracker), has it nowhere on its path.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import mrlab_ros

SAFE_PATH = "PYTHONSAFEPATH"  # Python 3.11 and later leave the current folder out
# The same as `python -m`, without the first entry of the path.
RUN = "import sys; del sys.path[0]; import runpy; runpy._run_module_as_main(sys.argv.pop(1))"
# Forking is safe with one thread only, and the libraries draw nothing from more.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def command(module: str, *arguments: str) -> tuple[str, ...]:
    """Return the program and arguments that run a module of ours."""
    if sys.version_info >= (3, 11):
        return (sys.executable, "-P", "-m", module, *arguments)
    return (sys.executable, "-c", RUN, module, *arguments)


def keep_to_installed_modules() -> None:
    """Take the current folder off the path of this process and of all Python that it starts."""
    sys.path[:] = _absolute(sys.path)
    # Fast DDS would take its settings from the current folder, too.
    os.environ.setdefault("SKIP_DEFAULT_XML_FILE", "1")
    os.environ[SAFE_PATH] = "1"
    if "PYTHONPATH" in os.environ:
        parts = _absolute(os.environ["PYTHONPATH"].split(os.pathsep))
        os.environ["PYTHONPATH"] = os.pathsep.join(parts)


def search_path() -> str:
    """Return the PYTHONPATH by which a process from any folder finds this package and others."""
    others = _absolute(os.environ.get("PYTHONPATH", "").split(os.pathsep))
    return os.pathsep.join([str(Path(mrlab_ros.__file__).parent.parent), *others])


def _absolute(path: list[str]) -> list[str]:
    return [part for part in path if os.path.isabs(part)]
