"""Advisories that concern a locked package, from files as OSV exports them."""

from __future__ import annotations

import json
import re
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "docs"))

import audit  # noqa: E402


def exported(path: Path, *affected: dict[str, Any], **more: Any) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for number, entry in enumerate(affected):
            advisory = {"id": f"X-{number}", "summary": "bad", "affected": [entry], **more}
            archive.writestr(f"X-{number}.json", json.dumps(advisory))
    return path


def entry(
    ecosystem: str, name: str, *events: dict[str, str], versions: tuple[str, ...] = ()
) -> Any:
    ranges = [{"type": "ECOSYSTEM", "events": list(events)}] if events else []
    package = {"ecosystem": ecosystem, "name": name}
    return {"package": package, "versions": list(versions), "ranges": ranges}


def test_an_advisory_counts_for_the_versions_that_it_names(tmp_path: Path) -> None:
    names = {(e, n): v for e, n, v in audit.locked(ROOT)}
    numpy, three = names["PyPI", "numpy"], names["npm", "three"]
    file = exported(
        tmp_path / "all.zip",
        entry("PyPI", "NumPy", versions=(numpy,)),
        entry("PyPI", "numpy", {"introduced": "0"}, {"fixed": "0.1"}),
        entry("npm", "three", {"introduced": "0"}, {"last_affected": three}),
        entry("npm", "three", {"introduced": "0"}, {"fixed": three}),
        entry("npm", "three-of-others", {"introduced": "0"}),
    )
    lines, covered = audit.found(ROOT, [file])
    assert [re.findall("X-[0-9]", line) for line in lines] == [["X-0"], ["X-2"]]
    assert covered == {"PyPI", "npm"}
    gone = exported(
        tmp_path / "gone.zip", entry("PyPI", "numpy", versions=(numpy,)), withdrawn="x"
    )
    assert audit.found(ROOT, [gone])[0] == []


@pytest.mark.parametrize("version", ["1.5", "not a version"])
def test_what_lies_in_a_range_or_cannot_be_compared_counts(version: str) -> None:
    events = ({"introduced": "1.0"}, {"fixed": "2.0"}, {"introduced": "3.0"})
    assert audit.affects(entry("PyPI", "x", *events), version)
    assert not audit.affects(entry("PyPI", "x", *events), "2.5")
