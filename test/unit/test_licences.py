"""Which licences the project accepts; test_docs.py compares the page with the lock files."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "docs"))

import licences_page  # noqa: E402


@pytest.mark.parametrize(
    ("licence", "accepted"),
    [
        ("MIT", True),
        ("GPL-3.0-only", False),
        ("LGPL-2.1", False),
        ("GPL-3.0-only OR MIT", True),
        ("MIT AND GPL-3.0-only", False),
        ("MPL-2.0 AND (Apache-2.0 OR MIT)", True),
        ("", False),
        ("UNKNOWN", False),
    ],
)
def test_a_choice_needs_one_accepted_licence_and_a_sum_all(licence: str, accepted: bool) -> None:
    assert licences_page.allowed(licence) is accepted


def test_a_package_under_another_licence_is_named() -> None:
    with pytest.raises(SystemExit, match="readline is under GPL-3.0-only"):
        licences_page.table([("click", "BSD-3-Clause"), ("readline", "GPL-3.0-only")])


def test_a_package_that_is_not_installed_keeps_the_licence_of_the_page(tmp_path: Path) -> None:
    (tmp_path / "some.lock").write_text("only-on-windows==1.0 \\\n")
    found = licences_page.python_packages(tmp_path, "some.lock", {"only-on-windows": "MIT"})
    assert list(found) == [("only-on-windows", "MIT")]
    with pytest.raises(SystemExit, match="only-on-windows of some.lock"):
        list(licences_page.python_packages(tmp_path, "some.lock", {}))
