"""All tables of diagnostics, and that each code is called with the values of its texts."""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "docs"))

import diagnostics_page  # noqa: E402

from mrlab_ros.core.base.diagnostic import Code  # noqa: E402

TABLES = diagnostics_page.tables(ROOT)
CODES = [(module, code) for module, codes in TABLES.items() for code in codes.values()]
# What only a command line has; its texts are worded where it is.
OF_THE_TERMINAL = re.compile(r"(^|[\s(])--[a-z]|\bmrlab [a-z]|\bctrl-c\b", re.IGNORECASE)


def test_each_code_is_declared_once_and_named_as_its_constant():
    assert [k for k, n in Counter(code.code for _, code in CODES).items() if n > 1] == []
    wrong = [(k, c.code) for codes in TABLES.values() for k, c in codes.items() if not c.code]
    assert wrong == []
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", code.code) for _, code in CODES)


def test_each_text_is_filled_in_with_sample_values():
    assert [c.code for _, c in CODES if not c(**diagnostics_page.sample(c)).message] == []


def test_what_a_page_shows_names_nothing_of_the_terminal():
    shown = [c for module, c in CODES if not module.startswith(diagnostics_page.TERMINAL)]
    assert [c.code for c in shown if OF_THE_TERMINAL.search(f"{c.text}\n{c.remedy}")] == []


@cache
def calls() -> list[tuple[str, Code, ast.Call]]:
    """Return each call of a code in the package: where, of which code."""
    found = []
    for path in sorted(ROOT.joinpath("mrlab_ros").rglob("*.py")):
        tree = ast.parse(path.read_text())
        names: dict[str, Code] = {}
        modules: dict[str, dict[str, Code]] = {}
        for node in ast.walk(tree):
            if not isinstance(node, ast.ImportFrom) or not node.module:
                continue
            for alias in node.names:
                known = alias.asname or alias.name
                if node.module in TABLES and alias.name in TABLES[node.module]:
                    names[known] = TABLES[node.module][alias.name]
                elif f"{node.module}.{alias.name}" in TABLES:
                    modules[known] = TABLES[f"{node.module}.{alias.name}"]
        for node in ast.walk(tree):
            if not isinstance(node, ast.Call):
                continue
            code = None
            if isinstance(node.func, ast.Name):
                code = names.get(node.func.id)
            elif isinstance(node.func, ast.Attribute) and isinstance(node.func.value, ast.Name):
                code = modules.get(node.func.value.id, {}).get(node.func.attr)
            if code is not None:
                found.append((f"{path.relative_to(ROOT)}:{node.lineno}", code, node))
    return found


def test_each_call_gives_the_values_that_its_texts_need():
    wrong = []
    for place, code, call in calls():
        given = {keyword.arg for keyword in call.keywords}
        needed, known = code.names()
        if call.args or given - known - {"severity", "fixes", None}:
            wrong.append(f"{place}: {code.code} does not know {sorted(map(str, given - known))}")
        elif None not in given and needed - given:
            wrong.append(f"{place}: {code.code} misses {sorted(needed - given)}")
    assert wrong == []


def test_each_code_is_used():
    used = {
        word
        for path in ROOT.joinpath("mrlab_ros").rglob("*.py")
        if path.name != "diagnostics.py"
        for word in re.findall(r"\w+", path.read_text())
    }
    assert [k for codes in TABLES.values() for k in codes if k not in used] == []
