"""The list of the lab's processes, and that every launcher starts what it says."""

from __future__ import annotations

import ast
import importlib.util
import io
import json
import os
import subprocess
import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mrlab_msgs.msg
import pytest
from refusals import refused

from mrlab_ros.adapters.diagnostics import FOLDER_HELD, FOLDER_UNUSABLE
from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.adapters.robots.diagnostics import NO_ROBOT_MODEL
from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.scenes.diagnostics import NO_SCENE
from mrlab_ros.commands.demo.lab import free_port
from mrlab_ros.commands.up.speaker import COLOURS
from mrlab_ros.commands.up.surroundings import DISCOVERY, folder_for_state
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.diagnostics import BAD_ENDPOINT, OPEN_ENDPOINT, TLS_NEEDS_KEYS
from mrlab_ros.gateway.__main__ import settings_of
from mrlab_ros.processes import physics_support
from mrlab_ros.processes.child_process import WRONG_CONFIGURATION
from mrlab_ros.processes.diagnostics import NO_PARAMETER_FILE, NO_PHYSICS, NO_SUCH_PROCESS
from mrlab_ros.processes.lab import (
    NODES,
    PROCESSES,
    lab_nodes,
    lab_processes,
    parameter_file,
    parts_of_lab,
    robot_models,
)
from mrlab_ros.processes.options import LabOptions, WebOptions
from mrlab_ros.processes.web import web_address, zenoh_endpoint

ROOT = Path(__file__).parents[3]
CONFIG = ROOT / "config" / "lab.yaml"

# words before the arguments of a module
BEFORE = len(python_process.command("module"))


WEB = WebOptions("127.0.0.1", 8123)


def options(**changes: Any) -> LabOptions:
    return LabOptions(**{"config": CONFIG, "state_dir": Path("/state"), **changes})


def arguments(process: str, **changes: Any) -> tuple[str, ...]:
    chosen = options(**changes)
    return next(p for p in lab_processes(chosen) if p.name == process).arguments(chosen)


def parameters(process: str, **changes: Any) -> dict[str, Any]:
    given = arguments(process, **changes)
    pairs = [given[i + 1].split(":=", 1) for i, word in enumerate(given) if word == "-p"]
    return {name: json.loads(value) for name, value in pairs}


def test_every_node_is_in_one_process() -> None:
    assert sorted(node for process in PROCESSES for node in process.nodes) == sorted(NODES)


@pytest.mark.parametrize("name", NODES)
def test_a_node_is_where_the_list_says(name: str) -> None:
    entry = NODES[name]
    source = ROOT.joinpath(*entry.module.split(".")).with_suffix(".py")
    made = [n for n in ast.parse(source.read_text()).body if isinstance(n, ast.ClassDef)]
    assert entry.kind in [n.name for n in made]
    assert f'"{entry.graph_name}"' in source.read_text()
    if entry.state is not None:
        assert hasattr(mrlab_msgs.msg, entry.state[1])


def test_every_node_is_an_executable_of_the_package() -> None:
    tree = ast.parse((ROOT / "setup.py").read_text())
    found = next(
        node.value
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "NODES"
    )
    assert sorted(ast.literal_eval(found)) == sorted(NODES)


def test_every_process_has_a_colour() -> None:
    assert {process.name for process in PROCESSES} < set(COLOURS)


def test_physics_frames_and_bridge_can_be_left_out() -> None:
    everything = [process.name for process in lab_processes(options(web=WEB))]
    assert everything == [process.name for process in PROCESSES]
    # Without a bridge the pages would have no lab.
    assert "web" not in [process.name for process in lab_processes(options(web=WEB, bridge=False))]
    less = lab_processes(options(physics=False, frames=False, bridge=False))
    assert [process.name for process in less] == ["lab", "playback", "recorder"]
    assert NODES["physics"] not in lab_nodes(options(physics=False))


def test_a_lab_is_divided_among_machines() -> None:
    whole = lab_processes(options(web=WEB))
    there = lab_processes(options(only=parts_of_lab("playback, physics"), web=WEB))
    here = lab_processes(options(only=parts_of_lab("lab,recorder,frames,bridge"), web=WEB))
    assert [process.name for process in there] == ["playback", "physics"]
    # The pages are where the bridge is.
    assert {p.name for p in whole} == {p.name for p in (*there, *here)}
    assert len(whole) == len(there) + len(here)
    with refused(NO_SUCH_PROCESS, BadInput, name="web"):
        parts_of_lab("playback,web")


def test_robots_are_parameters_of_the_lab_node_and_win_over_the_file() -> None:
    assert parameters("lab", robots=("ur5e", "ur5e"))["lab:robots"] == ["ur5e", "ur5e"]
    assert "lab:robots" not in parameters("lab")


def test_what_is_not_chosen_is_left_to_the_parameter_file() -> None:
    assert parameters("bridge") == {"state_dir": "/state"}


def test_the_bridge_s_options_are_its_parameters(tmp_path: Path) -> None:
    assert parameters("bridge", listen="tcp/0.0.0.0:1", insecure=True) == {
        "state_dir": "/state",
        "bridge:listen": ["tcp/0.0.0.0:1"],
        "bridge:insecure": True,
    }
    routed = parameters("bridge", connect="tls/router:7447", keys=tmp_path / "12")
    assert routed == {
        "state_dir": "/state",
        "bridge:connect": ["tls/router:7447"],
        "bridge:mode": "client",
        "bridge:keys": str(tmp_path / "12"),
    }


def web_settings(**changes: Any) -> dict[str, str]:
    given = arguments("web", **{"web": WEB, **changes})
    return dict(zip(given[::2], given[1::2], strict=True))


def test_the_gateway_gets_what_the_lab_and_its_bridge_are_started_with(tmp_path: Path) -> None:
    assert web_settings() == {
        "--http": "127.0.0.1:8123",
        "--state-dir": "/state",
        "--zenoh": "tcp/127.0.0.1:7447",
    }
    config = tmp_path / "lab.yaml"
    config.write_text(
        "bridge: {ros__parameters: {prefix: lab_1, listen: [tcp/127.0.0.1:7000]}}\n"
        "/**: {ros__parameters: {prefix: other, allow_list: /rules.yaml}}\n"
    )
    found = web_settings(config=config)
    assert found["--prefix"] == "lab_1"
    assert found["--allow-list"] == "/rules.yaml"
    assert found["--zenoh"] == "tcp/127.0.0.1:7000"


def test_the_gateway_s_arguments_are_its_settings(tmp_path: Path) -> None:
    web = WebOptions(
        "::",
        1,
        Path("/c.pem"),
        Path("/c.key"),
        "https://l.org",
        Path("/o"),
        Path("/l"),
        Path("/class"),
        Path("/lti"),
    )
    changes = {"keys": tmp_path, "listen": "tls/0.0.0.0:9", "store": "s3://b"}
    found = settings_of(list(arguments("web", web=web, **changes)))
    assert (found.host, found.port, found.keys) == ("::", 1, tmp_path)
    assert found.zenoh == "tls/localhost:9"
    assert found.zenoh_config == tmp_path / "gateway.json5"
    assert (found.certificate, found.certificate_key) == (Path("/c.pem"), Path("/c.key"))
    assert (found.public_url, found.oidc, found.store) == ("https://l.org", Path("/o"), "s3://b")
    assert (found.limits, found.classroom) == (Path("/l"), Path("/class"))
    assert found.lti == Path("/lti")
    insecure = settings_of(list(arguments("web", web=WEB, insecure=True)))
    assert insecure.insecure


@pytest.mark.parametrize(
    ("changes", "endpoint"),
    [
        ({}, "tcp/127.0.0.1:7447"),
        ({"listen": "tcp/0.0.0.0:5"}, "tcp/127.0.0.1:5"),
        ({"listen": "tls/[::]:5", "keys": Path("/k")}, "tls/localhost:5"),
        ({"keys": Path("/k")}, "tls/localhost:7447"),
        ({"keys": Path("/k"), "connect": "tls/router:7"}, "tls/router:7"),
    ],
)
def test_the_gateway_finds_the_bridge_or_the_router(changes: Any, endpoint: str) -> None:
    assert zenoh_endpoint(options(**changes)) == endpoint


def test_the_pages_have_an_address_for_this_machine() -> None:
    everywhere = WebOptions("0.0.0.0", 8123)
    assert web_address(options(web=WEB)) == "http://127.0.0.1:8123"
    assert web_address(options(web=everywhere)) == "http://127.0.0.1:8123"
    assert web_address(options(web=everywhere, keys=Path("/k"))) == "https://localhost:8123"
    assert web_address(options(web=WebOptions("::1", 1))) == "http://[::1]:1"


def test_a_text_stays_a_text() -> None:
    assert parameters("lab", state_dir=Path('/a: "b" # 12'))["state_dir"] == '/a: "b" # 12'


def test_the_supervisor_starts_the_host_with_the_arguments() -> None:
    chosen = options(robots=("ur5e",))
    spec = PROCESSES[0].spec(chosen)
    assert spec.name == "lab"
    arguments = PROCESSES[0].arguments(chosen)
    assert spec.argv == python_process.command("mrlab_ros.processes.host", *arguments)
    assert arguments[:4] == ("converter", "lab", "coordinator", "--ros-args")


def test_robots_and_parameter_files_that_do_not_exist_are_refused() -> None:
    assert robot_models(" ur5e, ,kuka_kr3_r540") == ("ur5e", "kuka_kr3_r540")
    assert robot_models("") == ()
    with refused(NO_ROBOT_MODEL, BadInput, robot="ur6"):
        robot_models("ur5e,ur6")
    with pytest.raises(BadInput, match="no parameter file /nowhere.yaml"):
        parameter_file(Path("/nowhere.yaml"))
    assert parameter_file(None).name == "lab.yaml"


class Recorded:
    """Stands for a class of `launch`: keeps what it was made with."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self.args, self.kwargs = args, kwargs


class Configuration(Recorded):
    """Stands for launch.substitutions.LaunchConfiguration."""

    def perform(self, context: Context) -> str:
        return context.launch_configurations[self.args[0]]


class Context:
    """Stands for launch.LaunchContext."""

    def __init__(self, given: dict[str, str]) -> None:
        self.launch_configurations = given


Launched = Callable[..., list[Recorded]]
LAUNCH = ROOT / "launch"
MODULES = {
    "launch": ("LaunchDescription",),
    "launch.actions": (
        "DeclareLaunchArgument",
        "EmitEvent",
        "ExecuteProcess",
        "LogInfo",
        "OpaqueFunction",
        "RegisterEventHandler",
    ),
    "launch.event_handlers": ("OnProcessExit",),
    "launch.events": ("matches_action",),
    "launch.events.process": ("ShutdownProcess",),
    "launch.substitutions": (),
    "launch_ros": (),
    "launch_ros.actions": ("Node",),
}


@pytest.fixture
def launcher(monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Launched]:
    """Return what makes a launch file's processes; ROS's launcher is not on PyPI."""
    for name, kinds in MODULES.items():
        module = types.ModuleType(name)
        for kind in kinds:
            setattr(module, kind, type(kind, (Recorded,), {}))
        monkeypatch.setitem(sys.modules, name, module)
    sys.modules["launch.substitutions"].LaunchConfiguration = Configuration  # type: ignore[attr-defined]

    def load(file: str) -> Launched:
        spec = importlib.util.spec_from_file_location("under_test", LAUNCH / file)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)

        def run(**values: str) -> list[Recorded]:
            *declared, opaque = module.generate_launch_description().args[0]
            given = {each.args[0]: each.kwargs.get("default_value") for each in declared}
            given.update(values)
            assert None not in given.values(), "an argument without a default is missing"
            processes: list[Recorded] = opaque.kwargs["function"](Context(given))
            return processes

        return run

    return load


@pytest.fixture
def launched(launcher: Callable[[str], Launched]) -> Launched:
    return launcher("lab.launch.py")


def named(processes: list[Recorded], name: str) -> Recorded:
    return next(p for p in processes if p.kwargs.get("name") == name)


def handlers(processes: list[Recorded]) -> list[Recorded]:
    """Return the handlers of ends of processes."""
    return [p.args[0] for p in processes if type(p).__name__ == "RegisterEventHandler"]


def hosts(processes: list[Recorded]) -> list[Recorded]:
    """Return the processes of the lab's own nodes."""
    return [p for p in processes if p.kwargs.get("package") == "mrlab_ros"]


def test_the_launch_file_starts_the_same_processes_as_up(
    launcher: Callable[[str], Launched], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mrlab_ros.processes.options.new_lab_id", lambda: "0a1b")
    launched = launcher("lab.launch.py")
    Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, now())
    port = free_port(0)
    chosen = options(
        config=parameter_file(None),
        state_dir=tmp_path,
        robots=("ur5e",),
        listen="tls/127.0.0.1:7000",
        keys=tmp_path / "keys",
        web=WebOptions("127.0.0.1", port),
        lab_id="0a1b",
    )
    found = launched(
        state_dir=str(tmp_path),
        robots="ur5e",
        listen="tls/127.0.0.1:7000",
        keys=str(tmp_path / "keys"),
        http=f"127.0.0.1:{port}",
    )
    *specs, gateway = [process.spec(chosen) for process in lab_processes(chosen)]
    web, nodes = named(found, "web"), hosts(found)
    assert (web.kwargs["name"], tuple(web.kwargs["cmd"])) == (gateway.name, gateway.argv)
    assert [node.kwargs["exec_name"] for node in nodes] == [spec.name for spec in specs]
    assert [tuple(node.kwargs["arguments"]) for node in nodes] == [
        spec.argv[BEFORE:] for spec in specs
    ]
    for process in (web, *nodes):
        assert process.kwargs["additional_env"]["MRLAB_LAUNCHER"] == str(os.getpid())
    for node in nodes:
        assert node.kwargs["executable"] == "host"
        # A name here would rename every node of the process.
        assert "name" not in node.kwargs


def test_the_launch_file_starts_nothing_for_ever(launched: Launched) -> None:
    found = launched(http="127.0.0.1:0")
    for process in (*hosts(found), named(found, "web")):
        assert process.kwargs["respawn"] is True
        assert process.kwargs["respawn_max_retries"] > 0
    assert "respawn" not in named(found, "ready").kwargs


def test_a_process_that_refuses_its_configuration_is_not_started_again(launched: Launched) -> None:
    """While the lab starts it ends the launch, as it ends `mrlab up`."""
    found = handlers(launched(web="false"))
    (handler,) = (h for h in found if "target_action" not in h.kwargs)
    (ready,) = (h for h in found if "target_action" in h.kwargs)
    then, process = handler.kwargs["on_exit"], object()
    refusal = types.SimpleNamespace(
        returncode=WRONG_CONFIGURATION, action=process, process_name="web-7"
    )
    with pytest.raises(BadInput, match="web-7 refuses"):
        then(refusal, None)
    assert ready.kwargs["on_exit"](types.SimpleNamespace(returncode=0), None) == []
    (end,) = then(refusal, None)
    shutdown = end.kwargs["event"]
    assert type(shutdown).__name__ == "ShutdownProcess"
    assert shutdown.kwargs["process_matcher"].args == (process,)
    assert then(types.SimpleNamespace(returncode=1, action=process), None) == []


def test_the_launch_file_refuses_at_once_what_a_process_would_refuse(
    launched: Launched, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    for wrong in (
        {"oidc": str(tmp_path / "none.yaml"), "http": f"127.0.0.1:{free_port(0)}"},
        {"connect": "foo"},
        {"store": "nope://x"},
        {"state_dir": str(tmp_path / "file")},
    ):
        given = {"web": "true" if "oidc" in wrong else "false"} | wrong
        with pytest.raises(BadInput):
            launched(**given)
    monkeypatch.setattr("sys.stdout", io.StringIO())
    assert {p.kwargs.get("emulate_tty") for p in hosts(launched(web="false"))} == {False}


def test_the_launch_file_warns_of_a_name_that_is_nearly_an_argument(launched: Launched) -> None:
    found = launched(web="false", robot="ur5e", something_of_a_file_that_includes_it="1")
    warnings = [p.kwargs["msg"] for p in found if type(p).__name__ == "LogInfo"]
    (warning,) = warnings
    assert "robot:= is no argument of the lab" in warning
    assert warning.endswith("did you mean 'robots'?")


@pytest.mark.parametrize(
    ("listen", "code"),
    [
        ("0.0.0.0", BAD_ENDPOINT),
        ("tcp/0.0.0.0:7447", OPEN_ENDPOINT),
        ("tls/0.0.0.0:7447", TLS_NEEDS_KEYS),
    ],
)
def test_the_launch_file_refuses_to_listen_where_the_bridge_would(launched, listen, code) -> None:
    with refused(code, BadInput, endpoint=listen):
        launched(web="false", listen=listen)


def test_the_launch_file_refuses_a_namespace_in_which_no_robot_would_appear(launched) -> None:
    with pytest.raises(BadInput, match="in the namespace '/cell'; expected none"):
        launched(web="false", ros_namespace="/cell")
    assert hosts(launched(web="false", ros_namespace="/"))


def test_the_graph_stays_on_the_machine_unless_subnet_is_asked_for(
    launcher: Callable[[str], Launched], monkeypatch: pytest.MonkeyPatch
) -> None:
    def ranges(file: str, **values: str) -> set[str | None]:
        """Return what the started processes have for the range of their graph."""
        started = [
            p for p in launcher(file)(**values) if "name" in p.kwargs or "package" in p.kwargs
        ]
        assert started
        return {p.kwargs["additional_env"].get("ROS_AUTOMATIC_DISCOVERY_RANGE") for p in started}

    files: dict[str, dict[str, str]] = {
        "lab.launch.py": {"web": "false", "scene": "handover", "record": "/class.bag"},
        "robot.launch.py": {"model": "ur5e"},
    }
    for name in DISCOVERY:
        monkeypatch.delenv(name, raising=False)
    for file, values in files.items():
        assert ranges(file, **values) == {"LOCALHOST"}
        assert ranges(file, **values, discovery="subnet") == {"SUBNET"}
    # a range that the user set for all of ROS holds for the lab, too
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT")
    assert ranges("lab.launch.py", **files["lab.launch.py"]) == {None}


def test_the_launch_file_says_when_the_lab_is_ready_and_then_goes_on(launched: Launched) -> None:
    found = launched(robots="ur5e,ur5e", web="false", scene="handover", record="/class.bag")
    ready = named(found, "ready")
    nodes = [node for process in lab_processes(options()) for node in process.nodes]
    expected = [n for n in nodes if n != "physics" or not physics_support.missing()]
    module, lab, *rest = ready.kwargs["cmd"][BEFORE - 1 :]
    assert module == "mrlab_ros.processes.readiness"
    assert all(f'lab_id:="{lab}"' in host.kwargs["arguments"] for host in hosts(found))
    assert rest == ["2", ",".join(expected), "/lab/load_scene", "/recorder/start"]
    (handler,) = (h for h in handlers(found) if h.kwargs.get("target_action") is ready)
    then = handler.kwargs["on_exit"]
    commands = then(types.SimpleNamespace(returncode=0), None)
    assert [c.kwargs["cmd"][BEFORE:] for c in commands] == [
        ["scene", "load", "handover"],
        ["record", "/class.bag"],
    ]
    assert then(types.SimpleNamespace(returncode=1), None) == []


def test_the_launch_file_starts_nothing_where_rviz_is_missing(launched: Launched) -> None:
    with pytest.raises(BadInput, match="RViz is not installed; install it"):
        launched(web="false", rviz="true")


def test_the_launch_file_remaps_and_shows_the_lab_in_rviz(
    launcher: Callable[[str], Launched], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ament_index_python.packages.get_package_prefix", lambda _: "/opt")
    launched = launcher("lab.launch.py")
    found = launched(web="false", rviz="true", remap="/clock:=/sim/clock, /a:=/b")
    pairs = [("/clock", "/sim/clock"), ("/a", "/b")]
    assert all(node.kwargs["remappings"] == pairs for node in hosts(found))
    rviz = next(p for p in found if p.kwargs.get("package") == "rviz2")
    option, config = rviz.kwargs["arguments"]
    assert option == "-d"
    assert Path(config).name == "mrlab.rviz"
    with pytest.raises(BadInput, match="expected FROM:=TO"):
        launched(web="false", remap="/clock")


def test_the_launch_file_leaves_out_and_refuses_what_it_is_told_to(
    launched: Launched, monkeypatch: pytest.MonkeyPatch
) -> None:
    less = launched(physics="false", frames="false", bridge="false")
    assert [node.kwargs["exec_name"] for node in hosts(less)] == ["lab", "playback", "recorder"]
    with pytest.raises(BadInput, match="no robot 'ur6'"):
        launched(robots="ur6", web="false")
    with refused(NO_PARAMETER_FILE, BadInput, path="/nowhere.yaml"):
        launched(config="/nowhere.yaml", web="false")
    with refused(NO_SCENE, BadInput, scene="nope"):
        launched(scene="nope")
    monkeypatch.setattr(physics_support, "missing", lambda: "pybullet is not installed")
    with refused(NO_PHYSICS, BadInput):
        launched(physics="true", web="false")


def test_a_robot_is_launched_into_a_running_lab(launcher: Callable[[str], Launched]) -> None:
    run = launcher("robot.launch.py")
    (command,) = run(model="ur5e", x="1.5", yaw="90", end_effector="vacuum_cup", name="left")
    assert command.kwargs["cmd"][BEFORE:] == [
        *("spawn", "ur5e", "--yaw", "90", "--at", "1.5,0"),
        *("--name", "left", "--tool", "vacuum_cup"),
    ]
    (command,) = run(model="ur5e")
    assert command.kwargs["cmd"][BEFORE:] == ["spawn", "ur5e", "--yaw", "0"]
    with pytest.raises(AssertionError, match="without a default"):
        run()


@pytest.mark.parametrize("file", ["lab.launch.py", "robot.launch.py"])
def test_ros_s_own_launcher_takes_the_launch_files(file: str) -> None:
    pytest.importorskip("launch_ros", reason="ROS's launcher is not on PyPI")
    from launch.launch_description_sources import get_launch_description_from_any_launch_file

    found = get_launch_description_from_any_launch_file(str(LAUNCH / file))
    assert found.get_launch_arguments()


def test_a_file_given_as_the_state_folder_is_refused(tmp_path):
    (tmp_path / "f").write_text("")
    with refused(FOLDER_UNUSABLE, BadInput), folder_for_state(tmp_path / "f"):
        pass


def test_processes_at_rest_have_imported_no_reader_of_meshes_files_or_pages() -> None:
    """Each of these takes megabytes in every process, and what imports it is needed seldom."""
    program = (
        "import importlib, sys\n"
        "from mrlab_ros.processes.lab import NODES\n"
        "for entry in NODES.values(): importlib.import_module(entry.module)\n"
        "import mrlab_ros.gateway.app\n"
        "names = ('trimesh', 'scipy', 'PIL', 'matplotlib', 'h5py', 'httpx', 'rosbags.rosbag2',"
        " 'cryptography')\n"
        "print([name for name in names if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == "[]"


def test_a_state_folder_has_one_lab_at_a_time(tmp_path):
    def second():
        with folder_for_state(tmp_path / "state" / ".." / "state"):
            pass

    folder, pid = str(tmp_path / "state"), str(os.getpid())
    with folder_for_state(tmp_path / "state"), refused(FOLDER_HELD, Misuse, path=folder, pid=pid):
        second()
    second()
