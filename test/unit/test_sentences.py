"""No code reads a sentence: what a person is told steers nothing.

web/test/sentences.test.ts holds the pages to the same.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "mrlab_ros"
# Fields that hold texts for people.
TEXTS = {"message", "remedy", "reason", "sentence"}
STRING_METHODS = {
    "startswith", "endswith", "removeprefix", "removesuffix", "replace", "split", "rsplit",
    "partition", "rpartition", "find", "rfind", "index", "count", "splitlines", "translate",
}  # fmt: skip
PATTERNS = {"search", "match", "fullmatch", "sub", "subn", "split", "findall", "finditer"}
# What a library of others says and offers in no other way: file -> why.
OF_OTHERS = {
    "adapters/robots/urdf.py": "expat puts line and column behind its text; they are read apart",
    "adapters/store/objects.py": "obstore raises FileNotFoundError for a missing bucket as well",
    "adapters/zenoh/configuration.py": "zenoh puts the place in its source behind its text",
    "adapters/zenoh/session.py": "zenoh has no kind of error for an address that is in use",
    "ros/spinning.py": "rcl puts the place in its source behind its text",
}


def reads(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield each place where a text for people is compared, searched, cut or replaced."""
    caught = {n.name for n in ast.walk(tree) if isinstance(n, ast.ExceptHandler) and n.name}

    def is_text(node: ast.AST) -> bool:
        if isinstance(node, ast.Attribute):
            return node.attr in TEXTS
        if isinstance(node, ast.Call):
            name = node.func
            if isinstance(name, ast.Name) and name.id in ("str", "repr"):
                return any(isinstance(a, ast.Name) and a.id in caught for a in node.args) or any(
                    map(is_text, node.args)
                )
            return isinstance(name, ast.Attribute) and name.attr in TEXTS
        return False

    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            written = any(
                isinstance(side, ast.JoinedStr)
                or (isinstance(side, ast.Constant) and isinstance(side.value, str) and side.value)
                for side in sides
            )
            inside = any(isinstance(op, ast.In | ast.NotIn) for op in node.ops)
            if any(map(is_text, sides)) and (written or inside):
                yield node
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            function = node.func
            if function.attr in STRING_METHODS and is_text(function.value):
                yield node
            if function.attr in PATTERNS and any(map(is_text, node.args)):
                yield node
        elif isinstance(node, ast.Subscript) and is_text(node.value):
            yield node


def errors() -> set[str]:
    """Return the names of the lab's own error classes."""
    found, bases = {"LabError"}, {}
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ClassDef):
                bases[node.name] = {getattr(b, "id", getattr(b, "attr", "")) for b in node.bases}
    while more := {name for name, of in bases.items() if of & found} - found:
        found |= more
    return found


def test_every_error_has_a_code():
    known = errors()
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            written = isinstance(node.args[0], ast.JoinedStr) or (
                isinstance(node.args[0], ast.Constant) and isinstance(node.args[0].value, str)
            )
            if name in known and written:
                found.append(f"{path.relative_to(PACKAGE)}:{node.lineno}")
    assert found == []


def test_no_code_reads_a_sentence():
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        name = str(path.relative_to(PACKAGE))
        if name not in OF_OTHERS:
            found += [
                f"{name}:{node.lineno}: {ast.unparse(node)[:80]}"
                for node in reads(ast.parse(path.read_text()))
            ]
    assert found == []


def test_a_read_is_found():
    source = (
        "try: pass\nexcept OSError as error:\n  if 'gone' in str(error): pass\n"
        "if answer.message.startswith('paused'): pass\nre.search('a', f.remedy)\n"
        "a.reason == 'x'\nb.message == ''\n"
    )
    assert sorted(node.lineno for node in reads(ast.parse(source))) == [3, 4, 5, 6]
