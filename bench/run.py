#!/usr/bin/env python3
"""Run every measure, or those named, and go on past one that fails.

    python bench/run.py [--quick | --touch] [--json FILE] [--compare FILE] [--page FILE] [NAME ...]
    python bench/run.py --soak MINUTES NAME

A measure is a file in measures/. `TABLES` has its questions: a title, and a function that gets the
Size and returns rows of figures with their units and, where there is one, of a baseline. `SOAKS`
has those of --soak, which watch memory over a long time. `NEEDS` names programs and modules
without which it is left out; the last table says how to get them. All tables are on one page as
well, with those figures at its top that are worse than in the last release by more than 15 %. The
exit code is 1 where a measure failed.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import os
import shutil
import signal
import time
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

import domain_coordinator
import report
from partner import Failed, LeftOut, Partner
from size import Size

# s that a measure may take at most.
LONGEST_S = {"touch": 180.0, "quick": 900.0, "full": 7200.0}
# The figures of the last release.
RELEASED = Path(__file__).parent / "released.json"
PAGE = Path(__file__).parents[1] / "build" / "bench.html"
HOW = {"chromium": "apt install chromium", "playwright": "make test installs it"}


def measures() -> list[str]:
    """Return the names of all measures."""
    return sorted(path.stem for path in (Path(__file__).parent / "measures").glob("*.py"))


def measure(pipe: Any, name: str, size: Size) -> None:
    """Send what a measure needs and misses, then each table as (title, rows, problem)."""
    os.setsid()
    module = importlib.import_module(f"measures.{name}")
    pipe.send([n for n in module.NEEDS if not (shutil.which(n) or importlib.util.find_spec(n))])
    for title, rows_of in (module.SOAKS if size.soak else module.TABLES).items():
        try:
            pipe.send((title, rows_of(size), ""))
        except LeftOut as reason:
            pipe.send((title, [], f"left out: {reason}"))
        except Exception:
            traceback.print_exc()
            pipe.send((title, [], f"failed: {title}"))
    pipe.send(None)


class Runner:
    """Runs measures, shows their tables and keeps their figures."""

    def __init__(
        self, size: Size, file: Path | None, compared: Path | None, page: report.Page
    ) -> None:
        self._size, self._file, self._page = size, file, page
        self._earlier = json.loads(compared.read_text()) if compared else {}
        self._kept = json.loads(file.read_text()) if file and file.exists() else {}

    def run(self, name: str) -> str:
        """Run a measure; return what became of it."""
        try:
            with (
                domain_coordinator.domain_id() as domain,
                Partner(measure, name, self._size, env={"ROS_DOMAIN_ID": str(domain)}) as partner,
            ):
                try:
                    return self._follow(partner)
                finally:
                    with suppress(ProcessLookupError):
                        os.killpg(partner.pid, signal.SIGKILL)
        except Failed as problem:
            return f"failed: {problem}"

    def _follow(self, partner: Partner) -> str:
        end = time.monotonic() + self._size.soak * 60 + LONGEST_S[self._size.name]
        lacks = partner.receive(end - time.monotonic())
        if lacks:
            remedy = "; ".join(HOW.get(each, f"install {each}") for each in lacks)
            return f"left out: needs {', '.join(lacks)} ({remedy})"
        problems = []
        while (table := partner.receive(max(0.0, end - time.monotonic()))) is not None:
            title, rows, problem = table
            if rows:
                self._show(title, rows)
            if problem:
                problems.append(problem)
        return "; ".join(problems) or "done"

    def _show(self, title: str, rows: report.Rows) -> None:
        earlier = self._earlier.get(title, {"rows": (), "machine": ""})
        self._page.show(title, rows, earlier["rows"], earlier["machine"])
        if self._file:
            self._kept[title] = {"machine": report.machine(), "rows": rows}
            self._file.write_text(json.dumps(self._kept, indent=1))


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"only these: {measures()}")
    size = parser.add_mutually_exclusive_group()
    size.add_argument(
        "--quick", action="store_const", dest="size", const="quick", default="full",
        help="a minute each",
    )  # fmt: skip
    size.add_argument(
        "--touch", action="store_const", dest="size", const="touch", help="see only that it runs"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the figures here")
    parser.add_argument(
        "--compare", type=Path, metavar="FILE", default=RELEASED if RELEASED.exists() else None,
        help="show these figures beside; not given: those of the last release, if kept",
    )  # fmt: skip
    parser.add_argument(
        "--page", type=Path, metavar="FILE", default=PAGE, help="not given: build/bench.html"
    )
    parser.add_argument("--soak", type=float, default=0.0, metavar="MINUTES", help="watch memory")
    parser.add_argument("--stock", default="", metavar="PATH", help="zenoh-bridge-ros2dds")
    given = parser.parse_args()
    unknown = sorted({*given.names} - {*measures()})
    if unknown:
        parser.error(f"there is no measure {', '.join(unknown)}; expected {', '.join(measures())}")
    if given.stock and not shutil.which(given.stock):
        parser.error(f"{given.stock} is no executable; expected zenoh-bridge-ros2dds")
    return given


def main() -> None:
    given = options()
    # The lab of a measure is found on this machine alone.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    page = report.Page()
    size = Size(given.size, given.soak, given.stock)
    runner = Runner(size, given.json, given.compare, page)
    results = []
    for name in given.names or measures():
        print(f"== {name}", flush=True)
        begin = time.monotonic()
        result = runner.run(name)
        results.append({"measure": name, "s": round(time.monotonic() - begin), "result": result})
    page.show("Measures", results)
    page.write(given.page)
    print(f"all on one page: {given.page}")
    raise SystemExit(any("failed" in each["result"] for each in results))


if __name__ == "__main__":
    main()
