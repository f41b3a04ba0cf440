"""Who handed in what, by the paths that the exports have."""

from __future__ import annotations

import pytest

from mrlab_ros.classroom.marks.exports import Entry, file_label, recognise, slug

SUFFIXES = (".mat", ".mat.gz", ".csv", ".yaml")


def students(*paths, **more):
    entries = [Entry(p) if isinstance(p, str) else Entry(p[0], 0, p[1]) for p in paths]
    return recognise(entries, SUFFIXES, **more)


@pytest.mark.parametrize(
    ("form", "path", "name", "identifier"),
    [
        ("Moodle", "Jane Doe_12345_assignsubmission_file_/a.mat", "Jane Doe", "12345"),
        ("Moodle", "Jane Doe_12345_assignsubmission_file/sub/a.mat", "Jane Doe", "12345"),
        ("Moodle", "Jörg Groß_7_assignsubmission_file_run_1.mat", "Jörg Groß", "7"),
        ("Moodle", "hw/Participant 3_99_assignsubmission_file_/a.mat", "Participant 3", "99"),
        ("ILIAS", "Übung 1/Abgaben/Doe_Jane_jdoe_4711/a.mat", "Jane Doe", "jdoe"),
        ("ILIAS", "Abgaben/Doe_Jane_j_doe_4711/a.mat", "Jane Doe", "j_doe"),
        ("Canvas", "doejane_12345_67890_a.mat", "doejane", "12345"),
        ("Canvas", "doe-smithjane_LATE_12345_67890_a b.mat", "doe-smithjane", "12345"),
        ("Gradescope", "assignment_1_export/submission_77/a.mat", "submission_77", "77"),
        ("folder", "Jane Doe/deep/a.mat", "Jane Doe", ""),
        ("folder", "Jane Doe.zip/a.mat", "Jane Doe", ""),
        ("folder", "Jane Doe.mat.gz", "Jane Doe", ""),
    ],
)
def test_each_form_is_recognised(form, path, name, identifier):
    other = "Zoe.mat" if "/" not in path and form == "folder" else "Zoe/b.mat"
    found = students(path, *([other] if form == "folder" else []))
    assert found.form == form
    one = found.submissions[0]
    assert (one.name, one.identifier, one.form) == (name, identifier, form)
    assert [e.path for e in one.candidates] == [path]
    assert one.late == ("LATE" in path)


def test_who_sent_canvas_a_text_alone_has_a_row_too():
    found = students("doejane_1_2_a.mat", "leeann_LATE_3_text.html")
    assert [(s.name, s.late, len(s.candidates)) for s in found.submissions] == [
        ("doejane", False, 1),
        ("leeann", True, 0),
    ]
    assert [n.code for n in found.submissions[1].notes] == ["text_not_read"]
    assert found.left_out == ()


def test_gradescope_says_who_sent_a_submission():
    metadata = {
        "submission_1": {
            ":submitters": [
                {":name": "Jane Doe", ":sid": "9", ":email": "j@x.org"},
                {":name": "Max"},
            ],
            ":created_at": "2026-11-30 22:59:01.110236000 Z",
        }
    }
    found = students("e/submission_1/a.mat", "e/submission_2/b.mat", metadata=metadata)
    one, other = found.submissions
    assert (one.name, one.identifier, one.email) == ("Jane Doe, Max", "9", "j@x.org")
    assert (one.handed_in, other.handed_in) == (1796079541.0, None)
    assert other.name == "submission_2"
    assert [n.code for n in other.notes] == ["sender_not_named"]


def test_a_folder_around_all_is_no_student_and_junk_is_nobodys():
    found = students("hw1/a.mat", "hw1/b.mat", "hw1/readme.txt", "__MACOSX/hw1/._a.mat")
    assert [s.name for s in found.submissions] == ["a", "b"]
    assert [(e.path, e.why.code) for e in found.left_out] == [("hw1/readme.txt", "no_motion_file")]


def test_who_sent_no_motion_is_in_the_class_all_the_same():
    found = students(
        "Jane Doe_1_assignsubmission_onlinetext/onlinetext.html",
        "Max_2_assignsubmission_file_/report.pdf",
        "Max_2_assignsubmission_onlinetext/onlinetext.html",
    )
    jane, maximilian = found.submissions
    assert jane.candidates == maximilian.candidates == ()
    assert maximilian.others == ("report.pdf",)
    assert "text_not_read" in [note.code for note in maximilian.notes]


def test_several_files_are_named_and_the_rule_too():
    folder = "Jane_1_assignsubmission_file_"
    found = students((f"{folder}/old.mat", (1,)), (f"{folder}/new.mat", (2,)))
    (jane,) = found.submissions
    assert [e.path for e in jane.candidates] == [f"{folder}/new.mat", f"{folder}/old.mat"]
    (note,) = jane.notes
    assert note.code == "newest_taken"
    assert note.values == {"count": 2, "files": ["new.mat", "old.mat"]}
    found = students((f"{folder}/old.mat", (1,)), (f"{folder}/new.csv", (2,)), pattern="*.mat")
    assert [e.path for e in found.submissions[0].candidates] == [f"{folder}/old.mat"]
    assert found.submissions[0].notes[0].values["pattern"] == "*.mat"
    found = students(f"{folder}/old.mat", pattern="task*.mat")
    (note,) = found.submissions[0].notes
    assert (note.code, note.values["pattern"]) == ("none_named_so", "task*.mat")


def test_the_last_attempt_comes_first_however_late_it_was_unpacked():
    found = students(
        ("doejane_1_10_run-2.mat", (1,)), ("doejane_1_9_run.mat", (5,)),
        ("doejane_1_11_run-10.mat", (2,)),
    )  # fmt: skip
    (jane,) = found.submissions
    assert [e.path[-10:] for e in jane.candidates] == ["run-10.mat", "_run-2.mat", "_9_run.mat"]


@pytest.mark.parametrize(
    ("paths", "form", "names"),
    [
        (["my_robot_lab_2/Jane/a.mat", "my_robot_lab_2/Max/a.mat"], "folder", ["Jane", "Max"]),
        (["Jane/a.mat", "Max/a.mat", "my_robot_lab_2/a.mat"], "folder",
         ["Jane", "Max", "my_robot_lab_2"]),
        (["Jane/a.mat", "Max/a.mat", "Zoe/zoe_1_2_a.mat"], "folder", ["Jane", "Max", "Zoe"]),
        (["hw/read.me", "hw/Jane/a.mat", "hw/Max/a.mat"], "folder", ["Jane", "Max"]),
        (["Jane/a.mat", "Jane/a (2).mat", "Jane/readme.txt"], "folder", ["Jane"]),
        (["Doe_Jane_jd_1/a.mat", "Roe_Max_mr_2/a.mat"], "ILIAS", ["Jane Doe", "Max Roe"]),
    ],
)  # fmt: skip
def test_a_form_is_recognised_by_all_paths(paths, form, names):
    found = students(*paths)
    assert found.form == form
    assert [s.name for s in found.submissions] == names


def test_a_form_can_be_said():
    found = students("my_robot_lab_2/a.mat", form="ILIAS")
    assert (found.form, found.submissions[0].name) == ("ILIAS", "robot my")


@pytest.mark.parametrize("name", ["reference", "Reference.mat"])
def test_no_student_has_the_key_of_the_reference(name):
    found = students(f"{name}/a.mat" if "." not in name else name, "Zoe/a.mat")
    assert "reference" not in [s.key for s in found.submissions]


def test_names_are_labels_of_one_line():
    folder = "Jane\nDoe_1_assignsubmission_file_"
    found = students(f"{folder}/a.mat", f"{'x' * 300}_2_assignsubmission_file_/{'a' * 300}.mat")
    assert [s.name for s in found.submissions] == ["Jane\\nDoe", "x" * 200]
    for name in ("a" * 300 + ".mat", "é" * 300 + ".mat.gz", "a\nb.mat", "." * 300):
        shown = file_label(name)
        assert len(shown.encode()) <= 200
        assert "\n" not in shown
    assert file_label("a" * 300 + ".mat").endswith("a.mat")


def test_keys_are_file_names_of_their_own():
    found = students("Jörg Groß/a.mat", "Joerg Gross/a.mat", "李明/a.mat", "../x/a.mat")
    keys = [s.key for s in found.submissions]
    assert len(set(keys)) == 4
    assert all(key == slug(key) for key in keys)
    assert {"joerg-gross", "joerg-gross-2"} <= set(keys)
