"""A student's Octave beside an open page: signed in by a code; motions checked, mended, seen."""

from __future__ import annotations

import io
import json
import os
import re
import shutil
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from queue import Empty, Queue

import httpx
import numpy as np
import pytest
import scipy.io
from page_objects import UploadPage
from playwright.sync_api import Page, expect
from served_lab import ServedLab

ROOT = Path(__file__).parents[2]
DEADLINE_S = 120.0
# All that a double can be: subnormal, the last bit, a zero with a sign.
EXACT = """
t = (0:99)' / 100;
q_fine = [sin(t) * pi, -1.5 + t / 3, ones(100, 1) / 3, t * eps, 5e-324 * ones(100, 1), -0 * t];
save('-v7', 'sent.mat', 'q_fine');
made = mrlab.publish(q_fine, 100, 'robot', 'ur5e', 'id', 'exact');
"""

PLAYED = """
q = [sin((0:99)' / 100), -1.2 * ones(100, 5)];
mrlab.play('ur5e_1', q, 100, 'id', 'played')
mrlab.play('ur5e_1', q, 100, 'id', 'played', 'replace', true)
robots = mrlab.state();
disp(robots(1).trajectory)
save('-v6', 'motion.mat', 'q');
[back, fs] = mrlab.fromBag('motion.mat', 'frame_rate', 50);
found = mrlab.compare(back, [repmat(q(1, :), 7, 1); q], fs);
printf('%d %g %g\\n', fs, found.delay, max(found.most));
back(3, 2) = NaN;
try, mrlab.compare(back, q, fs), catch problem, disp(problem.identifier), end
try, mrlab.compare(q, q, 0), catch problem, disp(problem.identifier), end
other = {'robot', 'kuka_kr3_r540'};
try, mrlab.play('ur5e_1', q, 100, other{:}), catch problem, disp(problem.identifier), end
try, mrlab.live('gone.m', 100), catch problem, disp(problem.identifier), end
lab = struct('url', 'http://127.0.0.1:1', 'token', 'none', 'ca', '', 'robot', '');
try, mrlab.state(lab), catch problem, disp(problem.message(end - 2:end)), end
"""

# The first row is below the floor, so that the arm is not clear there either.
HALTED = """
t = (0:100)' / 100;
q = [sin(t), -4.8 + 0 * t, zeros(101, 4)];
mrlab.stop('ur5e_1');
mrlab.play('ur5e_1', q, 100, 'id', 'floor')
robots = mrlab.state();
while ~strcmp(robots(1).state, 'COLLISION_HALT')
  pause(0.1);
  robots = mrlab.state();
end
try
  mrlab.play('ur5e_1', q, 100)
catch problem
  printf('%s\\n%s\\n', problem.identifier, problem.message);
end
q(:, 2) = -1.2;
mrlab.play('ur5e_1', q, 100, 'id', 'good', 'replace', true)
found = mrlab.state();
assert(~strcmp(found(1).state, 'COLLISION_HALT'));
"""


class Octave:
    """Octave with the toolbox and a home of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def run(self, script: str) -> str:
        """Run a script; return what it printed."""
        done = subprocess.run(
            self._command("script", script), cwd=self.folder, env=self._environment(),
            capture_output=True, text=True, timeout=DEADLINE_S, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr
        assert "warning" not in done.stderr, done.stderr
        return done.stdout

    def begin(self, script: str) -> Running:
        """Start a script that waits for something."""
        command = self._command("waiting", script)
        return Running(
            subprocess.Popen(
                command, cwd=self.folder, env=self._environment(), text=True,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            )
        )  # fmt: skip

    def _command(self, name: str, script: str) -> tuple[str, ...]:
        octave = shutil.which("octave-cli")
        assert octave is not None, "make test installs octave-cli"
        (self.folder / f"{name}.m").write_text(script)
        options = ("--no-init-file", "--no-history", "--path", str(ROOT / "matlab"))
        return (octave, *options, f"{name}.m")

    def _environment(self) -> dict[str, str]:
        return os.environ | {"HOME": str(self.folder)}


class Running:
    """A script that runs; `until` reads its lines."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self._lines: Queue[str] = Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)

    def until(self, pattern: str) -> str:
        """Return the first group of the next line that matches."""
        heard = ""
        while True:
            try:
                heard += (line := self._lines.get(timeout=DEADLINE_S))
            except Empty:
                raise AssertionError(heard) from None
            if found := re.search(pattern, line):
                return found[1]

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


@pytest.fixture(scope="module")
def octave(tmp_path_factory: pytest.TempPathFactory, lab: ServedLab) -> Octave:
    """Octave that is signed in by a token."""
    made = Octave(tmp_path_factory.mktemp("octave"))
    token = lab.done("users", "token").split()[-1]
    made.run(f"mrlab.connect('{lab.url}', 'token', '{token}');")
    return made


@pytest.fixture
def running() -> Iterator[Callable[[Running], Running]]:
    """Return what ends a script at the end of the test."""
    begun: list[Running] = []

    def keep(script: Running) -> Running:
        begun.append(script)
        return script

    yield keep
    for each in begun:
        each.close()


def test_a_code_on_a_page_signs_octave_in_for_good(
    page: Page, lab: ServedLab, tmp_path: Path, running: Callable[[Running], Running]
) -> None:
    octave = Octave(tmp_path)
    script = running(octave.begin(f"mrlab.connect('{lab.url}'); mrlab.state"))
    page.goto(script.until(r"Open (http\S+)"))
    page.get_by_role("button", name="Approve").click()
    assert script.until(r"^(ur5e_1)\s+ur5e") == "ur5e_1"
    kept = tmp_path / "mrlab.json"
    assert kept.stat().st_mode & 0o077 == 0
    assert json.loads(kept.read_text())["labs"][0]["url"] == lab.url
    assert "ur5e_1" in octave.run("mrlab.state")


def test_a_wrong_motion_is_explained_mended_and_seen_on_the_page(
    page: Page, octave: Octave
) -> None:
    upload = UploadPage(page)
    page.get_by_role("radio", name="UR5e").wait_for(state="attached")
    wrong = "fs = 100; t = (0:1/fs:2)'; q = [t * 4, -ones(numel(t), 5)];\n"
    said = octave.run(wrong + "report = mrlab.check(q, fs)\ndisp(report.findings(1))")
    assert re.search(r"159-201\s+shoulder_pan_joint\s+8 rad\s+6\.283 rad", said)
    assert "mend: find(q(:, 1)" in said
    caught = "try, mrlab.show(q, fs), catch problem, disp(problem.identifier), end"
    assert "mrlab:jointLimit" in octave.run(wrong + caught)
    expect(upload.outcome("refused")).to_be_visible()
    expect(upload.finding("joint_limit")).to_be_visible()
    octave.run("q = [sin((0:200)' / 100), -ones(201, 5)];\nmrlab.show(q, 100)")
    expect(upload.outcome("accepted")).to_be_visible()
    expect(page.locator(".verdict-file")).to_have_text("script_line_2.mat")
    expect(upload.strips).to_have_count(6)
    octave.run("q = [sin((0:99)' / 100), -ones(100, 5)];\nmrlab.show(q, 100)")
    expect(page.locator(".scene-clock, .verdict-message").first).to_contain_text("100 frames")


def test_an_array_arrives_as_it_left(octave: Octave, lab: ServedLab) -> None:
    octave.run(EXACT)
    token = json.loads((octave.folder / "mrlab.json").read_text())["labs"][0]["token"]
    answer = httpx.get(
        f"{lab.url}/api/trajectories/exact/file?format=mat",
        headers={"authorization": f"Bearer {token}"},
    )
    arrived = scipy.io.loadmat(io.BytesIO(answer.content))["q"]
    sent = scipy.io.loadmat(octave.folder / "sent.mat")["q_fine"]
    assert arrived.dtype == sent.dtype == np.float64
    assert arrived.tobytes() == sent.tobytes()
    gone = "q = zeros(9, 6); q(5, 3) = NaN;\n"
    caught = "try, mrlab.publish(q, 9), catch problem, disp(problem.identifier), end"
    assert "mrlab:nonFinite" in octave.run(gone + caught)


def test_a_robot_plays_and_what_was_recorded_is_compared(octave: Octave) -> None:
    said = octave.run(PLAYED)
    assert "ur5e_1 plays played@1" in said
    assert "played@2" in said
    assert "50 0.14 0" in said
    assert said.split()[-5:-1] == [
        "mrlab:nonFinite", "mrlab:badRate", "mrlab:otherRobot", "mrlab:noFile",
    ]  # fmt: skip
    assert said.split()[-1] != "000"


def test_a_script_is_shown_again_when_it_is_saved(
    page: Page, octave: Octave, lab: ServedLab, running: Callable[[Running], Running]
) -> None:
    # Shown is what comes after the page has asked for the first time.
    with page.expect_response(f"{lab.url}/api/live"):
        page.reload()
    plan = octave.folder / "plan.m"
    plan.write_text("fs = 100; q = [sin((0:149)' / 100), -ones(150, 5)];\n")
    script = running(octave.begin("mrlab.live(@plan)"))
    script.until(r"(150 frames)")
    expect(UploadPage(page).outcome("accepted")).to_be_visible()
    plan.write_text("fs = 100; q = [sin((0:177)' / 100), -ones(178, 5)];\n")
    script.until(r"(178 frames)")
    expect(page.locator(".verdict-message")).to_contain_text("178 frames")


def test_a_robot_that_hit_the_floor_plays_again_by_the_lines_that_are_advised(
    octave: Octave,
) -> None:
    said = octave.run(HALTED)
    assert "mrlab:illegalEvent" in said
    assert "mend: mrlab.play(..., 'replace', true)" in said
    assert "ur5e_1 plays good@1" in said
