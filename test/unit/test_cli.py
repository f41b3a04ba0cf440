"""Every command and option that a message or a page of the documentation names is one."""

from __future__ import annotations

import errno
import inspect
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest
import typer.main
from named_commands import (
    ELSEWHERE,
    NAMED,
    OPTION,
    PAGES,
    PROSE,
    ROOT,
    SOURCES,
    fenced,
    group,
    named,
    options_of,
    resolved,
    run_options,
    texts,
)
from typer.core import TyperGroup

from mrlab_ros.cli import COMMANDS, make_app, refused
from mrlab_ros.commands.convert.options import declared, option_words, with_options, words_of
from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.conversion import diagnostics
from mrlab_ros.core.conversion.options import Options

# Prints the log of what it runs until Ctrl-C.
WITHOUT_JSON = ["up"]


def wrong_in(text: str) -> list[str]:
    """Return what a text names that is no command or no option of it."""
    wrong = []
    for match in NAMED.finditer(" ".join(text.split())):
        said = match.group(1).split(". ")[0]
        words = said.replace("'", "").replace('"', "").replace(",", " ").split()
        words = [word.rstrip(".") for word in words]
        if words[0] in PROSE or words[0].startswith("X"):
            continue
        command, rest = resolved(words)
        if command is group() and not words[0].startswith("-"):
            wrong.append(f"mrlab {words[0]}")
        known = options_of(command)
        wrong += [
            f"mrlab {said}: {option}" for option in OPTION.findall(said) if option not in known
        ]
        if isinstance(command, TyperGroup) and command is not group():
            # `mrlab keys` alone is the group; a word behind it in code is one of its commands.
            extra = [word for word in rest[:1] if re.fullmatch(r"[a-z]+", word)]
            wrong += [f"mrlab {said}" for word in extra if match.group(0).startswith("`mrlab")]
    return wrong


def test_messages_name_commands_and_options_that_exist() -> None:
    naming = [(path, text) for path in SOURCES for text in texts(path) if NAMED.search(text)]
    assert len(naming) > 100
    assert [(path.name, wrong) for path, text in naming for wrong in wrong_in(text)] == []


def test_pages_name_commands_and_options_that_exist() -> None:
    code = [
        (path.name, text)
        for path in PAGES
        for text in re.findall(r"`([^`\n]+)`", path.read_text())
        if NAMED.search(text)
    ]
    assert len(code) > 100
    assert [(page, wrong) for page, text in code for wrong in wrong_in(text)] == []


def test_the_parser_takes_every_command_of_a_block() -> None:
    for _, line in fenced():
        takes(line)


def takes(line: str) -> None:
    """Parse it as the shell would hand it over; what is filled in stands for a word."""
    words = shlex.split(line.split(" | ")[0].split(" > ")[0], comments=True)[1:]
    command: Any = group()
    context = command.make_context("mrlab", words)
    while isinstance(command, TyperGroup):
        name, found, rest = command.resolve_command(
            context, [*context._protected_args, *context.args]
        )
        assert found is not None, line
        context, command = found.make_context(name, rest, parent=context), found
        if not context._protected_args:
            break


def test_every_option_that_mends_a_file_is_one_of_convert_play_load_and_show() -> None:
    """Play takes what convert takes: a finding is mended with the same words."""
    codes = [code for code in vars(diagnostics).values() if type(code) is Code]
    fields = {option for code in codes for option, _, _ in code.fixes if option} - {"{option}"}
    assert fields <= set(vars(Options()))
    mends = {option_words(field, "")[0] for field in vars(Options())}
    for name in ("convert", "play", "load", "show"):
        command, _ = resolved([name])
        assert mends <= options_of(command), name


def test_the_options_of_a_conversion_are_declared_once() -> None:
    @with_options
    def command(options: Options, file: str = "") -> None:
        taken.append((options, file))

    taken: list[tuple[Options, str]] = []
    values = dict.fromkeys(inspect.signature(declared).parameters, "")
    command(**{**values, "file": "a.mat", "degrees": True, "rate": 50.0})  # type: ignore[arg-type]
    assert taken[0][1] == "a.mat"
    assert (taken[0][0].degrees, taken[0][0].frame_rate) == (True, 50.0)
    assert words_of(Options(degrees=True, frame_rate=50.0, columns="2:7")) == [
        "--columns", "2:7", "--degrees", "--rate", "50",
    ]  # fmt: skip


def test_a_command_alone_is_the_same_as_among_all() -> None:
    for name in COMMANDS:
        alone = typer.main.get_command(make_app([name]))
        assert isinstance(alone, TyperGroup)
        assert set(alone.commands) == {name}
        shown = [param.name for param in alone.commands[name].params]
        assert shown == [param.name for param in group().commands[name].params]


def leaves(command: Any, words: tuple[str, ...] = ()) -> Iterator[tuple[str, Any]]:
    """Yield each command that does something, with its words."""
    if isinstance(command, TyperGroup):
        for name, each in command.commands.items():
            yield from leaves(each, (*words, name))
    else:
        yield " ".join(words), command


def test_what_a_command_prints_is_to_be_had_as_json() -> None:
    without = [name for name, command in leaves(group()) if "--json" not in options_of(command)]
    assert without == WITHOUT_JSON


def test_help_needs_neither_ros_nor_numpy() -> None:
    """What is imported with a command is waited for also where it only prints its help.

    Those that start a lab, or examine this machine, take their time anyway.
    """
    program = (
        "import sys; from mrlab_ros.cli import COMMANDS, make_app\n"
        "for name in set(COMMANDS) - {'up', 'demo', 'doctor'}: make_app([name])\n"
        "print([name for name in ('numpy', 'rclpy', 'mrlab_msgs', 'ssl') if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_a_command_that_reaches_the_bridge_loads_neither_nodes_nor_the_message_generator() -> None:
    program = (
        "import sys\n"
        "from mrlab_ros.client import connect, lab, link\n"
        "print('numpy' in sys.modules)\n"
        "connect.skip_generator()\n"
        "from mrlab_msgs.msg import Robots\n"
        "from rclpy.serialization import deserialize_message, serialize_message\n"
        "deserialize_message(serialize_message(Robots()), Robots)\n"
        "names = ('rclpy.executors', 'rclpy.node', 'lark', 'em', 'scipy')\n"
        "print([name for name in names if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "[]"]


@pytest.mark.slow
def test_every_command_and_option_that_is_named_is_run() -> None:
    ran = run_options()
    missing = []
    for where, name, options in named():
        command, _ = resolved(name.split())
        if isinstance(command, TyperGroup) and not options:
            continue  # a group alone prints its help
        if name not in ran and name not in ELSEWHERE:
            missing.append(f"{where}: mrlab {name}")
        missing += [
            f"{where}: mrlab {name} {option}"
            for option in options
            if option not in ran.get(name, ()) and f"{name} {option}" not in ELSEWHERE
        ]
    assert sorted(set(missing)) == []


def test_what_is_run_elsewhere_is() -> None:
    files = {what: re.findall(r"test/\S+\.py", why) for what, why in ELSEWHERE.items()}
    texts = {file: (ROOT / file).read_text() for named in files.values() for file in named}
    wholly = [(what, texts[why]) for what, why in ELSEWHERE.items() if why in texts]
    assert len(wholly) > 15
    assert [what for what, text in wholly if f'"{what.split()[-1]}"' not in text] == []


@pytest.mark.parametrize(
    ("number", "name", "remedy"),
    [(errno.ENOSPC, None, "room"), (errno.EACCES, "page.html", "may")],
)
def test_a_disk_that_refuses_is_no_error_of_the_program(number, name, remedy):
    found, code = refused(OSError(number, os.strerror(number), name))
    assert (found.code, found.values["remedy"], code) == ("disk_refuses", remedy, 1)
    found, code = refused(OSError(errno.ENOTDIR, ""))
    assert (found.code, code) == ("command_fault", 3)


@pytest.mark.parametrize(
    ("error", "lack"),
    [(OSError(errno.EMFILE, ""), "descriptors"), (MemoryError(), "memory")],
)
def test_what_the_machine_has_run_out_of_is_named(error, lack):
    found, code = refused(error)
    assert (found.code, found.values["lack"], code) == ("machine_lacks", lack, 1)
