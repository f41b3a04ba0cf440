"""Descriptions from outside: xacros expand, and what they run reaches nothing."""

from __future__ import annotations

import http.server
import os
import threading
from pathlib import Path

import pytest
from refusals import refused

from mrlab_ros.adapters.robots.importing.diagnostics import (
    UNBOUND_PREFIX,
    XACRO_NO_ARGUMENT,
    XACRO_NO_WALL,
    XACRO_REFUSED,
)
from mrlab_ros.adapters.robots.importing.source import description_text
from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.core.base.errors import BadInput

# Each file is read by a process of its own.
pytestmark = pytest.mark.slow

XACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">{}</robot>'
LINK = '<link name="{}"/>'
# xacro refuses names such as __class__ in an expression, but not in a function within it.
MODULES = "[c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0]"
GLOBALS = f"{MODULES}.__init__.__globals__"
IMPORT = f"{GLOBALS}['__builtins__']['__import__']"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "robot").mkdir()
    (tmp_path / "secret.yaml").write_text("word: secret_word\n")
    return tmp_path / "robot"


def expanded(folder: Path, content: str, **packages: Path) -> str:
    path = folder / "r.urdf.xacro"
    path.write_text(XACRO.format(content))
    arguments = ["word:=given"] * ('name="word"' in content)
    return description_text(path, packages, arguments)


def test_a_xacro_takes_files_beside_it_and_of_its_packages(folder: Path) -> None:
    (folder / "parts").mkdir()
    (folder / "parts" / "a.xacro").write_text(XACRO.format(LINK.format("included")))
    (folder / "values.yaml").write_text("word: read\n")
    other = folder.parent / "other"
    other.mkdir()
    (other / "b.xacro").write_text(XACRO.format(LINK.format("of_package")))
    text = expanded(
        folder,
        '<xacro:arg name="word" default=""/>'
        '<xacro:include filename="parts/a.xacro"/>'
        '<xacro:include filename="$(find other)/b.xacro"/>'
        '<xacro:property name="v" value="${load_yaml(\'values.yaml\')}"/>'
        '<link name="$(arg word)"/><link name="${v[\'word\']}"/>'
        '<link name="l"><visual><geometry><mesh filename="file://$(find other)/m.stl"/>'
        "</geometry></visual></link>",
        other=other,
    )
    for name in ("included", "of_package", "given", "read"):
        assert f'name="{name}"' in text
    assert f'filename="file://{other}/m.stl"' in text


def test_a_xacro_finds_installed_packages(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    prefix, source = folder.parent / "install", folder.parent / "source"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    for made in (index, prefix / "share" / "linked", source):
        made.mkdir(parents=True)
    # as colcon's --symlink-install leaves it
    (source / "marker").touch()
    (index / "linked").symlink_to(source / "marker")
    for name in ("package.xml", "a.xacro"):
        (source / name).write_text(XACRO.format(LINK.format("installed")))
        (prefix / "share" / "linked" / name).symlink_to(source / name)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{prefix}:{os.environ['AMENT_PREFIX_PATH']}")
    text = expanded(folder, '<xacro:include filename="$(find linked)/a.xacro"/>')
    assert 'name="installed"' in text
    # what lies in the source tree and is not installed
    (source / "keys").mkdir()
    (source / "keys" / "secret.yaml").write_text("word: secret_word\n")
    with pytest.raises(BadInput, match="Permission denied"):
        expanded(folder, f"<link name=\"${{load_yaml('{source}/keys/secret.yaml')['word']}}\"/>")


def test_a_xacro_reads_nothing_of_a_source_tree_that_is_no_module(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    tree = folder.parent / "tree"
    (tree / "keys").mkdir(parents=True)
    (tree / "keys" / "secret.yaml").write_text("word: secret_word\n")
    monkeypatch.setenv("PYTHONPATH", f"{tree}:{os.environ['PYTHONPATH']}")
    with pytest.raises(BadInput, match="Permission denied"):
        expanded(folder, f"<link name=\"${{load_yaml('{tree}/keys/secret.yaml')['word']}}\"/>")


def test_a_xacro_that_lacks_an_argument_names_those_it_has_with_their_defaults(
    folder: Path,
) -> None:
    with refused(XACRO_REFUSED, BadInput, hint="argument", arguments=["hand:=true"]):
        expanded(folder, '<xacro:arg name="hand" default="true"/><link name="$(arg arm_id)"/>')


def test_an_argument_that_a_xacro_does_not_have_is_refused(folder: Path) -> None:
    (folder / "part.xacro").write_text(
        XACRO.format('<xacro:arg name="word" default="1"/>' + LINK.format("$(arg word)"))
    )
    path = folder / "r.urdf.xacro"
    path.write_text(
        XACRO.format(
            '<xacro:arg name="length" default="1"/><xacro:include filename="part.xacro"/>'
        )
    )
    assert 'name="2"' in description_text(path, {}, ["word:=2", "length:=3"])
    said = {"arguments": ["lenght"], "known": ["length", "word"], "close": "length"}
    with refused(XACRO_NO_ARGUMENT, BadInput, **said):
        description_text(path, {}, ["word:=2", "lenght:=3"])


@pytest.mark.parametrize(("prefix", "line"), [("xacro", 2), ("sensor", 3)])
def test_a_prefix_that_is_not_declared_is_named_with_the_line_that_mends_it(
    folder: Path, prefix: str, line: int
) -> None:
    path = folder / "r.urdf.xacro"
    path.write_text(f'<robot name="r">{chr(10) * (line - 1)}<{prefix}:a name="b"/></robot>')
    uri = "http://www.ros.org/wiki/xacro" if prefix == "xacro" else prefix
    with refused(UNBOUND_PREFIX, BadInput, prefix=prefix, line=line, uri=uri):
        description_text(path, {})


def test_a_package_that_is_not_there_is_named_without_where_it_was_sought(folder: Path) -> None:
    with refused(XACRO_REFUSED, BadInput, hint="package", why="package 'nobody' not found"):
        expanded(folder, '<xacro:include filename="$(find nobody)/a.xacro"/>')


@pytest.mark.parametrize(
    "name", ["{outside}/secret.yaml", "../secret.yaml", "link.yaml", ".keys/secret.yaml"]
)
def test_a_xacro_reads_no_file_elsewhere(folder: Path, name: str) -> None:
    (folder / "link.yaml").symlink_to(folder.parent / "secret.yaml")
    (folder / ".keys").mkdir()
    (folder / ".keys" / "secret.yaml").write_text("word: secret_word\n")
    path = name.format(outside=folder.parent)
    with refused(XACRO_REFUSED, BadInput, hint="folder") as caught:
        expanded(folder, f"<link name=\"${{load_yaml('{path}')['word']}}\"/>")
    assert "secret_word" not in str(caught.value)


def test_a_xacro_reads_nothing_hidden_in_a_package(folder: Path) -> None:
    git = folder.parent / "other" / ".git"
    git.mkdir(parents=True)
    (git / "config.yaml").write_text("word: secret_word\n")
    with refused(XACRO_REFUSED, BadInput, hint="folder") as caught:
        expanded(
            folder,
            "<link name=\"${load_yaml('$(find other)/.git/config.yaml')['word']}\"/>",
            other=folder.parent / "other",
        )
    assert "secret_word" not in str(caught.value)


def test_a_xacro_reads_nothing_in_a_package_that_is_closed_to_others(folder: Path) -> None:
    other = folder.parent / "other"
    (other / "keys").mkdir(parents=True)
    (other / "keys" / "secret.yaml").write_text("word: secret_word\n")
    other.chmod(0o755)
    asks = "<link name=\"${load_yaml('$(find other)/keys/secret.yaml')['word']}\"/>"
    assert "secret_word" in expanded(folder, asks, other=other)
    (other / "keys").chmod(0o700)
    with pytest.raises(BadInput, match="Permission denied"):
        expanded(folder, asks, other=other)


@pytest.mark.parametrize(
    "does",
    [
        "{globals}['system']('touch {marker}')",
        "{globals}['__builtins__']['open']('{marker}', 'w')",
        "{globals}['__builtins__']['open']('{folder}/made', 'w')",
        "{globals}['__builtins__']['open']('{secret}').read()",
        "{globals}['mkdir']('{marker}')",
        "{globals}['symlink']('{secret}', '{folder}/link')",
        "{globals}['kill']({pid}, 15)",
        "{globals}['execv']('/bin/touch', ['touch', '{marker}'])",
        "{import}('subprocess').run(['touch', '{marker}'])",
        "{import}('urllib.request').request.urlopen('http://127.0.0.1:{port}').read()",
        "{import}('ctypes').CDLL(None).open(b'{marker}', 65, 511)",
        "{import}('posix').listdir('{outside}')",
        "{import}('os').fork() or {globals}['system']('touch {marker}')",
    ],
)
def test_what_a_xacro_runs_reaches_nothing(folder: Path, does: str) -> None:
    asked: list[str] = []

    class Heard(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            asked.append(self.path)

    with http.server.HTTPServer(("127.0.0.1", 0), Heard) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        before = sorted(folder.parent.rglob("*"))
        words = {
            "globals": GLOBALS, "import": IMPORT, "marker": folder.parent / "marker",
            "folder": folder, "outside": folder.parent, "secret": folder.parent / "secret.yaml",
            "pid": os.getpid(), "port": server.server_port,
        }  # fmt: skip
        code = does.format(**words)
        try:
            text = expanded(folder, f'<link name="${{(lambda: {code})()}}"/>')
        except BadInput as refused:
            text = str(refused)
        server.shutdown()
    assert "secret_word" not in text
    assert not asked
    made = set(folder.parent.rglob("*")) - set(before)
    assert made == {folder / "r.urdf.xacro"}


def test_without_a_wall_no_xacro_is_expanded(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(restrictions, "layers", lambda: {"landlock": False, "seccomp": True})
    with refused(XACRO_NO_WALL, BadInput, file="r.urdf.xacro", plain="r.urdf"):
        expanded(folder, LINK.format("a"))


def test_a_xacro_is_known_by_what_it_holds(folder: Path) -> None:
    path = folder / "r.urdf"
    path.write_text(XACRO.format('<xacro:arg name="n" default="a"/><link name="$(arg n)"/>'))
    assert '<link name="b"/>' in description_text(path, {}, ("n:=b",))
