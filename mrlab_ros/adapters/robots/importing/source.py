"""Finds a robot description, the packages and the files that it names, and expands xacro."""

from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from xml.parsers.expat import errors

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.adapters import installed
from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE, NOT_UTF8
from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.importing.diagnostics import (
    BAD_XACRO_ARGUMENT,
    MESH_NO_FILE,
    MESH_NO_PACKAGE,
    MESH_OUTSIDE,
    NO_DESCRIPTION,
    NO_XACRO,
    PACKAGE_DESCRIPTIONS,
    PACKAGE_NO_FILE,
    UNBOUND_PREFIX,
    URDF_TOO_LARGE,
    XACRO_NO_WALL,
)
from mrlab_ros.adapters.robots.importing.expansion import expand
from mrlab_ros.adapters.sandbox import calls, restrictions
from mrlab_ros.core.base.errors import BadInput

SUFFIXES = (".urdf", ".xacro")
XACRO_ELEMENT = "<xacro:"
MOST_BYTES = 64 << 20  # of a URDF
XACRO = "http://www.ros.org/wiki/xacro"
UNBOUND = errors.codes[errors.XML_ERROR_UNBOUND_PREFIX]
OTHERS = 0o077  # what the mode of a file or folder gives to others than its owner


def find_description(source: str) -> Path:
    """Return the URDF or xacro for a path, a ROS package's name, or PACKAGE/PATH inside it.

    Raises BadInput where there is none, or names those of a package with several.
    """
    path = Path(source)
    if path.is_file():
        return path
    package, _, inside = source.partition("/")
    try:
        share = Path(get_package_share_directory(package))
    except (PackageNotFoundError, ValueError):
        raise BadInput(NO_DESCRIPTION(source=source)) from None
    if inside:
        if not (share / inside).is_file():
            raise BadInput(PACKAGE_NO_FILE(package=package, file=inside, known=_names(share)))
        return share / inside
    found = sorted(share.rglob("*.urdf")) or sorted(share.rglob("*.urdf.xacro"))
    if len(found) != 1:
        names = _names(share)
        raise BadInput(
            PACKAGE_DESCRIPTIONS(
                package=package, count=len(names), known=names, first=next(iter(names), None)
            )
        )
    return found[0]


def _names(share: Path) -> list[str]:
    found = (*sorted(share.rglob("*.urdf")), *sorted(share.rglob("*.urdf.xacro")))
    return [str(file.relative_to(share)) for file in found]


def packages_around(path: Path) -> dict[str, Path]:
    """Return the ROS packages in whose source tree a file lies: its own, and those beside it."""
    own = next((f for f in path.resolve().parents if (f / "package.xml").is_file()), None)
    if own is None:
        return {}
    found: dict[str, Path] = {}
    for manifest in (*own.parent.glob("*/package.xml"), own / "package.xml"):
        if not manifest.resolve().is_relative_to(own.parent):
            continue  # a link: what came with the description may not name any folder a package
        name = _package_name(manifest)
        if name:
            found[name] = manifest.parent
    return found


def _package_name(manifest: Path) -> str:
    try:
        return (ET.parse(manifest).getroot().findtext("name") or "").strip()
    except (ET.ParseError, OSError):
        return ""


def description_text(
    path: Path, packages: Mapping[str, Path], arguments: Sequence[str] = ()
) -> str:
    """Return the URDF's text; a xacro is expanded with NAME:=VALUE arguments.

    A file that ends in .xacro is one, and any that holds elements of it. packages: folders that
    $(find NAME) means, before installed ones. Raises BadInput where the file cannot be read, or
    xacro refuses it.
    """
    if path.suffix != ".xacro":
        try:
            if path.stat().st_size > MOST_BYTES:
                raise BadInput(URDF_TOO_LARGE(file=str(path), most=MOST_BYTES))
            plain_text = path.read_text(encoding="utf-8")
        except OSError as error:
            why = error.strerror or str(error)
            raise BadInput(FILE_UNREADABLE(file=str(path), why=why)) from None
        except UnicodeDecodeError:
            raise BadInput(NOT_UTF8(file=str(path))) from None
        if XACRO_ELEMENT not in plain_text:
            if arguments:
                raise BadInput(NO_XACRO(file=path.name, arguments=[*arguments]))
            return plain_text
    given = dict(_argument(text) for text in arguments)
    _check_prefixes(path)
    if not all(restrictions.layers().values()):
        plain = f"{path.stem.removesuffix('.urdf')}.urdf"
        raise BadInput(XACRO_NO_WALL(file=path.name, plain=plain))
    with _prefix(packages) as prefix:
        prefixes = [prefix, *filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(":"))]
        folders = [path.parent, *packages.values(), *installed.packages()]
        shown = [child for folder in folders for child in _shown(folder.resolve())]
        text: str = calls.call(
            expand, str(path.resolve()), given, name=path.name,
            read=[Path(prefix), *installed.indices(), *shown],
            environment={"AMENT_PREFIX_PATH": ":".join(prefixes)},
        )  # fmt: skip
    # file:// URIs name the folder that is gone now.
    for name, folder in packages.items():
        text = text.replace(f"{prefix}/share/{name}/", f"{folder.resolve()}/")
    return text


def _check_prefixes(path: Path) -> None:
    """Raise BadInput where a xacro uses a prefix that it does not declare."""
    try:
        text = path.read_text(encoding="utf-8")
        if "<!DOCTYPE" not in text and "<!ENTITY" not in text:
            ET.fromstring(text)
    except (OSError, UnicodeDecodeError):
        pass  # xacro says so
    except ET.ParseError as error:
        line = error.position[0]
        here = urdf.PREFIX.findall(text.splitlines()[line - 1])
        unbound = [name for name in here if name not in urdf.DECLARED.findall(text)]
        if error.code == UNBOUND and unbound:
            uri = XACRO if unbound[0] == "xacro" else unbound[0]
            found = UNBOUND_PREFIX(file=path.name, prefix=unbound[0], line=line, uri=uri)
            raise BadInput(found) from None


class MeshFinder:
    """Finds the files of mesh URIs: in the given folders of packages, then in installed ones.

    base: the folder of the description. What it finds lies, links followed, below one of them: a
    description brings no other file of the machine along.
    """

    def __init__(self, base: Path, packages: Mapping[str, Path]) -> None:
        self.base = base
        self.packages = packages
        named = {folder.resolve() for folder in (base, *packages.values())}
        self.folders = (*sorted(named), *installed.packages())

    def __call__(self, uri: str) -> Path:
        """Return the path of a URI; raise BadInput where its package or its place is none."""
        try:
            path = self._place(uri).resolve()
        except (OSError, ValueError, RuntimeError) as error:  # a loop of links, a NUL
            raise BadInput(MESH_NO_FILE(mesh=uri, why=str(error))) from None
        if not any(path.is_relative_to(folder) for folder in self.folders):
            raise BadInput(MESH_OUTSIDE(mesh=uri, path=str(path)))
        return path

    def _place(self, uri: str) -> Path:
        if uri.startswith("package://"):
            package, _, rest = uri.removeprefix("package://").partition("/")
            if package in self.packages:
                return self.packages[package] / rest
            try:
                return Path(get_package_share_directory(package)) / rest
            except (PackageNotFoundError, ValueError):
                raise BadInput(MESH_NO_PACKAGE(package=package, mesh=uri)) from None
        return self.base / uri.removeprefix("file://")


def _shown(folder: Path) -> list[Path]:
    """Return what lies in a folder; nothing hidden, such as .git with its addresses.

    Nothing either that is closed to other users in a folder that is not, such as a lab's keys.
    """
    if not folder.is_dir():
        return [folder]
    closed = not folder.stat().st_mode & OTHERS
    return [
        child
        for child in folder.iterdir()
        if not child.name.startswith(".")
        and child.exists()  # no link to nowhere
        and child.resolve().is_relative_to(folder)
        and (closed or child.stat().st_mode & OTHERS)
    ]


def _argument(text: str) -> tuple[str, str]:
    name, assigned, value = text.partition(":=")
    if not assigned or not name:
        raise BadInput(BAD_XACRO_ARGUMENT(argument=text))
    return name, value


@contextmanager
def _prefix(packages: Mapping[str, Path]) -> Iterator[str]:
    """Yield a folder in which ament's index finds the packages of these folders."""
    with tempfile.TemporaryDirectory(prefix="mrlab-") as made:
        index = Path(made, "share", "ament_index", "resource_index", "packages")
        index.mkdir(parents=True)
        for name, folder in packages.items():
            (index / name).touch()
            Path(made, "share", name).symlink_to(folder.resolve())
        yield made
