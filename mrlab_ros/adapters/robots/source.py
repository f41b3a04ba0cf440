"""Finds a robot description, the packages and the files that it names, and expands xacro."""

from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.adapters import installed, wall, walled
from mrlab_ros.adapters.robots.expansion import expand
from mrlab_ros.core.errors import BadInput

SUFFIXES = (".urdf", ".xacro")
MOST_BYTES = 64 << 20  # of a URDF


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
        raise BadInput(
            f"'{source}' is neither a file nor an installed ROS package; give the path of a URDF "
            "or a xacro"
        ) from None
    if inside:
        if not (share / inside).is_file():
            raise BadInput(
                f"package '{package}' has no file {inside}; its descriptions: {_names(share)}"
            )
        return share / inside
    found = sorted(share.rglob("*.urdf")) or sorted(share.rglob("*.urdf.xacro"))
    if len(found) != 1:
        raise BadInput(
            f"package '{package}' holds these descriptions: {_names(share)}; name the one you "
            f"want, such as {package}/{_names(share).split(', ')[0]}"
        )
    return found[0]


def _names(share: Path) -> str:
    found = (*sorted(share.rglob("*.urdf")), *sorted(share.rglob("*.urdf.xacro")))
    return ", ".join(str(file.relative_to(share)) for file in found) or "none"


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
    """Return the URDF's text; a file that ends in .xacro is expanded with NAME:=VALUE arguments.

    packages: folders that $(find NAME) means, before installed ones. Raises BadInput where the
    file cannot be read, or xacro refuses it.
    """
    if path.suffix != ".xacro":
        if arguments:
            raise BadInput(
                f"{path.name} is no xacro and takes no arguments; leave out {' '.join(arguments)}"
            )
        try:
            if path.stat().st_size > MOST_BYTES:
                raise BadInput(f"{path} is larger than {MOST_BYTES >> 20} MiB; expected a URDF")
            return path.read_text(encoding="utf-8")
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {error}; expected a URDF") from None
        except UnicodeDecodeError:
            raise BadInput(f"{path} is not UTF-8 text; save it as UTF-8") from None
    given = dict(_argument(text) for text in arguments)
    if not all(wall.layers().values()):
        raise BadInput(
            f"{path.name} is a xacro, which is a program, and the kernel here cannot wall it off "
            "(expected Landlock and seccomp); where you trust it, expand it yourself and "
            f"import what comes out: xacro {path.name} > {path.stem.removesuffix('.urdf')}.urdf"
        )
    with _prefix(packages) as prefix:
        prefixes = [prefix, *filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(":"))]
        folders = [path.parent, *packages.values(), *installed.packages()]
        shown = [child for folder in folders for child in _shown(folder.resolve())]
        text: str = walled.call(
            expand, str(path.resolve()), given, name=path.name,
            read=[Path(prefix), *installed.indices(), *shown],
            environment={"AMENT_PREFIX_PATH": ":".join(prefixes)},
        )  # fmt: skip
    # file:// URIs name the folder that is gone now.
    for name, folder in packages.items():
        text = text.replace(f"{prefix}/share/{name}/", f"{folder.resolve()}/")
    return text


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
            raise BadInput(f"{uri} names no file: {error}") from None
        if not any(path.is_relative_to(folder) for folder in self.folders):
            raise BadInput(
                f"{uri} is {path}, which is neither beside the description nor in a package"
            )
        return path

    def _place(self, uri: str) -> Path:
        if uri.startswith("package://"):
            package, _, rest = uri.removeprefix("package://").partition("/")
            if package in self.packages:
                return self.packages[package] / rest
            try:
                return Path(get_package_share_directory(package)) / rest
            except (PackageNotFoundError, ValueError):
                raise BadInput(f"package '{package}' of mesh {uri} is not installed") from None
        return self.base / uri.removeprefix("file://")


def _shown(folder: Path) -> list[Path]:
    """Return what lies in a folder; nothing hidden, such as keys or .git with its addresses."""
    return [
        child
        for child in folder.iterdir()
        if not child.name.startswith(".") and child.resolve().is_relative_to(folder)
    ]


def _argument(text: str) -> tuple[str, str]:
    name, assigned, value = text.partition(":=")
    if not assigned or not name:
        raise BadInput(f"the argument is '{text}'; expected NAME:=VALUE, as xacro takes it")
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
