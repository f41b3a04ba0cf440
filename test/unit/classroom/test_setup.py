"""The key of a class's results is the same in every process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.setup import Setup
from mrlab_ros.core.scene.document import SceneDocument

RUBRIC = Path(__file__).parents[3] / "examples" / "rubrics" / "pick_and_place.yaml"
CODE = """
from pathlib import Path
import sys
from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.setup import Setup
from mrlab_ros.core.scene.document import SceneDocument
print(Setup(read_rubric(Path(sys.argv[1])), SceneDocument()).digest)
"""


def test_the_digest_is_that_of_another_process_and_of_the_rubrics_text(tmp_path):
    said = subprocess.run(
        [sys.executable, "-c", CODE, RUBRIC], capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == Setup(read_rubric(RUBRIC), SceneDocument()).digest
    other = tmp_path / "pick_and_place.yaml"
    other.write_text(RUBRIC.read_text().replace("cycle < 8 s", "cycle < 7 s"))
    assert Setup(read_rubric(other), SceneDocument()).digest != said.stdout.strip()
