"""The layers of docs/architecture.md, read from the imports in the sources."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "mrlab_ros"
CORE = sorted((PACKAGE / "core").rglob("*.py"))
ADAPTERS = sorted((PACKAGE / "adapters").rglob("*.py"))
# The graph. Not ament_index_python: it finds installed files and knows no node.
GRAPH = {
    "builtin_interfaces",
    "geometry_msgs",
    "launch",
    "launch_ros",
    "mrlab_msgs",
    "rcl_interfaces",
    "rclpy",
    "rosidl_runtime_py",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "tf2_msgs",
    "trajectory_msgs",
}


def imports(source: str, package: str) -> set[str]:
    """Return the absolute names of all modules that `source` imports, wherever it does so.

    package: the package that the source lies in; relative imports are resolved against it.
    """
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*above, node.module or ""] if node.level else [node.module or ""])
            base = base.strip(".")
            names.update(f"{base}.{alias.name}" for alias in node.names)
    return names


def imports_of(path: Path) -> set[str]:
    package = ".".join(path.relative_to(PACKAGE.parent).parent.parts)
    return imports(path.read_text(), package)


def within(name: str, package: str) -> bool:
    return name == package or name.startswith(package + ".")


@pytest.mark.parametrize("path", CORE, ids=lambda path: path.stem)
def test_core_imports_only_the_standard_library_numpy_and_itself(path: Path) -> None:
    foreign = {
        name
        for name in imports_of(path)
        if not within(name, "mrlab_ros.core")
        and name.split(".")[0] not in {*sys.stdlib_module_names, "numpy"}
    }
    assert not foreign


@pytest.mark.parametrize("path", CORE, ids=lambda path: path.stem)
def test_core_neither_reads_a_clock_nor_logs(path: Path) -> None:
    clocks = {"time", "datetime", "logging", "asyncio", "threading", "subprocess", "socket"}
    assert not {name for name in imports_of(path) if name.split(".")[0] in clocks}


@pytest.mark.parametrize("path", ADAPTERS, ids=lambda path: path.stem)
def test_adapters_know_no_node_and_nothing_above_them(path: Path) -> None:
    names = imports_of(path)
    assert not {name for name in names if name.split(".")[0] in GRAPH}
    assert not {
        name
        for name in names
        if name.startswith("mrlab_ros.")
        and not within(name, "mrlab_ros.core")
        and not within(name, "mrlab_ros.adapters")
    }


def test_every_layer_has_sources() -> None:
    assert len(CORE) > 5
    assert len(ADAPTERS) > 1


def test_imports_are_found_in_every_form() -> None:
    source = (
        "import a.b\nimport c as d\nfrom e import f\nfrom . import g\nfrom ..h import i\n"
        "def k():\n    import rclpy\n"
    )
    assert imports(source, "mrlab_ros.core") == {
        "a.b", "c", "e.f", "mrlab_ros.core.g", "mrlab_ros.h.i", "rclpy",
    }  # fmt: skip
