"""Commands that messages and pages name, and how each of them is run once.

`PEOPLE` and `GROUPS` are run by test/system/test_named_commands.py; `ELSEWHERE` says what is not,
and which test runs it or why none does. test/unit/test_cli.py compares the three with
what is named.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import typer.main
from typer.core import TyperGroup

from mrlab_ros.cli import make_app

ROOT = Path(__file__).parents[3]
SOURCES = [
    *sorted((ROOT / "mrlab_ros").rglob("*.py")),
    *sorted((ROOT / "web" / "src" / "words").glob("*.ts")),
]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
# A command up to where its sentence, its code or its table cell ends.
NAMED = re.compile(r"\bmrlab ((?:--?)?[a-z](?:(?!, (?:or|and|then) |mrlab )[^`\n;:|()])*)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+")
# Words after "mrlab" in prose, as in "mrlab sets it".
PROSE = {"and", "does", "is", "made", "process", "processes", "wrote"}


@cache
def group() -> TyperGroup:
    found = typer.main.get_command(make_app())
    assert isinstance(found, TyperGroup)
    return found


def resolved(words: list[str]) -> tuple[Any, list[str]]:
    """Return the command that words name, and the words after it."""
    command: Any = group()
    while isinstance(command, TyperGroup) and words and words[0] in command.commands:
        command, words = command.commands[words[0]], words[1:]
    return command, words


def options_of(command: Any) -> set[str]:
    names = {name for p in command.params for name in (*p.opts, *p.secondary_opts)}
    return names | {"--help", "--debug"}


def texts(path: Path) -> Iterator[str]:
    """Yield the texts of a source file, with X for what is filled in."""
    if path.suffix == ".ts":
        yield from re.findall(r'"((?:[^"\\]|\\.)*)"', path.read_text())
        return
    inside = set[int]()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.JoinedStr):
            inside |= {id(value) for value in node.values}
            yield "".join(
                value.value if isinstance(value, ast.Constant) else "X" for value in node.values
            )
        elif isinstance(getattr(node, "value", None), str) and id(node) not in inside:
            yield node.value


def fenced() -> Iterator[tuple[str, str]]:
    for page in PAGES:
        for block in re.findall(r"^```[a-z]*\n(.*?)^```", page.read_text(), re.M | re.S):
            for line in block.replace("\\\n", " ").splitlines():
                if line.startswith("mrlab "):
                    yield page.name, line.split("  #")[0].split(" &&")[0].strip()


def named() -> Iterator[tuple[str, str, frozenset[str]]]:
    """Yield where a command is named, its name with that of its group, and its options."""
    for path in (*SOURCES, *PAGES):
        found = texts(path) if path in SOURCES else re.findall(r"`([^`\n]+)`", path.read_text())
        for text in found:
            for match in NAMED.finditer(" ".join(text.split())):
                yield path.name, *_parsed(match.group(1).split(". ")[0])
    for page, line in fenced():
        yield page, *_parsed(line.removeprefix("mrlab "))


def _parsed(said: str) -> tuple[str, frozenset[str]]:
    words = [word.rstrip(".") for word in re.sub("['\",]", " ", said).split()]
    _, rest = resolved(words)
    return " ".join(words[: len(words) - len(rest)]), frozenset(OPTION.findall(said))


def run_options() -> dict[str, set[str]]:
    """Return by command the options with which it is run."""
    found: dict[str, set[str]] = {}
    for line in (*PEOPLE, *"".join(GROUPS.values()).split("\n")[1:-1]):
        name, options = _parsed(line)
        found.setdefault(name, set()).update(options)
    return found


# In an empty folder, where no lab runs.
PEOPLE = """
keys init --dir other --login password
keys init --host lab.example.org
keys add anna ben carla --role operator
keys add teacher --role instructor
keys list
keys renew --host 192.0.2.7
keys renew --dir keys
keys revoke carla
keys router --prefix campus/lab_1
keys router --dir keys
keys init --dir campus --host campus.example.org
keys add hall --role display --dir campus
keys router --dir campus --prefix campus --lab north --lab south
keys router --prefix campus/north --hub campus/labs/north.json5 --hub-role operator
keys gateway
keys config
users add teacher --role instructor
users add anna ben carla --role student
users token anna --program matlab --role student --days 30
users list
users role anna operator
users invite ben
users remove carla
""".strip().splitlines()
# In a lab with physics, pages and one UR5e, in a folder with my_motion.mat, cell.yaml and
# foreign_bag; each group in a folder of its own. What `record` begins ends with `record --stop`.
GROUPS = {
    "machine": """
--version
--help
system --help
--debug status
status --json
doctor
open --print
open /lab --print
""",
    "models": """
robots list
robots show ur5e --out ur5e.png
robots export ur5e --out exported
""",
    "files": """
convert my_motion.mat --robot ur5e
convert my_motion.mat --robot ur5e --variable q --out . --to json
show my_motion.mat --robot ur5e -o page.html
""",
    "robot": """
play ur5e_1 my_motion.mat
play ur5e_1 --speed 0.1 --no-wait
pause ur5e_1
resume ur5e_1
seek ur5e_1 0.5
rate ur5e_1 0.5
loop ur5e_1
stop ur5e_1
load ur5e_1 my_motion.mat
spawn ur5e
place ur5e_2 --at 2,0 --yaw 90
tool ur5e_2 parallel_gripper
remove ur5e_2
""",
    "scene": """
objects types
objects spawn table --at 0.7,0.2,0.37
objects spawn cup --on --at 0.7,0.2,1
objects list
objects remove cup_1
objects clear
system create cell.yaml
system list
system play cell --no-wait
system pause cell
system seek cell 0.5
system rate cell 0.5
system stop cell
system mode cell sequential
system dissolve cell
scene list
scene save lesson_1
scene load lesson_1
scene undo
""",
    "bags": """
record class.bag
play ur5e_1 my_motion.mat --speed 2
record --stop
bag info class.bag
bag report class.bag
bag report class.bag --out class.html
bag extract class.bag --out attachments
bag repair class.bag
bag import foreign_bag mine
show class.bag -o session.html
replay class.bag --rate 4
replay foreign_bag --robot ur5e
""",
}
# What the lists above leave out: the test that runs it, or why none does.
ELSEWHERE = {
    "capture": "with its options in test/system/test_capture.py",
    "capture --against": "test/system/test_capture.py",
    "capture --from-ros-domain": "test/system/test_capture.py",
    "capture --name": "as mrlab play of a file, which converts it; test/system/test_student.py",
    "capture --robot": "test/system/test_capture.py",
    "capture --seconds": "test/system/test_capture.py",
    "compare": "test/system/test_capture.py",
    "compare --json": "as capture --json; test/system/test_capture.py",
    "compare --robot": "test/system/test_capture.py",
    "check": "with all its options in test/unit/commands/check/test_run.py",
    "check --json": "with all its options in test/unit/commands/check/test_run.py",
    "check --out": "with all its options in test/unit/commands/check/test_run.py",
    "check --robot": "with all its options in test/unit/commands/check/test_run.py",
    "check --scene": "with all its options in test/unit/commands/check/test_run.py",
    "export": "what leads to Rerun's SDK in test/unit/commands/test_export.py",
    "export --robot": "test/unit/commands/test_export.py",
    "export --to": "test/unit/commands/test_export.py",
    "convert --json": "test/system/test_convert_command.py",
    "convert --plot": "test/system/test_convert_command.py",
    "convert --rate": "test/system/test_convert_command.py",
    "convert --topic": "test/system/test_convert_command.py",
    "convert --units": "test/system/test_examples.py",
    "rubric example": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric lint": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric lint --json": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark --json": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark --out": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark --public": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark --report": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric mark --rubric": "with its options in test/unit/classroom/test_rubric_run.py",
    "rubric measures": "with its options in test/unit/classroom/test_rubric_run.py",
    "class": "with its options in test/unit/classroom/test_commands.py",
    "class --csv-template": "with its options in test/unit/classroom/test_commands.py",
    "class --jobs": "with its options in test/unit/classroom/test_commands.py",
    "class --json": "with its options in test/unit/classroom/test_commands.py",
    "class --out": "with its options in test/unit/classroom/test_commands.py",
    " --install-completion": "test/unit/commands/test_completion.py",
    " --show-completion": "test/unit/commands/test_completion.py",
    "class --pseudonyms": "with its options in test/unit/classroom/test_commands.py",
    "class --rubric": "with its options in test/unit/classroom/test_commands.py",
    "class --backend": "needs machines; bench/run.py classroom has it with dask",
    "class --scheduler": "needs machines; bench/run.py classroom has it with dask",
    "robots check": "seconds for each robot; test/unit/adapters/robots/test_hulls.py",
    "robots import": "seconds for the hulls; test/unit/adapters/robots/importing/test_robot.py",
    "robots import --as-tool": "test/unit/adapters/bullet/test_imported_hand.py",
    "robots import --id": "as robots import",
    "robots import --lip": "of an arm with a cup; test/unit/adapters/bullet/test_imported_hand.py",
    "robots import --speed": "as robots import",
    "robots import --tool": "as robots import --lip",
    "robots remove": "of an imported robot; test/unit/adapters/robots/importing/test_robot.py",
    "robots sheet": "seconds for the pictures; test/unit/adapters/robots/test_drawing.py",
    "robots sheet --out": "as robots sheet",
    "robots meshes --package": "as robots meshes",
    "robots meshes": "writes into the clone; test_arm_and_hand.py has one",
    "robots meshes --from": "needs clones; test/unit/adapters/robots/test_vendor_meshes.py",
    "demo": "test/system/test_demo.py",
    "up": "test/support/labs/launched_lab.py",
    "up --class": "the gateway's own option --classroom, in test/browser/test_class.py",
    "up --config": "test/system/test_up.py",
    "up --https-cert": "the gateway's own option, in test/system/test_gateway.py",
    "up --https-key": "the gateway's own option, in test/system/test_gateway.py",
    "up --http": "test/system/test_named_commands.py",
    "up --insecure": "test/system/test_up_keys.py",
    "up --keys": "test/system/test_up_keys.py",
    "up --lti": "the gateway's own option --lti, in test/browser/test_course.py",
    "up --no-bridge": "test/system/test_up.py",
    "up --no-frames": "test/support/labs/launched_lab.py",
    "up --no-web": "test/support/labs/launched_lab.py",
    "up --only": "needs two machines; test/unit/processes/test_lab.py has what each runs",
    "up --oidc": "test/system/test_gateway.py",
    "up --physics": "test/system/test_named_commands.py",
    "up --robots": "test/system/test_named_commands.py",
    "up --sim-time": "needs a publisher of /clock; test/node/test_time.py has the nodes with one",
    "up --state-dir": "test/system/test_store.py",
    "up --store": "test/system/test_store.py",
    "up --web-limits": "test/system/test_named_commands.py",
    "up --zenoh-connect": "needs a router; test/node/test_security_router.py has the link",
    "up --zenoh-listen": "test/system/test_named_commands.py",
}
