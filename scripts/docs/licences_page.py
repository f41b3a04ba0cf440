"""Writes docs/licences.md: the licence of every package that a lock file names."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path

PAGE = "docs/licences.md"
LOCKED = re.compile(r"^([a-z0-9][a-z0-9._-]*)==", re.M)
# What the project accepts, alone or as one of a choice. Weak copyleft (MPL, EPL) is accepted for
# what is installed beside the lab and not changed; GPL, LGPL and AGPL are not.
ALLOWED = {
    *("0BSD", "Apache-2.0", "BSD", "BSD-2-Clause", "BSD-3-Clause", "BlueOak-1.0.0", "CC0-1.0"),
    *("CNRI-Python", "EPL-2.0", "ISC", "MIT", "MIT-0", "MIT-CMU", "MPL-2.0", "PSF-2.0", "Zlib"),
}
# As metadata and manifests write them.
SPELLINGS = {
    "Apache 2.0": "Apache-2.0",
    "Apache License 2.0": "Apache-2.0",
    "Apache License, Version 2.0": "Apache-2.0",
    "Apache Software License": "Apache-2.0",
    "BSD License": "BSD",
    "Eclipse Public License 2.0 (EPL-2.0)": "EPL-2.0",
    "ISC License (ISCL)": "ISC",
    "MIT License": "MIT",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
    "zlib License": "Zlib",
    "zlib/libpng License": "Zlib",
}
# Packages whose metadata does not say it, says it in a text of its own, or that other systems and
# other Pythons alone install; read from their licence files.
READ = {
    "@webxr-input-profiles/assets": "MIT",
    "apsw": "Zlib",
    "atheris": "Apache-2.0",
    "coloredlogs": "MIT",
    # One file for Emacs is under the GPL; it is not installed.
    "docutils": "BSD-2-Clause",
    "embreex": "BSD-3-Clause",
    "exceptiongroup": "MIT",
    "humanfriendly": "MIT",
    "importlib-resources": "Apache-2.0",
    "pyreadline3": "BSD",
    "pywin32": "PSF-2.0",
    "ros-fastcdr": "Apache-2.0",
    "ros-fastrtps": "Apache-2.0",
    "setuptools": "MIT",
    "tomli": "MIT",
    "vhacdx": "BSD-3-Clause",
    "xacro": "BSD-3-Clause",
}


def allowed(licence: str) -> bool:
    """Return whether an SPDX expression of names, AND, OR and brackets is accepted."""
    words = re.sub(r"[()]", " ", licence)
    return all(
        any(part.strip() in ALLOWED for part in each.split(" OR "))
        for each in words.split(" AND ")
    )


def of_package(name: str, root: Path) -> str | None:
    """Return the licence of an installed Python package, or None where nothing says it."""
    if name in READ:
        return READ[name]
    manifest = root / f".venv/share/{re.sub('^ros-(jazzy-)?', '', name).replace('-', '_')}"
    if name.startswith("ros-") and (manifest / "package.xml").is_file():
        found = [e.text or "" for e in ET.parse(manifest / "package.xml").iter("license")]
        return " AND ".join(SPELLINGS.get(each.strip(), each.strip()) for each in found)
    try:
        data = metadata.metadata(name)
    except metadata.PackageNotFoundError:
        return None
    if expression := data.get("License-Expression"):
        return str(expression)
    classifiers = data.get_all("Classifier") or []
    stated = [c.split(" :: ")[-1] for c in classifiers if c.startswith("License ::")]
    stated = [each for each in stated if each not in ("DFSG approved", "OSI Approved")]
    stated = stated or [str(data.get("License") or "").partition("\n")[0]]
    return " OR ".join(sorted(SPELLINGS.get(each, each) for each in stated)) or None


def python_packages(root: Path, lock: str, before: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Yield each package of a lock file with its licence; `before`: those that the page has."""
    for name in sorted(set(LOCKED.findall((root / lock).read_text()))):
        licence = of_package(name, root) or before.get(name)
        if licence is None:
            raise SystemExit(
                f"{name} of {lock} is not installed here, or says no licence; read its licence "
                "file and add it to READ in scripts/docs/licences_page.py"
            )
        yield name, licence


def npm_packages(root: Path, of_pages: bool) -> Iterator[tuple[str, str]]:
    """Yield the npm packages that are in the pages, or those that build and test them."""
    packages = json.loads((root / "web" / "package-lock.json").read_text())["packages"]
    for path, package in packages.items():
        if path and bool(package.get("dev")) != of_pages:
            name = path.rpartition("node_modules/")[2]
            yield name, READ.get(name) or package.get("license") or "not stated"


def table(packages: Iterable[tuple[str, str]]) -> str:
    """Return a table of licences and their packages; raise SystemExit where one is refused."""
    by_licence = defaultdict(set)
    for name, licence in packages:
        if not allowed(licence):
            raise SystemExit(
                f"{name} is under {licence}, which is not in ALLOWED of "
                "scripts/docs/licences_page.py; take another package, or add it with a reason"
            )
        by_licence[licence].add(name)
    rows = (f"| {each} | {', '.join(sorted(by_licence[each]))} |" for each in sorted(by_licence))
    return "\n".join(("| licence | packages |", "|---|---|", *rows))


def written(root: Path) -> dict[str, str]:
    """Return the licences of the packages that the page names now."""
    page = root / PAGE
    rows = re.findall(r"^\| (.+?) \| (.+) \|$", page.read_text() if page.is_file() else "", re.M)
    return {name: licence for licence, names in rows for name in names.split(", ")}


def current(root: Path) -> str:
    """Return the page for the lock files and what is installed from them."""
    before = written(root)
    lab = list(python_packages(root, "requirements.lock", before))
    names = {name for name, _ in lab}
    tools = [
        each
        for lock in ("requirements-dev.lock", "requirements-docs.lock")
        for each in python_packages(root, lock, before)
        if each[0] not in names
    ]
    ros = [each for each in lab if each[0].startswith("ros-")]
    return f"""# Licences

<!-- Written by `make docs`. -->

MR-Lab is under the [Apache License 2.0](../LICENSE). Below is the licence of every package that
the lock files name, those that others bring along included, as its metadata states it (`AND`: all
hold, `OR`: take one; `BSD`: it does not say which). A licence that is not in `ALLOWED` of
`scripts/docs/licences_page.py`, such as the GPL, fails the tests. Libraries that a wheel carries
inside, such as GEOS (LGPL-2.1) in `shapely`, are named in the wheel alone.
[dependencies.md](dependencies.md) says what each package is for.

## The lab

What set-up installs to build and run it.

{table(each for each in lab if each not in ros)}

## ROS 2 as wheels

{table(ros)}

## In the pages

npm packages whose code is in the pages that the gateway serves; their notices are in
`licences.md` beside the built pages. The models of controllers and hands are files of
`@webxr-input-profiles/assets` (MIT).

{table(npm_packages(root, True))}

## Tests, checks and this site

Not part of the lab.

{table(tools)}

npm packages that build and test the pages:

{table(npm_packages(root, False))}

Programs that tests run where they are installed: GNU Octave (GPL-3.0), `check_urdf` (BSD),
Chromium (BSD), sqlite3 (public domain). They are no part of the lab, and nothing links to them.
"""
