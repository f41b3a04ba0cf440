"""The lab without the packages beside it: they are refused as if they were not installed."""

from __future__ import annotations

import subprocess
import sys

from mrlab_ros.extensions import EXTENSIONS, extensions

HIDDEN = f"""
import sys

class Refuses:
    def find_spec(self, name, path=None, target=None):
        if name.startswith({EXTENSIONS}):
            raise ModuleNotFoundError("hidden", name=name)

sys.meta_path.insert(0, Refuses())
"""


def said(program: str) -> str:
    """Return what a program prints in a process in which the extensions are not found."""
    command = [sys.executable, "-c", HIDDEN + program]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return done.stdout


def test_each_extension_says_its_commands_routers_and_policy() -> None:
    for each in extensions():
        assert each.COMMANDS
        assert each.ROUTERS
        assert {path.split("/")[1] for _, path in each.POLICY} == {"api"}


def test_the_command_line_works_without_them() -> None:
    program = "from mrlab_ros.cli import main\nsys.argv = ['mrlab', '--help']\nmain()"
    help_text = said(program)
    names = {line.split()[1] for line in help_text.splitlines() if line.startswith("\u2502 ")}
    assert {"up", "check", "convert"} <= names
    assert not names & {name for each in extensions() for name in each.COMMANDS}


def test_the_gateway_answers_without_them(tmp_path) -> None:
    program = f"""
from pathlib import Path
from fastapi.testclient import TestClient
from mrlab_ros.gateway.app import create_app
from mrlab_ros.gateway.ports import Ports
from mrlab_ros.gateway.settings import Settings

settings = Settings(state_dir=Path({str(tmp_path)!r}))
settings.check()
app = create_app(settings, Ports())
with TestClient(app, base_url="http://127.0.0.1:8080") as client:
    print(client.get("/healthz").json()["status"])
print([path for path in app.openapi()["paths"] if "class" in path])
print([name for name in sys.modules if name.startswith({EXTENSIONS})])
"""
    assert said(program).splitlines() == ["ok", "[]", "[]"]
