"""What the room costs: JavaScript time a frame, draw calls, triangles, memory, bytes, answers.

A real lab with four robots that play, twenty objects and four panels; Chromium with an emulated
Quest 3. --soak watches the memory for so many minutes. `bench/room/room.mjs --profile FILE` keeps
a profile for the browser's own tools.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from lab import ROOT
from measures.gateway import NODE, launched
from partner import Failed
from size import Size

NEEDS = ("chromium", "playwright")
ROBOTS = ("--robots", "ur5e,ur5e,ur5e,ur5e")


def room(size: Size) -> list[dict[str, Any]]:
    with tempfile.TemporaryDirectory() as name, launched(Path(name), *ROBOTS) as lab:
        minutes = size.soak or size.of(0.0, 0.5, 10.0)
        words = ["--minutes", str(minutes), *size.of(["--touch"], [], [])]
        command = [NODE, ROOT / "bench/room/room.mjs", lab.url, lab.signed_in_url("/room"), *words]
        environment = os.environ | lab.environment
        done = subprocess.run(
            list(map(str, command)), env=environment, stdout=subprocess.PIPE, text=True
        )
    if done.returncode:
        raise Failed(f"room.mjs ended with exit code {done.returncode}")
    return [
        {**row, "mark": "" if row["mark"] is None else f"< {row['mark']}"}
        for row in json.loads(done.stdout)
    ]


TITLE = "The room: 4 robots that play, 20 objects, 4 panels"
TABLES = {TITLE: room}
SOAKS = {TITLE: room}
