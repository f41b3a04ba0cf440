"""The layers of docs/architecture.md, read from the imports in the sources."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "mrlab_ros"
TESTS = Path(__file__).parent
CORE = sorted((PACKAGE / "core").rglob("*.py"))
ADAPTERS = sorted((PACKAGE / "adapters").rglob("*.py"))
GATEWAY = sorted((PACKAGE / "gateway").rglob("*.py"))
SOURCES = sorted(PACKAGE.rglob("*.py"))
# From the bottom to the top; below each stands what it may import. docs/architecture.md has the
# same table.
LAYERS = {
    "core": (),
    "adapters": ("core",),
    "messages": ("core",),
    "ros": ("core", "messages"),
    "nodes": ("core", "adapters", "messages", "ros"),
    "processes": ("core", "adapters", "messages", "ros", "nodes"),
    "gateway": ("core", "adapters"),
    "client": ("core", "adapters", "messages", "ros", "processes"),
    "commands": ("core", "adapters", "messages", "ros", "processes", "gateway", "client"),
    "cli": ("core", "commands"),
}
# Parts of rclpy that may change with any release.
INSIDES = re.compile(r"rclpy\.impl|rclpy\.experimental|\.handle\b")
# The graph. Not ament_index_python: it finds installed files and knows no node.
GRAPH = {
    "builtin_interfaces",
    "control_msgs",
    "diagnostic_msgs",
    "geometry_msgs",
    "launch",
    "launch_ros",
    "mrlab_msgs",
    "rcl_interfaces",
    "rclpy",
    "rosidl_runtime_py",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "std_srvs",
    "tf2_msgs",
    "trajectory_msgs",
    "visualization_msgs",
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


@cache
def imports_of(path: Path) -> frozenset[str]:
    package = ".".join(path.relative_to(PACKAGE.parent).parent.parts)
    return frozenset(imports(path.read_text(), package))


def module_name(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def layer_of(module: str) -> str:
    return module.split(".")[1]


MODULES = {module_name(path): path for path in SOURCES}


def own_imports(path: Path) -> set[str]:
    """Return the modules of this package that a module imports, wherever it does so."""
    found = set()
    for name in imports_of(path):
        while name and name not in MODULES:
            name = name.rpartition(".")[0]
        # The package itself holds nothing but its version.
        if name not in ("", "mrlab_ros", module_name(path)):
            found.add(name)
    return found


def is_message_package(name: str) -> bool:
    return name.endswith("_msgs") or name in ("builtin_interfaces", "rcl_interfaces")


def built_messages(source: str) -> set[str]:
    """Return what in `source` makes a message: calls of classes of a package's `msg` module.

    Naming a class is allowed, as publishers and subscriptions need it; so are the requests of
    services, which the caller of a service fills in.
    """
    tree = ast.parse(source)
    classes, modules = set(), set()
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or node.module is None:
            continue
        package, _, folder = node.module.partition(".")
        if is_message_package(package):
            names = {alias.name: alias.asname or alias.name for alias in node.names}
            if folder == "msg":
                classes.update(names.values())
            elif "msg" in names:
                modules.add(names["msg"])
    # A second name for a class: State = msg.RecorderState
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and _of_module(node.value, modules):
            classes.update(ast.unparse(target) for target in node.targets)
    return {
        ast.unparse(node.func)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and (_of_module(node.func, modules) or ast.unparse(node.func) in classes)
    }


def _of_module(node: ast.expr, modules: set[str]) -> bool:
    return isinstance(node, ast.Attribute) and ast.unparse(node.value) in modules


def circle(graph: Mapping[str, Iterable[str]]) -> list[str]:
    """Return the nodes of one circle of a graph, or nothing."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


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


@pytest.mark.parametrize("path", GATEWAY, ids=module_name)
def test_the_gateway_is_no_node(path: Path) -> None:
    assert not {name for name in imports_of(path) if name.split(".")[0] in GRAPH}


@pytest.mark.parametrize("path", SOURCES, ids=module_name)
def test_a_layer_imports_only_the_layers_below_it(path: Path) -> None:
    module = module_name(path)
    if module == "mrlab_ros":
        # The Python API, imported when it is asked for.
        assert {layer_of(name) for name in own_imports(path)} == {"client", "core"}
        return
    allowed = {layer_of(module), *LAYERS[layer_of(module)]}
    assert not {name for name in own_imports(path) if layer_of(name) not in allowed}


def test_no_module_imports_itself_over_others() -> None:
    assert circle({module: own_imports(path) for module, path in MODULES.items()}) == []


def test_the_layers_are_the_folders_of_the_package() -> None:
    folders = {path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()}
    assert folders | {"cli"} == set(LAYERS)
    assert {path.name for path in PACKAGE.glob("*.py")} == {"__init__.py", "cli.py"}


@pytest.mark.parametrize("path", SOURCES, ids=module_name)
def test_only_ros_touches_the_insides_of_rclpy(path: Path) -> None:
    if "ros" not in path.relative_to(PACKAGE).parts[:1]:
        assert INSIDES.findall(path.read_text()) == []


@pytest.mark.parametrize("path", SOURCES, ids=module_name)
def test_only_messages_builds_messages(path: Path) -> None:
    """ros/parameters.py fills in rclpy's own descriptors of parameters."""
    module = module_name(path)
    others = ("mrlab_ros.ros.parameters", "mrlab_ros.commands.system", "mrlab_ros.nodes.lab")
    if not any(within(module, name) for name in ("mrlab_ros.messages", *others)):
        assert built_messages(path.read_text()) == set()


def test_unit_tests_lie_where_what_they_test_lies() -> None:
    for path in TESTS.rglob("test_*.py"):
        folder = PACKAGE / path.parent.relative_to(TESTS)
        assert (folder / "__init__.py").exists(), f"{path} tests no folder of the package"


def test_every_layer_has_sources() -> None:
    assert len(CORE) > 5
    assert len(ADAPTERS) > 1
    assert len(GATEWAY) > 1


def test_imports_are_found_in_every_form() -> None:
    source = (
        "import a.b\nimport c as d\nfrom e import f\nfrom . import g\nfrom ..h import i\n"
        "def k():\n    import rclpy\n"
    )
    assert imports(source, "mrlab_ros.core") == {
        "a.b", "c", "e.f", "mrlab_ros.core.g", "mrlab_ros.h.i", "rclpy",
    }  # fmt: skip


def test_circles_are_found() -> None:
    assert circle({"a": ["b"], "b": ["c"]}) == []
    assert set(circle({"a": ["b"], "b": ["c"], "c": ["a"]})) == {"a", "b", "c"}


def test_built_messages_are_found_in_every_form() -> None:
    source = (
        "from mrlab_msgs import msg, srv\nfrom std_msgs.msg import String as Text\n"
        "Kind = msg.Robot\nsrv.Seek.Request(position=1.0)\nnode.create_publisher(Text, 'a')\n"
    )
    assert built_messages(source) == set()
    source += "Text(data='a')\nmsg.Robots()\nKind()\n"
    assert built_messages(source) == {"Text", "msg.Robots", "Kind"}


def calls_of_services(path: Path) -> Iterator[ast.Call]:
    for node in ast.walk(ast.parse(path.read_text())):
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in ("create_service", "create_client")
        ):
            yield node


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: path.stem)
def test_every_service_and_client_has_the_deep_queues(path: Path) -> None:
    for call in calls_of_services(path):
        profiles = [ast.unparse(k.value) for k in call.keywords if k.arg == "qos_profile"]
        assert profiles == ["qos.SERVICES"], ast.unparse(call)


@pytest.mark.parametrize("path", SOURCES, ids=module_name)
def test_no_timer_goes_by_a_clock_that_may_be_set(path: Path) -> None:
    if path.name != "timers.py":
        assert "create_timer(" not in path.read_text(), "use mrlab_ros.ros.timers.every"
