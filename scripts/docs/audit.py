"""Lists every locked package with its licence, and the advisories that files of OSV have for it.

python scripts/docs/audit.py [PyPI.zip npm.zip ...]; nothing is fetched. The files are exports of
OSV, one an ecosystem: https://osv-vulnerabilities.storage.googleapis.com/PyPI/all.zip, and
npm/all.zip. The exit status is 1 where an advisory affects a locked version, and 2 where no file
is of an ecosystem that is locked.
"""

from __future__ import annotations

import json
import re
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import licences_page
from packaging.version import InvalidVersion, Version

ROOT = Path(__file__).parents[2]
LOCKED = re.compile(r"^([a-z0-9][a-z0-9._-]*)==([^\s;\\]+)", re.M)


def locked(root: Path) -> dict[tuple[str, str, str], str]:
    """Return the licence of each locked package by ecosystem, name and version."""
    known = licences_page.written(root)
    found = {}
    for lock in sorted(root.glob("requirements*.lock")):
        for name, version in LOCKED.findall(lock.read_text()):
            found["PyPI", name, version] = known.get(name, "not stated")
    packages = json.loads((root / "web" / "package-lock.json").read_text())["packages"]
    for path, package in packages.items():
        if path:
            name = path.rpartition("node_modules/")[2]
            found["npm", name, package["version"]] = known.get(name, "not stated")
    return found


def advisories(file: Path) -> Iterator[dict[str, Any]]:
    """Yield the advisories of an export that are not withdrawn."""
    with zipfile.ZipFile(file) as archive:
        for name in archive.namelist():
            advisory = json.loads(archive.read(name))
            if not advisory.get("withdrawn"):
                yield advisory


def affects(entry: dict[str, Any], version: str) -> bool:
    """Return whether an entry of `affected` has a version; one that cannot be compared counts."""
    if version in entry.get("versions", ()):
        return True
    ranges = [each for each in entry.get("ranges", ()) if each["type"] != "GIT"]
    return any(_within(each["events"], version) for each in ranges)


def _within(events: list[dict[str, str]], version: str) -> bool:
    try:
        now, inside = Version(version), False
        steps = [(Version(at), kind) for event in events for kind, at in event.items()]
    except InvalidVersion:
        return True
    for at, kind in sorted(steps, key=lambda step: step[0]):
        if kind == "introduced" and now >= at:
            inside = True
        elif (kind == "fixed" and now >= at) or (kind == "last_affected" and now > at):
            inside = False
    return inside


def normal(ecosystem: str, name: str) -> tuple[str, str]:
    return ecosystem, re.sub(r"[-_.]+", "-", name).lower() if ecosystem == "PyPI" else name


def found(root: Path, files: list[Path]) -> tuple[list[str], set[str]]:
    """Return a line for each advisory about a locked version, and the ecosystems covered."""
    versions: dict[tuple[str, str], set[str]] = {}
    for ecosystem, name, version in locked(root):
        versions.setdefault(normal(ecosystem, name), set()).add(version)
    lines, covered = set(), set()
    for file in files:
        for advisory in advisories(file):
            for entry in advisory.get("affected", ()):
                package = entry.get("package", {})
                ecosystem = package.get("ecosystem", "")
                covered.add(ecosystem)
                for version in versions.get(normal(ecosystem, package.get("name", "")), ()):
                    if affects(entry, version):
                        said = advisory.get("summary") or advisory.get("details", "")[:100]
                        lines.add(f"{package['name']} {version}: {advisory['id']} {said}")
    return sorted(lines), covered


def main(files: list[str]) -> int:
    """Print the list and the advisories; return the exit status."""
    packages = locked(ROOT)
    for (ecosystem, name, version), licence in sorted(packages.items()):
        print(f"{ecosystem}\t{name}\t{version}\t{licence}")
    lines, covered = found(ROOT, [Path(file) for file in files])
    missing = sorted({ecosystem for ecosystem, _, _ in packages} - covered)
    print(*lines, sep="\n")
    print(f"{len(packages)} packages, {len(lines)} advisories", end="")
    print(f"; without a file of advisories: {', '.join(missing)}" if missing else "")
    return 1 if lines else 2 if missing and files else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
