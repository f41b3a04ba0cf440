"""How many small faults in a module its unit tests notice: a mutation run of a fixed sample.

A mutant is the module with one place changed: a comparison, a bound, an operator, a constant, a
condition, or a statement left out. It is killed where a test fails. The sample has a fixed seed,
so a module that did not change has the same mutants. Survivors are printed as what stands there
and what would stand there: a boundary that means the same, or a test that is missing.

    python bench/mutants.py                                    the modules below
    python bench/mutants.py --module mrlab_ros.core.base.clock --count 0      every mutant of one
"""

from __future__ import annotations

import argparse
import ast
import copy
import importlib.abc
import importlib.util
import os
import random
import resource
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import report

ROOT = Path(__file__).parents[1]
SEED = 7
# s of a processor that the tests of one mutant may take: a loop without end is a fault that was
# noticed.
PATIENCE_S = 60
OPTIONS = ("-x", "-q", "-n", "0", "-p", "no:cacheprovider")
# The tests that are asked, by module; those of its room.
MODULES = {
    "mrlab_ros.core.base.clock": ("core/base",),
    "mrlab_ros.core.playback.playback": ("core/playback",),
    "mrlab_ros.core.playback.external": ("core/playback",),
    "mrlab_ros.core.playback.stream": ("core/playback",),
    "mrlab_ros.core.playback.goal": ("core/playback",),
    "mrlab_ros.core.systems.robot_system": ("core/systems",),
    "mrlab_ros.core.systems.orders": ("core/systems",),
    "mrlab_ros.core.systems.timeline": ("core/systems",),
    "mrlab_ros.core.conversion.frame_rate": ("core/conversion",),
    "mrlab_ros.core.conversion.evidence.other_columns": ("core/conversion",),
    "mrlab_ros.core.physics.clearance": ("core/physics",),
    "mrlab_ros.core.physics.collisions": ("core/physics",),
    "mrlab_ros.core.recording.recorder": ("core/recording",),
    "mrlab_ros.core.bridge.rules": ("core/bridge",),
    "mrlab_ros.core.base.phrase": ("core/base",),
    "mrlab_ros.core.base.diagnostic": ("core/base",),
    "mrlab_ros.gateway.policy": ("gateway/test_policy.py", "gateway/people"),
    "mrlab_ros.gateway.guard": ("gateway/test_guard.py",),
    "mrlab_ros.classroom.rubrics.measures.grasps": ("classroom/rubrics",),
}
COMPARED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
COMPUTED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.BitOr: ast.BitAnd,
    ast.BitAnd: ast.BitOr,
}
Change = Callable[[Any], None]


def changes(node: ast.AST) -> Iterator[Change]:
    """Yield what can be changed at a node; each change is made in place."""
    if isinstance(node, ast.Compare):
        yield from (_compared(at) for at, op in enumerate(node.ops) if type(op) in COMPARED)
    elif isinstance(node, ast.BoolOp):
        yield lambda n: setattr(n, "op", ast.Or() if isinstance(n.op, ast.And) else ast.And())
    elif isinstance(node, ast.BinOp) and type(node.op) in COMPUTED and not _is_text(node):
        yield lambda n: setattr(n, "op", COMPUTED[type(n.op)]())
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield lambda n: setattr(n, "value", not n.value)
    elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        yield lambda n: setattr(n, "value", n.value + 1)
    elif isinstance(node, ast.If | ast.IfExp | ast.While):
        yield lambda n: setattr(n, "test", ast.UnaryOp(ast.Not(), n.test))
    elif isinstance(node, ast.Return) and not isinstance(node.value, ast.Constant | None):
        yield lambda n: setattr(n, "value", ast.Constant(None))


def _compared(at: int) -> Change:
    def change(node: Any) -> None:
        node.ops[at] = COMPARED[type(node.ops[at])]()

    return change


def _is_text(node: ast.BinOp) -> bool:
    return any(
        isinstance(side, ast.JoinedStr)
        or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in (node.left, node.right)
    )


def _types(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the types that a node states; nothing of them runs."""
    for name in ("annotation", "returns"):
        stated = getattr(node, name, None)
        if stated is not None:
            yield stated


def _left_out(body: list[ast.stmt]) -> Iterator[int]:
    for at, statement in enumerate(body):
        if isinstance(statement, ast.Assign | ast.AugAssign) or (
            isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call)
        ):
            yield at


def mutants(source: str) -> list[tuple[int, str, str, ast.Module]]:
    """Return every mutant of a source: line, what stands there, what would, the whole tree."""
    tree = ast.parse(source)
    functions = [
        n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef)
    ]
    inside = {*functions, *(n for f in functions for part in f.body for n in ast.walk(part))}
    inside -= {n for each in ast.walk(tree) for kind in _types(each) for n in ast.walk(kind)}
    found = []
    nodes = list(ast.walk(tree))
    for index, node in enumerate(nodes):
        if node not in inside:
            continue
        for number, _ in enumerate(changes(node)):
            changed = copy.deepcopy(tree)
            target: Any = list(ast.walk(changed))[index]
            before = ast.unparse(target)
            list(changes(target))[number](target)
            found.append((target.lineno, before, ast.unparse(target), changed))
        for at in _left_out(getattr(node, "body", []) if isinstance(node, ast.stmt) else []):
            changed = copy.deepcopy(tree)
            target = list(ast.walk(changed))[index]
            before, line = ast.unparse(target.body[at]), target.body[at].lineno
            target.body[at] = ast.copy_location(ast.Pass(), target.body[at])
            found.append((line, before, "pass", changed))
    return found


class _Mutated(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the module under test as its mutant."""

    def __init__(self, module: str, tree: ast.Module, path: str) -> None:
        self._module, self._path = module, path
        self._code = compile(ast.fix_missing_locations(tree), path, "exec")

    def find_spec(self, name: str, path: Any, target: Any = None) -> Any:
        if name != self._module:
            return None
        return importlib.util.spec_from_loader(name, self, origin=self._path)

    def exec_module(self, module: Any) -> None:
        module.__file__ = self._path
        exec(self._code, module.__dict__)


def survives(module: str, path: Path, tree: ast.Module, tests: tuple[str, ...]) -> bool:
    """Return whether all tests pass with a mutant; each runs in a process of its own."""
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE_S, PATIENCE_S))
        silent = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silent, 1)
        os.dup2(silent, 2)
        code: int = 1
        try:
            import pytest

            sys.meta_path.insert(0, _Mutated(module, tree, str(path)))
            # The module's own tests first: they notice most, and are found soonest.
            unit = ROOT / "test" / "unit"
            own = unit / Path(*module.split(".")[1:-1]) / f"test_{path.stem}.py"
            code = 0
            for chosen in ([own] if own.exists() else [], [unit / each for each in tests]):
                if chosen and code == 0:
                    code = int(pytest.main([*OPTIONS, *map(str, chosen)]))
        finally:
            os._exit(min(code, 250))
    _, status = os.waitpid(child, 0)
    return os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0


def measure(module: str, tests: tuple[str, ...], count: int) -> dict[str, Any]:
    """Return a row: how many of `count` mutants of a module (0: all) its tests kill."""
    path = ROOT / (module.replace(".", "/") + ".py")
    every = mutants(path.read_text())
    chosen = (
        every if not count or count >= len(every) else random.Random(SEED).sample(every, count)
    )
    begin = time.monotonic()
    if not survives(module, path, ast.parse(path.read_text()), tests):
        raise SystemExit(f"the tests of {module} fail without any fault; mend them first")
    alive = 0
    for line, before, after, tree in sorted(chosen, key=lambda each: each[0]):
        if survives(module, path, tree, tests):
            alive += 1
            print(f"alive {path.relative_to(ROOT)}:{line}  {before[:70]!r} -> {after[:70]!r}")
    killed = len(chosen) - alive
    return {
        "module": module.removeprefix("mrlab_ros."),
        "places": len(every),
        "mutants": len(chosen),
        "killed": killed,
        "percent": 100 * killed / max(1, len(chosen)),
        "s": time.monotonic() - begin,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--module", action="append", choices=MODULES, help="all by default")
    parser.add_argument("--count", type=int, default=40, help="mutants a module; 0: all")
    given = parser.parse_args()
    os.chdir(ROOT)
    # What all mutants import is imported once, before the processes part.
    import numpy as np  # noqa: F401
    import pytest  # noqa: F401

    rows = [measure(name, MODULES[name], given.count) for name in given.module or MODULES]
    report.Page().show("Mutants that the unit tests kill", rows)


if __name__ == "__main__":
    main()
