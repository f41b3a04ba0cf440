"""Finds the descriptions that robots were taken from in clones of their repositories.

A clone may be bare, partial or a plain copy without git. What is needed of it is read from git's
objects at the commit that robot.yaml states, so what is checked out does not matter.
"""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.robots.diagnostics import NO_CLONE, NOT_CLONED
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_shell

TEXTS = (".xacro", ".urdf", ".xml", ".yaml")  # of which a description is made
NOTICE = re.compile(r"(?i)(^|/)(licen[cs]e|notice|copying|copyright)[^/]*$")
REMOTE = re.compile(r"://|^git@|^[\w.-]+@[\w.-]+:")
DEPTH = 2  # folders below the given one in which a clone is looked for
WAIT = 600.0  # s, of one call of git


@dataclass(frozen=True)
class Pinned:
    """The description of a robot: a file of a repository, its arguments, and what it is under."""

    repository: str
    commit: str
    path: str
    licence: str
    arguments: tuple[str, ...] = ()

    @property
    def address(self) -> str:
        return f"https://github.com/{self.repository}"

    @property
    def names(self) -> tuple[str, ...]:
        """The files of the repository that may be the description, the best first."""
        whole = self.path.replace("_macro", "")
        return (whole.replace(".xacro", ".urdf.xacro"), whole, self.path)


def pinned(facts: Mapping[str, Any]) -> Pinned | None:
    """Return what robot.yaml states; None where that is the description of another product."""
    source: dict[str, Any] = next(iter(facts.get("sources", ())), {})
    if "model_in_source" in source or "commit" not in source:
        return None
    arguments = tuple(map(str, source.get("arguments", ())))
    repository, commit, path, licence = (
        str(source[key]) for key in ("repository", "commit", "path", "licence")
    )
    return Pinned(repository, commit, path, licence, arguments)


@dataclass(frozen=True)
class Clone:
    """A repository on this machine; commit: empty for a plain copy, whose files are read."""

    folder: Path
    commit: str

    def files(self) -> list[str]:
        """Return the names of its files."""
        if not self.commit:
            files = (file for file in self.folder.rglob("*") if file.is_file())
            return [file.relative_to(self.folder).as_posix() for file in files]
        listed = _git(self.folder, "ls-tree", "-r", "-z", "--name-only", self.commit)
        return listed.stdout.decode().split("\0")[:-1]

    def copy(self, names: Sequence[str], target: Path) -> None:
        """Copy files below a folder; those whose contents a partial clone lacks are left out."""
        for name, content in self._contents(names):
            file = target / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)

    def _contents(self, names: Sequence[str]) -> Iterator[tuple[str, bytes]]:
        if not self.commit:
            for name in names:
                if not (self.folder / name).is_symlink():
                    yield name, (self.folder / name).read_bytes()
            return
        asked = "".join(f"{self.commit}:{name}\n" for name in names if "\n" not in name)
        told = _git(self.folder, "cat-file", "--batch", stdin=asked.encode()).stdout
        at = 0
        for name in names:
            end = told.find(b"\n", at)
            head, at = told[at:end].split(), end + 1
            if len(head) == 3 and head[1] == b"blob":
                size = int(head[2])
                yield name, told[at : at + size]
                at += size + 1


def find_clone(place: Path, source: Pinned) -> Clone:
    """Return the clone of a repository at `place` or below it.

    Raises BadInput, with the commands that fetch it, where none has the pinned commit.
    """
    stale = None
    for folder in (
        place,
        *(f for n in range(1, DEPTH + 1) for f in place.glob("/".join("*" * n))),
    ):
        if (folder / ".git").exists() or (folder / "objects").is_dir():
            wanted = f"{source.commit}:{source.path}"
            if _git(folder, "cat-file", "-t", wanted).stdout.strip() == b"blob":
                return Clone(folder, source.commit)
            name = source.repository.rpartition("/")[2]
            if name in str(folder):
                stale = folder
        elif (folder / source.path).is_file():
            return Clone(folder, "")
    name = source.repository.rpartition("/")[2]
    if stale is not None:
        command = for_shell(["git", "-C", str(stale), "fetch", "origin", source.commit])
        found = NOT_CLONED(folder=str(stale), commit=source.commit, repository=source.repository)
    else:
        command = for_shell(["git", "clone", source.address, str(place / name)])
        found = NO_CLONE(repository=source.repository, folder=str(place), commit=source.commit)
    raise BadInput(replace(found, fixes=(Fix(command=command),)))


def cloned(address: str, target: Path) -> Path:
    """Clone a repository, contents on demand; return its folder. Raises BadInput."""
    folder = target / (address.rstrip("/").rpartition("/")[2].removesuffix(".git") or "clone")
    told = _git(
        target, "clone", "--bare", "--filter=blob:none", "--quiet", "--", address, str(folder)
    )
    if told.returncode:
        why = told.stderr.decode(errors="replace").strip().splitlines()[-1:]
        raise BadInput(NO_CLONE(repository=address, folder=str(target), why=" ".join(why)))
    return folder


def _git(folder: Path, *words: str, stdin: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    # Hooks, pagers and questions are for people.
    command = ["git", "-C", str(folder), "-c", "core.hooksPath=/dev/null", *words]
    try:
        return subprocess.run(
            command, input=stdin, capture_output=True, timeout=WAIT, check=False,
            env={**os.environ, "GIT_TERMINAL_PROMPT": "0"},
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired) as error:
        raise BadInput(NO_CLONE(repository="git", folder=str(folder), why=str(error))) from None
