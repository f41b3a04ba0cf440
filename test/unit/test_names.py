"""The test of a module lies at the module's path: a newcomer finds it by its name."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "mrlab_ros"
# A module of more lines has a test of its own.
SMALL = 60
# A room's table of diagnostics is tested by test_codes, what starts a process by the labs.
NAMELESS = {"__init__", "__main__", "diagnostics"}
# So many are proved by tests of their room, of the graph or of a lab alone; it may only shrink.
ELSEWHERE = 230


def test_a_module_has_a_test_of_its_name() -> None:
    without = [
        str(path.relative_to(PACKAGE))
        for path in sorted(PACKAGE.rglob("*.py"))
        if path.stem not in NAMELESS
        and len(path.read_text().splitlines()) > SMALL
        and not own_test(path).exists()
    ]
    assert len(without) <= ELSEWHERE, "\n".join(without)


def own_test(module: Path) -> Path:
    """Return where the unit tests of a module lie."""
    folder = ROOT / "test" / "unit" / module.parent.relative_to(PACKAGE)
    return folder / f"test_{module.name}"
