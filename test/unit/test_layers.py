"""The layers of docs/architecture.md, read from the imports in the sources."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import re
import sys
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "mrlab_ros"
TESTS = Path(__file__).parent
CORE = sorted((PACKAGE / "core").rglob("*.py"))
ADAPTERS = sorted((PACKAGE / "adapters").rglob("*.py"))
APP = sorted((PACKAGE / "app").rglob("*.py"))
GATEWAY = sorted((PACKAGE / "gateway").rglob("*.py"))
SOURCES = sorted(PACKAGE.rglob("*.py"))
# From the bottom to the top; below each stands what it may import. docs/architecture.md has the
# same table.
LAYERS = {
    "core": (),
    "adapters": ("core",),
    "app": ("core", "adapters"),
    "messages": ("core",),
    "ros": ("core", "adapters", "messages"),
    "nodes": ("core", "adapters", "app", "messages", "ros"),
    "processes": ("core", "adapters", "messages", "ros", "nodes"),
    "gateway": ("core", "adapters", "app", "extensions"),
    "client": ("core", "adapters", "messages", "ros", "processes"),
    "commands": ("core", "adapters", "app", "messages", "ros", "processes", "gateway", "client"),
    "extensions": (),
    "cli": ("core", "adapters", "commands", "extensions"),
    # Beside the lab: nothing below imports it, extensions.py names it.
    "classroom": ("core", "adapters", "app", "gateway", "commands"),
}
# Packages of one door: commands print, the gateway answers HTTP.
DOORS = {"rich", "starlette", "typer", "uvicorn"}
# Parts of rclpy that may change with any release.
INSIDES = re.compile(r"rclpy\.impl|rclpy\.experimental|\.handle\b")
# The graph. Not ament_index_python: it finds installed files and knows no node.
GRAPH = {
    "builtin_interfaces",
    "control_msgs",
    "controller_manager_msgs",
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
    if not classes and not modules:
        return set()
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


def of_graph(path: Path) -> set[str]:
    return {name for name in imports_of(path) if name.split(".")[0] in GRAPH}


def found_in(paths: Iterable[Path], find: Callable[[Path], Iterable[str]]) -> dict[str, list[str]]:
    """Return what `find` finds in each module, of those in which it finds anything."""
    found = {module_name(path): sorted(find(path)) for path in paths}
    return {module: names for module, names in found.items() if names}


def test_core_imports_only_the_standard_library_numpy_and_itself() -> None:
    known = {*sys.stdlib_module_names, "numpy"}

    def foreign(path: Path) -> set[str]:
        names = {name for name in imports_of(path) if not within(name, "mrlab_ros.core")}
        return {name for name in names if name.split(".")[0] not in known}

    assert found_in(CORE, foreign) == {}


def test_core_neither_reads_a_clock_nor_logs() -> None:
    clocks = {"time", "datetime", "logging", "asyncio", "threading", "subprocess", "socket"}

    def of_clocks(path: Path) -> set[str]:
        return {name for name in imports_of(path) if name.split(".")[0] in clocks}

    assert found_in(CORE, of_clocks) == {}


def test_adapters_know_no_node_and_nothing_above_them() -> None:
    assert found_in(ADAPTERS, of_graph) == {}
    below = ("mrlab_ros.core", "mrlab_ros.adapters")

    def above(path: Path) -> set[str]:
        own = {name for name in imports_of(path) if name.startswith("mrlab_ros.")}
        return {name for name in own if not any(within(name, folder) for folder in below)}

    assert found_in(ADAPTERS, above) == {}


def test_use_cases_know_no_node_and_no_door() -> None:
    def of_doors(path: Path) -> set[str]:
        return {name for name in imports_of(path) if name.split(".")[0] in DOORS}

    assert found_in(APP, of_graph) == {}
    assert found_in(APP, of_doors) == {}


def test_use_cases_print_nothing() -> None:
    def printed(path: Path) -> list[str]:
        calls = [node for node in ast.walk(ast.parse(path.read_text())) if type(node) is ast.Call]
        return [name for name in map(ast.unparse, (c.func for c in calls)) if name == "print"]

    assert found_in(APP, printed) == {}


def test_the_gateway_is_no_node() -> None:
    assert found_in(GATEWAY, of_graph) == {}


def test_a_layer_imports_only_the_layers_below_it() -> None:
    def others(path: Path) -> set[str]:
        module = module_name(path)
        allowed = {layer_of(module), *LAYERS[layer_of(module)]}
        return {name for name in own_imports(path) if layer_of(name) not in allowed}

    # The package itself: the Python API, imported when it is asked for.
    package = MODULES["mrlab_ros"]
    assert {layer_of(name) for name in own_imports(package)} == {"app", "client", "core"}
    assert found_in([path for path in SOURCES if path != package], others) == {}


def test_no_module_imports_itself_over_others() -> None:
    assert circle({module: own_imports(path) for module, path in MODULES.items()}) == []


def test_the_layers_are_the_folders_of_the_package() -> None:
    folders = {path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()}
    modules = {path.name for path in PACKAGE.glob("*.py")}
    assert modules == {"__init__.py", "cli.py", "extensions.py"}
    assert folders | {"cli", "extensions"} == set(LAYERS)


def test_the_class_is_no_node_and_its_rubrics_and_marks_are_pure() -> None:
    folder = PACKAGE / "classroom"
    assert found_in(folder.rglob("*.py"), of_graph) == {}
    pure = ("mrlab_ros.core", "mrlab_ros.classroom.rubrics", "mrlab_ros.classroom.marks")

    def others(path: Path) -> set[str]:
        return {name for name in own_imports(path) if not any(within(name, p) for p in pure)}

    paths = [path for room in ("rubrics", "marks") for path in (folder / room).rglob("*.py")]
    assert found_in(paths, others) == {}


def test_only_the_doors_of_the_class_know_the_doors_of_the_lab() -> None:
    """What checks and marks a submission prints nothing and answers no request."""
    doors = {"commands", "rubric_run", "run", "words", "routes", "shown", "launch"}

    def others(path: Path) -> set[str]:
        return {name for name in own_imports(path) if layer_of(name) in ("commands", "gateway")}

    paths = [path for path in (PACKAGE / "classroom").rglob("*.py") if path.stem not in doors]
    assert found_in(paths, others) == {}


def test_only_ros_touches_the_insides_of_rclpy() -> None:
    outside = [path for path in SOURCES if "ros" not in path.relative_to(PACKAGE).parts[:1]]
    assert found_in(outside, lambda path: INSIDES.findall(path.read_text())) == {}


def test_only_messages_builds_messages() -> None:
    """ros/parameters.py fills in rclpy's own descriptors of parameters."""
    others = ("mrlab_ros.ros.parameters", "mrlab_ros.commands.lab.system", "mrlab_ros.nodes.lab")
    builders = ("mrlab_ros.messages", *others)
    rest = [
        path for module, path in MODULES.items() if not any(within(module, b) for b in builders)
    ]
    assert found_in(rest, lambda path: built_messages(path.read_text())) == {}


def test_unit_tests_lie_where_what_they_test_lies() -> None:
    for path in TESTS.rglob("test_*.py"):
        folder = PACKAGE / path.parent.relative_to(TESTS)
        assert (folder / "__init__.py").exists(), f"{path} tests no folder of the package"


def test_every_layer_has_sources() -> None:
    assert len(CORE) > 5
    assert len(ADAPTERS) > 1
    assert len(APP) > 1
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


def shallow_services(source: str) -> list[str]:
    """Return the services and clients that `source` makes without the deep queues."""
    if "create_service" not in source and "create_client" not in source:
        return []
    return [
        ast.unparse(node)
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr in ("create_service", "create_client")
        and [ast.unparse(k.value) for k in node.keywords if k.arg == "qos_profile"]
        != ["qos.SERVICES"]
    ]


def test_every_service_and_client_has_the_deep_queues() -> None:
    assert found_in(SOURCES, lambda path: shallow_services(path.read_text())) == {}


def test_services_without_the_deep_queues_are_found() -> None:
    deep = "node.create_client(Seek, 'seek', qos_profile=qos.SERVICES)"
    other = "node.create_service(Seek, 'seek', seek, qos_profile=qos.EVENTS)"
    none = "node.create_client(Seek, 'seek')"
    assert shallow_services("\n".join((deep, other, none))) == [other, none]


def test_no_timer_goes_by_a_clock_that_may_be_set() -> None:
    """mrlab_ros.ros.clock.every makes one that does not."""
    timers = [path for path in SOURCES if path.parts[-2:] != ("ros", "clock.py")]
    assert found_in(timers, lambda path: re.findall("create_timer\\(", path.read_text())) == {}


def test_one_door_makes_consoles() -> None:
    """What rich paints is guarded there: names of files are no markup and move no cursor."""
    door = PACKAGE / "commands" / "output.py"
    calls = re.compile(r"(?<!output\.)\b(Console|from_markup|render_markup)\(")
    others = [path for path in SOURCES if path != door]
    assert [str(path) for path in others if calls.search(path.read_text())] == []


def test_what_launch_files_scripts_and_benchmarks_import_is_there() -> None:
    """Most of them run rarely: a name that moved would be noticed by a user."""
    root = PACKAGE.parent
    gone = []
    for folder in ("launch", "scripts", "bench", "examples"):
        for path in sorted((root / folder).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text())):
                if not isinstance(node, ast.ImportFrom) or not (node.module or "").startswith(
                    PACKAGE.name
                ):
                    continue
                module = importlib.import_module(node.module or "")
                for alias in node.names:
                    name = f"{node.module}.{alias.name}"
                    if not hasattr(module, alias.name) and importlib.util.find_spec(name) is None:
                        gone.append(f"{path.relative_to(root)}: {name}")
    assert gone == []
