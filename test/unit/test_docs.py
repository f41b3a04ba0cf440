"""Generated parts of the pages are what the code says today; each block says if it is run."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from numbers_of_pages import SOURCED, filled, without_source
from page_blocks import DATA, GENERATED, MARK, PAGES, ROOT, blocks


def test_generated_blocks_are_up_to_date():
    done = subprocess.run(
        [sys.executable, "scripts/docs/generate.py", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_block_of_commands_says_whether_it_is_run() -> None:
    wrong = []
    for page, block in ((each, block) for each in PAGES for block in blocks(each)):
        at = f"{page.name}, line {block.line}"
        if page.name in GENERATED or (block.language in DATA and block.printed is None):
            continue
        mark = MARK.fullmatch(block.mark)
        if mark is None:
            wrong.append(f"{at}: no mark, but {block.mark!r}")
        elif block.run and block.printed is None:
            wrong.append(f"{at}: no block says what it prints")
        elif block.run and not block.language and {w[0] for w in block.commands} != {"mrlab"}:
            wrong.append(f"{at}: not only mrlab: {block.commands}")
        elif mark["by"] and not (ROOT / mark["by"]).is_file():
            wrong.append(f"{at}: no {mark['by']}")
    assert wrong == []


def test_no_block_of_commands_is_indented_past_its_mark() -> None:
    indented = re.compile(r"^ {3,}(?:```|mrlab |ros2 |make |python3? ).*", re.M)
    outside = {
        page.name: re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
        for page in PAGES
    }
    assert [(n, found) for n, text in outside.items() if (found := indented.findall(text))] == []


def test_the_tests_of_the_threat_model_exist():
    text = (ROOT / "docs/security-model.md").read_text()
    model = text.partition("## Threat model")[2].partition("\n## ")[0]
    named = re.findall(r"`(unit/\S+\.py|node/\S+\.py|test_\w+)`", model)
    assert len(named) > 30
    tests = ""
    for name in named:
        if name.endswith(".py"):
            tests = (ROOT / "test" / name).read_text()
        else:
            assert f"def {name}" in tests, name


def test_both_glossaries_have_the_same_words() -> None:
    english, german = (
        {
            tuple(row.split(" | ")[:2])
            for row in re.findall(r"^\| (.*) \|$", page.read_text(), re.M)
        }
        for page in (ROOT / "docs/glossary.md", ROOT / "docs/de/glossary.md")
    )
    pairs = {(german_word, word) for word, german_word in english} - {("Deutsch", "word")}
    assert pairs == german - {("Wort", "English")}


def test_a_number_in_prose_is_what_its_source_has(tmp_path: Path) -> None:
    (tmp_path / "limits.py").write_text("WAIT_MS, FAR = 2 * 250, 0.04  # why\n")
    (tmp_path / "lab.yaml").write_text("quota:  3 << 30  # bytes\n")
    page = (
        "waits 9 s<!-- limits.py WAIT_MS -->, up to 9 cm<!-- limits.py FAR -->, "
        "9 GiB<!-- lab.yaml quota -->, then 7 s; `8 s`; 6 s<!-- measured -->"
    )
    assert re.sub("<.*?>", "", filled(page, tmp_path)) == (
        "waits 0.5 s, up to 4 cm, 3 GiB, then 7 s; `8 s`; 6 s"
    )
    assert without_source(page) == ["7 s"]
    with pytest.raises(SystemExit, match="GONE"):
        filled("1 s<!-- limits.py GONE -->", tmp_path)


def test_where_a_page_names_sources_each_quantity_has_one() -> None:
    sourced = {p.name: text for p in PAGES if SOURCED.search(text := p.read_text())}
    assert {name: lacks for name, text in sourced.items() if (lacks := without_source(text))} == {}
