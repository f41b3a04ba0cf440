"""What ROS's own tools read of the package: rosdep keys, tests for colcon, hidden nodes."""

from __future__ import annotations

import ast
import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from colcon_core.package_descriptor import PackageDescriptor
from colcon_core.task.python import get_setup_data
from colcon_core.task.python.test import has_test_dependency

import mrlab_ros

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "mrlab_ros").rglob("*.py"))

# Keys with a rule for Ubuntu 24.04 in rosdistro's rosdep/base.yaml and rosdep/python.yaml.
# As of 22 August 2026.
ROSDEP_KEYS = {
    "liburdfdom-tools",
    "octave",
    "python3-cryptography",
    "python3-h5py",
    "python3-httpx",
    "python3-hypothesis",
    "python3-joblib",
    "python3-jsonschema",
    "python3-matplotlib",
    "python3-numpy",
    "python3-orjson",
    "python3-pil",
    "python3-psutil",
    "python3-pytest",
    "python3-pytest-timeout",
    "python3-pytest-xdist",
    "python3-rich",
    "python3-rosbags-pip",
    "python3-scipy",
    "python3-segno",
    "python3-trimesh-pip",
    "python3-typer",
    "python3-yaml",
    "python3-yourdfpy-pip",
}
# Packages of Jazzy's distribution.yaml.
DISTRIBUTION = {
    "action_msgs",
    "ament_index_python",
    "builtin_interfaces",
    "control_msgs",
    "controller_manager_msgs",
    "diagnostic_msgs",
    "domain_coordinator",
    "geometry_msgs",
    "launch",
    "launch_ros",
    "rcl_interfaces",
    "rclpy",
    "robot_state_publisher",
    "rosgraph_msgs",
    "rosidl_parser",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "tf2_msgs",
    "trajectory_msgs",
    "visualization_msgs",
    "xacro",
}
OURS = {"mrlab_msgs"}


@cache
def nodes(path: Path) -> tuple[ast.AST, ...]:
    """Return the calls and imports of a source file."""
    kinds = (ast.Call, ast.Import, ast.ImportFrom)
    return tuple(n for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, kinds))


def dependencies() -> set[str]:
    root = ET.parse(ROOT / "package.xml").getroot()
    return {e.text or "" for e in root if e.tag.endswith("depend")}


def test_rosdep_knows_what_the_package_depends_on() -> None:
    assert dependencies() - OURS <= ROSDEP_KEYS | DISTRIBUTION


def test_the_packages_of_messages_that_are_imported_are_named() -> None:
    imported = {
        (node.module or "").partition(".")[0]
        for path in SOURCES
        for node in nodes(path)
        if isinstance(node, ast.ImportFrom)
    }
    messages = {name for name in imported if name.endswith("_msgs") or name == "rcl_interfaces"}
    assert messages <= dependencies()


def test_colcon_finds_the_tests() -> None:
    package = PackageDescriptor(ROOT)
    package.metadata["get_python_setup_options"] = lambda env: setup_options()
    assert has_test_dependency(get_setup_data(package, {}), "pytest")


def setup_options() -> dict[str, object]:
    """Return what setup.py says, as far as it is written down."""
    calls = (n for n in ast.walk(ast.parse((ROOT / "setup.py").read_text())))
    call = next(n for n in calls if isinstance(n, ast.Call) and ast.unparse(n.func) == "setup")
    found = {}
    for keyword in call.keywords:
        try:
            found[str(keyword.arg)] = ast.literal_eval(keyword.value)
        except ValueError:
            continue
    return found


def bare_nodes() -> Iterator[tuple[str, str]]:
    """Yield file and name of each node without parameter services."""
    for path in SOURCES:
        for call in nodes(path):
            if isinstance(call, ast.Call) and any(
                k.arg == "start_parameter_services" for k in call.keywords
            ):
                yield path.name, ast.unparse(call.args[0]).removeprefix("f").strip("'\"")
            if isinstance(call, ast.Call) and ast.unparse(call.func) == "HiddenNode":
                yield path.name, ast.unparse(call.args[0]).removeprefix("f").strip("'\"")


def test_a_node_without_parameters_is_hidden() -> None:
    """`ros2 param list` waits 5 s for each visible node that has none."""
    found = list(bare_nodes())
    assert found
    shown = [(file, name) for file, name in found if not name.startswith("_")]
    assert shown == [("node.py", "name")], "HiddenNode alone takes its name from its callers"


def test_type_checkers_find_the_types_of_the_python_api() -> None:
    assert (ROOT / "mrlab_ros" / "py.typed").is_file()
    assert 'package_data={package_name: ["py.typed"]' in (ROOT / "setup.py").read_text()


def test_the_python_api_is_imported_by_its_names() -> None:
    assert {*mrlab_ros.__all__} == {*mrlab_ros._MODULES, "__version__"}
    for name in mrlab_ros.__all__:
        assert getattr(mrlab_ros, name), name
    with pytest.raises(AttributeError, match="no attribute 'Labb'"):
        _ = mrlab_ros.Labb  # type: ignore[attr-defined]


def test_all_parts_have_the_version_of_the_package() -> None:
    found = {
        path: re.findall("<version>(.+)</version>", (ROOT / path).read_text())
        for path in ("package.xml", "msg_schemas/package.xml")
    }
    client = "clients/python/pyproject.toml"
    found[client] = re.findall('^version = "(.+)"', (ROOT / client).read_text(), re.M)
    for path in ("web/package.json", "web/package-lock.json"):
        found[path] = [json.loads((ROOT / path).read_text())["version"]]
    assert found == {path: [mrlab_ros.__version__] for path in found}
    assert re.fullmatch(r"\d+\.\d+\.\d+", mrlab_ros.__version__)


def third_party() -> set[str]:
    """Return the packages of the lock file that the sources import."""
    imported = {
        name.partition(".")[0]
        for path in SOURCES
        for node in nodes(path)
        if isinstance(node, (ast.Import, ast.ImportFrom)) and not getattr(node, "level", 0)
        for name in ([node.module] if isinstance(node, ast.ImportFrom) else names_of(node))
        if name
    }
    modules = {
        "PIL": "pillow",
        "argon2": "argon2-cffi",
        "matio": "mat-io",
        "yaml": "pyyaml",
        "zenoh": "eclipse-zenoh",
    }
    return {modules.get(name, name) for name in imported} & LOCKED - BROUGHT_ALONG


def test_what_pip_installs_with_a_wheel_is_what_the_package_imports() -> None:
    """The last part of requirements.in, which setup.py reads."""
    part = (ROOT / "requirements.in").read_text().partition("# the lab itself")[2]
    assert third_party() <= set(re.findall(r"^([a-z0-9_-]+)", part, re.M))


def test_a_ros_machine_gets_what_the_package_imports() -> None:
    by_pip = set(re.findall(r"^([a-z0-9_-]+)", (ROOT / "requirements-ros.in").read_text(), re.M))
    by_rosdep = {re.sub("^python3-|-pip$", "", key) for key in dependencies()}
    by_rosdep |= {"pyyaml"} if "yaml" in by_rosdep else set()
    # mat-io is nowhere on Jazzy; docs/dependencies.md says why.
    assert third_party() <= by_pip | by_rosdep | {"mat-io"}


def required() -> list[str]:
    """The names of all packages that set-up, checks, site and pages ask for."""
    names = []
    for file in ("requirements.in", "requirements-dev.in", "requirements-docs.in"):
        names += re.findall(r"^([A-Za-z][\w-]*)", (ROOT / file).read_text(), re.M)
    pages = json.loads((ROOT / "web/package.json").read_text())
    return [*names, *pages["dependencies"], *pages["devDependencies"]]


def test_each_required_package_has_its_reason() -> None:
    """A row names a family once, and the others of it by their ends: `-gtest`."""
    page = (ROOT / "docs/dependencies.md").read_text()
    rows = re.findall(r"^\| (`[^|]*)\|", page, re.M)
    named = {re.split(r"[<\[]", word)[0] for row in rows for word in re.findall(r"`([^`]+)`", row)}
    ends = tuple(word for word in named if word[0] == "-")
    assert [name for name in required() if name not in named and not name.endswith(ends)] == []


# By fastapi, uvicorn, authlib, trimesh and matplotlib, which are nothing without it.
BROUGHT_ALONG = {"anyio", "embreex", "h11", "joserfc", "pillow", "pydantic", "starlette"}


def names_of(node: ast.Import) -> list[str]:
    return [alias.name for alias in node.names]


LOCKED = set(re.findall(r"^([a-z0-9_-]+)==", (ROOT / "requirements.lock").read_text(), re.M))
