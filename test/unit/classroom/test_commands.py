"""`mrlab class` as a whole: seven students, two processes, the blocks of docs/class.md."""

from __future__ import annotations

import csv
import json
import shutil
import textwrap
from pathlib import Path

import numpy as np
import orjson
import pytest
import scipy.io
from page_document import document_in
from refusals import command_refuses
from typer.testing import CliRunner

from mrlab_ros.classroom import commands, grader, worker
from mrlab_ros.classroom.grader import Grader
from mrlab_ros.classroom.rubrics.rubric import Rubric, Test
from mrlab_ros.classroom.setup import Bounds, MiB, Setup, Task
from mrlab_ros.cli import make_app
from mrlab_ros.core.base.diagnostic import from_plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.scene.document import SceneDocument

# two processes start, import everything and check the reference: slow on a busy machine
pytestmark = [pytest.mark.slow, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[3]
PICK = ROOT / "examples" / "pick_and_place_ur5e.mat"
RUBRIC = ROOT / "examples" / "rubrics" / "pick_and_place.yaml"
SHEET = "Identifier,Full name,Grade,Maximum Grade,Feedback comments\n" + "".join(
    f"Participant {n},X,,15,\n" for n in (1, 2, 3, 4, 5, 6, 7)
)


def grade(*words):
    return CliRunner().invoke(make_app(["class"]), ["class", *map(str, words)])


@pytest.fixture(scope="module")
def submissions(tmp_path_factory):
    """A solution, one that is late at the cube, text, nothing, two files, degrees, and a name that
    says velocities."""
    folder = tmp_path_factory.mktemp("class") / "submissions"
    names = ("Änne Groß", "Ben", "Cem", "Dora", "Eva", "Fay", "Gus")
    places = [folder / f"{n}_{i}_assignsubmission_file_" for i, n in enumerate(names, 1)]
    for place in places:
        place.mkdir(parents=True)
    shutil.copy(PICK, places[0] / "run.mat")
    content = scipy.io.loadmat(PICK)
    q, closed = content["q"], content["q"][:, 6].copy()
    late = np.concatenate([np.zeros(120), closed[:-120]])
    values = {"q": np.column_stack([q[:, :6], late]), "fs": content["fs"]}
    scipy.io.savemat(places[1] / "run.mat", values)
    (places[2] / "run.mat").write_text("this is not a workspace")
    (places[3] / "report.pdf").write_bytes(b"%PDF-1.4")
    shutil.copy(PICK, places[4] / "a.mat")
    (places[4] / "b.mat").write_bytes(b"")
    degrees = np.column_stack([np.degrees(q[:, :6]), closed])
    scipy.io.savemat(places[5] / "run.mat", {"q": degrees, "fs": content["fs"]})
    scipy.io.savemat(places[6] / "run.mat", {"qd": q, "fs": content["fs"]})
    return folder


def results(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_a_class_is_marked_kept_and_the_same_however_it_is_run(submissions, tmp_path):
    out = tmp_path / "marked"
    said = grade(submissions, "--rubric", RUBRIC, "--out", out, "--jobs", 2)
    assert said.exit_code == 0, said.stderr
    assert "7 students, read as Moodle" in said.stdout
    found = json.loads((out / "class.json").read_text())
    rows = {s["name"]: s for s in found["students"]}
    assert [rows[n]["points"] for n in ("Änne Groß", "Cem", "Dora", "Eva")] == [15, 0, 0, 15]
    assert 0 < rows["Ben"]["points"] < 15
    assert rows["Dora"]["outcome"] == "no_file"
    assert rows["Dora"]["found"]["code"] == "no_file_handed_in"
    assert rows["Dora"]["found"]["values"]["files"] == ["report.pdf"]
    assert rows["Eva"]["file"] == "a.mat"
    assert rows["Eva"]["notes"][0]["code"] == "newest_taken"
    assert rows["Eva"]["notes"][0]["values"]["count"] == 2
    assert found["reference"]["points"] == 15
    lost = [m for m in rows["Ben"]["marks"] if not m["passed"]]
    shown = {s["key"]: s for s in document_in(out / "index.html")["students"]}
    of_ben = shown[rows["Ben"]["key"]]["marks"]
    assert [m["time"] for m in of_ben if not m["passed"]] == [m["time"] for m in lost]
    # both as the reference: no pair
    assert found["similar"]["groups"] == []
    assert len(found["similar"]["as_reference"]) >= 2
    key = rows["Änne Groß"]["key"]
    assert "Keeps away from the bin" in json.dumps(document_in(out / "pages" / f"{key}.html"))
    feedback = out / "feedback" / f"{key}.html"
    assert "Keeps away from the bin" not in json.dumps(document_in(feedback))
    assert "Keeps away from the bin" not in feedback.read_text()

    # who has nothing that can be marked is told why, with the matrix where there is one
    refused = {
        "Cem": ("refused", "unsupported_format", "mrlab.refusal.1"),
        "Dora": ("no_file", "no_file_handed_in", "mrlab.refusal.1"),
        "Fay": ("refused", "degrees", "mrlab.motion.1"),
        "Gus": ("refused", "ambiguous", "mrlab.motion.1"),
    }
    for name, (outcome, code, schema) in refused.items():
        row = rows[name]
        assert (row["outcome"], row["found"]["code"], row["points"]) == (outcome, code, 0)
        for folder in ("pages", "feedback"):
            page = document_in(out / folder / f"{row['key']}.html")
            assert (page["schema"], page["findings"][0]["code"]) == (schema, code)
            assert (page["marks"]["points"], page["marks"]["hints"]) == (0, [])
        assert shown[row["key"]]["page"] == f"pages/{row['key']}.html"

    before = results(out)
    # as after a kill between two files
    (out / "trajectories" / f"{rows['Ben']['key']}.json").unlink()
    (out / "pages" / f"{key}.html").unlink()
    sheet = tmp_path / "sheet.csv"
    sheet.write_text(SHEET)
    archive = shutil.make_archive(str(tmp_path / "moodle"), "zip", submissions)
    words = ("--out", out, "--csv-template", sheet, "--jobs", 1)
    said = grade(archive, "--rubric", RUBRIC, *words)
    assert said.exit_code == 0, said.stderr
    assert results(out) == before
    filled = list(csv.DictReader((tmp_path / "marked-sheet.csv").open()))
    assert [row["Grade"] for row in filled][::2] == ["15", "0", "15", "0"]
    told = {row["Identifier"]: row["Feedback comments"] for row in filled}
    for place, name in ((3, "Cem"), (4, "Dora"), (6, "Fay"), (7, "Gus")):
        assert told[f"Participant {place}"] == str(from_plain(rows[name]["found"]))

    shared, one = tmp_path / "shared", tmp_path / "one"
    shutil.copytree(next(submissions.glob("Änne*")), one / "Änne Groß_1_assignsubmission_file_")
    sheet.write_text("Identifier,Full name,Grade\nParticipant 1,Änne Groß,\n")
    words = ("--out", shared, "--pseudonyms", "--no-pages", "--json", "--jobs", 1)
    words = (*words, "--csv-template", sheet)
    said = grade(one, "--rubric", RUBRIC, *words)
    assert said.exit_code == 0, said.stderr
    assert [s["points"] for s in json.loads(said.stdout)["students"]] == [15]
    told = b"\n".join([*results(shared).values(), *map(str.encode, results(shared))]).lower()
    assert not [n for n in ("änne", "aenne", "groß") if n.encode() in told]
    names = tmp_path / "shared-names.json"
    assert "Änne Groß" in names.read_text()
    assert "Participant 1,Änne Groß,15" in (tmp_path / "shared-sheet.csv").read_text()
    assert names.stat().st_mode & 0o077 == 0


def test_a_class_goes_on_where_it_was(tmp_path, monkeypatch):
    handed_in, out = tmp_path / "submissions", tmp_path / "marked"
    for name in ("anna", "ben"):
        (handed_in / name).mkdir(parents=True)
        shutil.copy(PICK, handed_in / name / "run.mat")
    words = (handed_in, "--rubric", RUBRIC, "--out", out, "--jobs", 1, "--no-pages")
    assert grade(*words).exit_code == 0
    before = results(out)
    checked = []
    whole = grader.checked
    monkeypatch.setattr(
        grader,
        "checked",
        lambda setup, task, *more: checked.append(task.key) or whole(setup, task, *more),
    )
    assert grade(*words).exit_code == 0
    assert checked == []
    assert results(out) == before
    # a teacher changes a mark, and a student hands in what cannot be read
    assert not list((out / "pages").iterdir())
    table = (out / "grades.csv").read_text()
    (out / "grades.csv").write_text(
        table.replace("Anna", "anna").replace("no,15,15", "no,13,15", 1)
    )
    (out / "pages" / "ben.html").write_text("of an earlier submission")
    (handed_in / "ben" / "run.mat").write_bytes(b"")
    said = grade(*words)
    assert said.exit_code == 0, said.stdout + said.stderr
    assert checked == ["ben"]
    rows = {s["name"]: s for s in json.loads((out / "class.json").read_text())["students"]}
    assert (rows["anna"]["points"], rows["ben"]["points"]) == (13, 0)
    assert rows["anna"]["notes"][0]["code"] == "changed_mark"
    assert "no,13,15" in (out / "grades.csv").read_text()
    assert not list(out.glob("*/ben.html")) + list(out.glob("trajectories/ben.json"))
    assert "changed by hand" in said.stdout


def test_cells_of_a_class_reach_their_own_motions_only(tmp_path):
    rubric = tmp_path / "rubric.yaml"
    reference = ROOT / "examples" / "handover_cell.yaml"
    rubric.write_text(
        f"name: A cell\nscene: handover\nreference: {reference}\ntests:\n"
        "  - {name: Nothing is hit, expect: no collision, points: 1}\n"
        "  - {name: Like it, expect: joints within 1 deg of the reference, points: 1}\n"
    )
    handed_in, kept = tmp_path / "submissions", tmp_path / "kept"
    for name in ("anna", "ben", "cem"):
        (handed_in / name).mkdir(parents=True)
    kept.mkdir()
    cell = (ROOT / "examples" / "handover_cell.yaml").read_text()
    for motion in ROOT.glob("examples/two_robot_handover_*.mat"):
        shutil.copy(motion, handed_in / "anna")
        shutil.copy(motion, kept)
    (handed_in / "anna" / "cell.yaml").write_text(cell)
    others = cell.replace("trajectory: ", f"trajectory: {kept}/")
    (handed_in / "ben" / "cell.yaml").write_text(others)
    upwards = cell.replace("trajectory: ", "trajectory: ../anna/")
    (handed_in / "cem" / "cell.yaml").write_text(upwards)
    out = tmp_path / "marked"
    said = grade(handed_in, "--rubric", rubric, "--out", out, "--jobs", 1, "--no-pages")
    assert said.exit_code == 0, said.stdout + said.stderr
    found = {s["name"]: s for s in json.loads((out / "class.json").read_text())["students"]}
    assert (found["anna"]["points"], found["anna"]["file"]) == (2, "cell.yaml")
    assert json.loads((out / "class.json").read_text())["reference"]["points"] == 2
    assert found["ben"]["points"] == found["cem"]["points"] == 0
    assert found["cem"]["found"]["code"] == "member_file_not_beside"
    refused = found["ben"]["found"]
    assert refused["code"] == "member_file_not_beside"


def test_the_motions_of_a_reference_that_is_a_cell_lie_beside_it(tmp_path):
    (tmp_path / "submissions" / "anna").mkdir(parents=True)
    shutil.copy(PICK, tmp_path / "submissions" / "anna")
    cell = (ROOT / "examples" / "handover_cell.yaml").read_text()
    (tmp_path / "cell.yaml").write_text(cell.replace("trajectory: ", "trajectory: ../"))
    rubric = tmp_path / "rubric.yaml"
    rubric.write_text(
        "scene: handover\nreference: cell.yaml\ntests: [{expect: no collision, points: 1}]"
    )
    with command_refuses(commands, "reference_apart", file="cell.yaml"):
        assert grade(tmp_path / "submissions", "--rubric", rubric).exit_code == 2


def test_pseudonyms_hide_names_of_damaged_archives_links_and_cells(tmp_path):
    rubric = tmp_path / "rubric.yaml"
    rubric.write_text("scene: handover\ntests: [{expect: no collision, points: 2}]")
    handed_in, out = tmp_path / "submissions", tmp_path / "shared"
    for name in ("Janedoe", "Maxroe", "Zoepoe"):
        (handed_in / name).mkdir(parents=True)
    cell = (ROOT / "examples" / "handover_cell.yaml").read_text()
    for motion in ROOT.glob("examples/two_robot_handover_*.mat"):
        own = f"janedoe_{motion.name}"
        cell = cell.replace(motion.name, own)
        shutil.copy(motion, handed_in / "Janedoe" / own)
    (handed_in / "Janedoe" / "janedoe_cell.yaml").write_text(cell)
    packed = shutil.make_archive(str(tmp_path / "packed"), "zip", handed_in / "Janedoe")
    damaged = bytearray(Path(packed).read_bytes())
    damaged[40:400] = bytes(360)
    (handed_in / "Maxroe" / "maxroe.zip").write_bytes(bytes(damaged))
    (handed_in / "Zoepoe" / "zoepoe.zip").write_bytes(b"no archive")
    (handed_in / "Zoepoe" / "zoepoe.mat").symlink_to("nowhere")
    said = grade(
        handed_in, "--rubric", rubric, "--out", out, "--pseudonyms", "--no-pages", "--jobs", 1
    )
    assert said.exit_code == 0, said.stdout + said.stderr
    students = json.loads((out / "class.json").read_text())["students"]
    assert sorted(s["points"] for s in students)[-1] == 2
    told = b"\n".join([*results(out).values(), *map(str.encode, results(out))]).lower()
    told += said.stdout.encode().lower()
    assert not [n for n in (b"janedoe", b"maxroe", b"zoepoe") if n in told]


@pytest.mark.parametrize(
    ("words", "code", "values"),
    [
        (("nowhere", "--rubric", RUBRIC), "no_export", {"file": "nowhere"}),
        ((RUBRIC, "--rubric", RUBRIC), "no_zip", {}),
        ((ROOT / "config", "--rubric", ROOT / "nowhere.yaml"), "file_missing", {}),
        ((ROOT / "examples", "--rubric", RUBRIC, "--out", ROOT / "config"), "no_class_folder",
         {"folder": str(ROOT / "config")}),
        ((ROOT / "examples", "--rubric", RUBRIC, "--jobs", "-1"), "option_out_of_range",
         {"option": "jobs", "value": -1}),
    ],
)  # fmt: skip
def test_what_cannot_be_marked_ends_with_2_and_a_code(words, code, values):
    with command_refuses(commands, code, **values):
        assert grade(*words).exit_code == 2
    assert not list(RUBRIC.parent.glob("*-marked"))


RUDE = """
    import ctypes
    from dataclasses import dataclass
    from mrlab_ros.classroom.rubrics.diagnostics import NOTHING_TOUCHED
    from mrlab_ros.classroom.rubrics.rubric import Outcome

    @dataclass(frozen=True)
    class Rude:
        def assess(self, checked, reference):
            file = checked.trajectory.source.file
            if file == "crashes.mat":
                ctypes.string_at(0)
            if file == "reaches.mat":
                open(__file__ + ".key").read()
            if file == "hungers.mat":
                bytearray(1 << 40)
            while file == "hangs.mat":
                pass
            return Outcome(1.0, NOTHING_TOUCHED())
"""


def test_what_a_submission_does_to_its_check_harms_no_other(tmp_path, monkeypatch):
    package = tmp_path / "package"
    package.mkdir()
    (package / "rude.py").write_text(textwrap.dedent(RUDE))
    (package / "rude.py.key").symlink_to(tmp_path / "key")
    (tmp_path / "key").write_text("a key")
    monkeypatch.syspath_prepend(package)
    monkeypatch.setenv("PYTHONPATH", str(package))
    import rude

    tests = (Test("fine", "fine", rude.Rude(), 1.0),)
    rubric = Rubric("rude", tests, robot="ur5e", scene="")
    bounds = Bounds(2048 * MiB, 3.0)
    process = Grader(Setup(rubric, SceneDocument(), bounds=bounds, pages=False))
    said = {}
    try:
        for name in ("crashes", "reaches", "hungers", "hangs", "behaves"):
            files = ((f"{name}.mat", PICK.read_bytes()),)
            said[name] = orjson.loads(process.check(Task(name, name, files))[worker.RESULT])
    finally:
        process.close()
    assert [said[n]["outcome"] for n in said] == ["failed"] * 4 + ["marked"]
    codes = {name: found["found"]["code"] for name, found in said.items()}
    assert codes == {
        "crashes": "submission_crashed",
        "reaches": "submission_failed",
        "hungers": "submission_out_of_memory",
        "hangs": "submission_ended",
        "behaves": "check_ready",
    }
    assert "PermissionError" in said["reaches"]["found"]["values"]["error"]
    assert said["behaves"]["marks"]["points"] == 1.0


def test_a_reference_without_a_motion_is_said_before_anything_is_marked(tmp_path):
    rubric = Rubric("bad", (), robot="ur5e", reference="x.mat")
    setup = Setup(rubric, SceneDocument(), reference=("x.mat", b"no motion"), pages=False)
    process = Grader(setup)
    try:
        with pytest.raises(BadInput, match="reference"):
            process.check(Task("a", "a", (("a.mat", b""),)))
    finally:
        process.close()
