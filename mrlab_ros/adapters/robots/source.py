"""Finds a robot description and the packages it names, and expands xacro."""

from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.core.errors import BadInput

SUFFIXES = (".urdf", ".xacro")


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
            return path.read_text(encoding="utf-8")
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {error}; expected a URDF") from None
        except UnicodeDecodeError:
            raise BadInput(f"{path} is not UTF-8 text; save it as UTF-8") from None
    given = dict(_argument(text) for text in arguments)
    import xacro

    with _prefix(packages) as prefix:
        try:
            text = str(xacro.process_file(str(path), mappings=given).toprettyxml(indent="  "))
        except Exception as error:  # xacro evaluates Python: anything can come out of it
            asks = " as NAME:=VALUE" if "rgument" in str(error) else ""
            hint = (
                "; give the folder of a package with --package NAME=FOLDER"
                if isinstance(error, PackageNotFoundError) or "not found" in str(error)
                else f"; give what it asks for{asks}, or correct the file"
            )
            raise BadInput(f"{path.name}: xacro says: {error}{hint}") from None
    # file:// URIs name the folder that is gone now.
    for name, folder in packages.items():
        text = text.replace(f"{prefix}/share/{name}/", f"{folder.resolve()}/")
    return text


def _argument(text: str) -> tuple[str, str]:
    name, assigned, value = text.partition(":=")
    if not assigned or not name:
        raise BadInput(f"the argument is '{text}'; expected NAME:=VALUE, as xacro takes it")
    return name, value


@contextmanager
def _prefix(packages: Mapping[str, Path]) -> Iterator[str]:
    """Let ament's index find the packages in these folders, before installed ones; yield the
    prefix that says so."""
    before = os.environ.get("AMENT_PREFIX_PATH", "")
    with tempfile.TemporaryDirectory(prefix="mrlab-") as made:
        index = Path(made, "share", "ament_index", "resource_index", "packages")
        index.mkdir(parents=True)
        for name, folder in packages.items():
            (index / name).touch()
            Path(made, "share", name).symlink_to(folder.resolve())
        os.environ["AMENT_PREFIX_PATH"] = f"{made}:{before}" if before else made
        try:
            yield made
        finally:
            os.environ["AMENT_PREFIX_PATH"] = before
