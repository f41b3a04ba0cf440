"""The supervisor with small real processes, and its restart policy with time injected."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import psutil
import pytest

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.runtime.process_states import Deaths, ProcessState
from mrlab_ros.processes.child_process import (
    RESTARTS,
    WRONG_CONFIGURATION,
    ProcessSpec,
    RestartPolicy,
    describe_exit,
)
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.supervisor import Supervisor

DEADLINE = 20.0


def wait_for(condition: Callable[[], object], what: str) -> None:
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
        time.sleep(0.01)


class Lines:
    """Collects what the supervisor emits."""

    def __init__(self) -> None:
        self.all: list[tuple[str, str]] = []

    def __call__(self, name: str, line: str) -> None:
        self.all.append((name, line))

    def of(self, name: str) -> list[str]:
        return [line for who, line in self.all if who == name]


def spec(name: str, code: str) -> ProcessSpec:
    return ProcessSpec(name, (sys.executable, "-u", "-S", "-c", textwrap.dedent(code)))


SLEEPER = """
    import signal, time
    print("up", flush=True)
    try:
        time.sleep(600)
    except KeyboardInterrupt:
        print("bye", flush=True)
"""
STUBBORN = """
    import signal, time
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    print("up", flush=True)
    while True:
        time.sleep(600)
"""
# Starts a process of its own that ignores SIGINT, and says its id.
PARENT = """
    import subprocess, sys, time
    code = "import signal, time; signal.signal(signal.SIGINT, signal.SIG_IGN); time.sleep(600)"
    print(subprocess.Popen([sys.executable, "-S", "-c", code]).pid, flush=True)
    try:
        time.sleep(600)
    except KeyboardInterrupt:
        pass
"""


def gone(pid: int) -> bool:
    try:
        return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


@pytest.fixture
def lines() -> Lines:
    return Lines()


class TestRestartPolicy:
    def test_delays_double_up_to_the_longest(self) -> None:
        policy = RestartPolicy(0.5, 10.0, 30.0)
        delays, now = [], 0.0
        for _ in range(7):
            policy.started(now)
            now += 1.0
            delays.append(policy.ended(now))
            now += delays[-1]
        assert delays == [0.5, 1.0, 2.0, 4.0, 8.0, 10.0, 10.0]

    def test_a_long_life_resets_the_delay(self) -> None:
        policy = RestartPolicy(0.5, 10.0, 30.0)
        for start in (0.0, 10.0, 20.0):
            policy.started(start)
            policy.ended(start + 1.0)
        policy.started(100.0)
        assert policy.ended(130.0) == 0.5
        policy.started(131.0)
        assert policy.ended(132.0) == 1.0

    def test_a_life_just_too_short_does_not_reset(self) -> None:
        policy = RestartPolicy(0.5, 10.0, 30.0)
        policy.started(0.0)
        policy.ended(1.0)
        policy.started(2.0)
        assert policy.ended(31.9) == 1.0


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (0, "exit code 0"),
        (WRONG_CONFIGURATION, "wrong configuration"),
        (3, "exit code 3"),
        (-9, "SIGKILL"),
        (-99, "signal 99"),
    ],
)
def test_an_exit_is_told_in_words(code: int, words: str) -> None:
    assert describe_exit(code) == words


class TestSupervisor:
    def test_each_line_comes_with_the_name_of_who_said_it(self, lines: Lines) -> None:
        specs = [
            spec("a", "import time\nprint('one')\nprint('two')\ntime.sleep(600)"),
            spec("b", "import sys, time\nsys.stderr.write('three\\n')\ntime.sleep(600)"),
        ]
        with Supervisor(specs, lines):
            wait_for(lambda: len(lines.all) >= 3, "three lines")
        assert lines.of("a")[:2] == ["one", "two"]
        assert lines.of("b")[0] == "three"

    def test_environment_and_bytes_that_are_not_utf8(self, lines: Lines) -> None:
        code = "import os, sys\nsys.stdout.buffer.write(os.environb[b'WHO'] + b' \\xff\\n')"
        what = ProcessSpec("a", (sys.executable, "-S", "-c", code), {"WHO": "me"})
        with Supervisor([what], lines):
            wait_for(lambda: lines.of("a"), "a line")
        assert lines.of("a")[0] == "me \N{REPLACEMENT CHARACTER}"

    def test_a_process_knows_how_many_before_it_have_ended(self, lines: Lines) -> None:
        say = spec("a", f"import os\nprint(os.environ['{RESTARTS}'])")
        with Supervisor([say], lines, policy=lambda: RestartPolicy(0.05, 0.1)):
            wait_for(lambda: len(lines.of("a")) >= 3, "three lives")
        assert lines.of("a")[:3] == ["0", "1", "2"]

    def test_a_process_that_dies_is_restarted_and_the_others_are_left_alone(
        self, lines: Lines
    ) -> None:
        specs = [spec("a", SLEEPER), spec("b", SLEEPER)]
        with Supervisor(specs, lines, policy=lambda: RestartPolicy(0.05, 0.1)) as supervisor:
            wait_for(lambda: lines.of("a") and lines.of("b"), "both up")
            first, other = (state.pid for state in supervisor.states)
            assert first is not None
            os.kill(first, signal.SIGKILL)
            wait_for(lambda: len(lines.of("a")) == 2, "a up again")
            a, b = supervisor.states
            assert a.phase == "running"
            assert (a.restarts, a.last_exit) == (1, "SIGKILL")
            assert a.pid != first
            assert (b.pid, b.restarts) == (other, 0)
        assert "a ended (SIGKILL); restarts in 0.05 s" in lines.of("mrlab")

    def test_what_a_dead_process_leaves_in_its_group_goes_with_it(self, lines: Lines) -> None:
        with Supervisor([spec("a", PARENT)], lines) as supervisor:
            wait_for(lambda: lines.of("a"), "the grandchild's id")
            pid = supervisor.states[0].pid
            assert pid is not None
            os.kill(pid, signal.SIGKILL)
            wait_for(lambda: gone(int(lines.of("a")[0])), "the grandchild gone")

    def test_a_program_that_does_not_exist_is_said_and_tried_again(self, lines: Lines) -> None:
        what = ProcessSpec("a", ("/nowhere/program",))
        with Supervisor([what], lines, policy=lambda: RestartPolicy(0.05)):
            wait_for(lambda: len(lines.of("mrlab")) >= 2, "two tries")
        assert "FileNotFoundError" in " ".join(lines.of("a"))

    def test_a_lab_whose_folder_was_moved_says_so_and_does_not_flood_the_log(
        self, lines: Lines, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        policy = RestartPolicy(0.01, longest=60.0, stable=60.0)
        with Supervisor([spec("a", SLEEPER)], lines, policy=lambda: policy) as supervisor:
            wait_for(lambda: lines.of("a"), "a running")
            policy.started(time.monotonic() - 100.0)
            monkeypatch.setattr(sys, "executable", "/moved/python")
            os.kill(supervisor.states[0].pid or 0, signal.SIGKILL)
            wait_for(lambda: len(lines.of("mrlab")) >= 4, "four tries")
        said = lines.of("mrlab")
        assert "there is no /moved/python; if the lab's folder was moved" in said[1]
        assert [line.rpartition("restarts in ")[2] for line in said[:4]] == [
            "0.01 s",
            "0.02 s",
            "0.04 s",
            "0.08 s",
        ]

    def test_stop_lets_processes_end_cleanly(self, lines: Lines) -> None:
        with Supervisor([spec("a", SLEEPER), spec("b", SLEEPER)], lines) as supervisor:
            wait_for(lambda: lines.of("a") and lines.of("b"), "both up")
            pids = [state.pid for state in supervisor.states]
        assert lines.of("a") == lines.of("b") == ["up", "bye"]
        assert [state.phase for state in supervisor.states] == ["stopped", "stopped"]
        assert all(pid is not None and gone(pid) for pid in pids)

    def test_stop_kills_what_does_not_end(self, lines: Lines) -> None:
        with Supervisor([spec("a", STUBBORN)], lines) as supervisor:
            wait_for(lambda: lines.of("a"), "up")
            pid = supervisor.states[0].pid
            supervisor.stop(grace=0.1)
            assert pid is not None
            assert gone(pid)
        assert supervisor.states[0].pid is None

    def test_stop_takes_grandchildren_along(self, lines: Lines) -> None:
        with Supervisor([spec("a", PARENT)], lines):
            wait_for(lambda: lines.of("a"), "the grandchild's id")
        wait_for(lambda: gone(int(lines.of("a")[0])), "the end of the grandchild")

    def test_stop_ends_a_wait_for_a_restart(self, lines: Lines) -> None:
        with Supervisor(
            [spec("a", "raise SystemExit(3)")], lines, policy=lambda: RestartPolicy(600.0)
        ) as supervisor:
            wait_for(lambda: supervisor.states[0].phase == "waiting to restart", "waiting")
        assert supervisor.states[0].phase == "stopped"
        assert supervisor.states[0].last_exit == "exit code 3"

    def test_a_process_that_refuses_its_configuration_is_not_started_again(
        self, lines: Lines
    ) -> None:
        refuse = spec("a", f"print('no such robot')\nraise SystemExit({WRONG_CONFIGURATION})")
        with Supervisor([refuse], lines, policy=lambda: RestartPolicy(0.01)) as supervisor:
            wait_for(lambda: supervisor.states[0].phase == "wrong configuration", "the refusal")
            wait_for(lambda: lines.of("mrlab"), "a word on it")
            assert "is not started again" in lines.of("mrlab")[-1]
            assert lines.of("a") == ["no such robot"]
            # The keys were corrected, say: whoever asks for a restart gets one.
            supervisor.restart("a")
            wait_for(lambda: len(lines.of("a")) == 2, "the second start")
            wait_for(lambda: len(lines.of("mrlab")) == 2, "the second refusal")
        assert supervisor.states[0].phase == "stopped"
        assert supervisor.states[0].restarts == 1

    def test_a_restart_does_not_wait_for_the_delay(self, lines: Lines) -> None:
        with Supervisor(
            [spec("a", "print('up')\nraise SystemExit(3)")],
            lines,
            policy=lambda: RestartPolicy(600.0),
        ) as supervisor:
            wait_for(lambda: supervisor.states[0].phase == "waiting to restart", "waiting")
            supervisor.restart("a")
            wait_for(lambda: len(lines.of("a")) == 2, "the second start")

    def test_every_change_is_reported(self, lines: Lines) -> None:
        phases: list[str] = []
        with Supervisor(
            [spec("a", SLEEPER)], lines, changed=lambda states: phases.append(states[0].phase)
        ):
            wait_for(lambda: lines.of("a"), "up")
        assert phases == ["running", "stopped"]

    def test_an_end_is_reported_at_once_with_its_instant_and_what_follows(
        self, lines: Lines
    ) -> None:
        reports: list[tuple[int, ProcessState]] = []

        def take(states: list[ProcessState]) -> None:
            reports.append((time.monotonic_ns(), states[0]))

        # The grandchild keeps the pipe open: the last lines are awaited, the report is not.
        what = replace(spec("a", PARENT), nodes=("node_a",))
        with Supervisor([what], lines, take, lambda: RestartPolicy(0.3)) as supervisor:
            wait_for(lambda: lines.of("a"), "up")
            killed_ns = time.monotonic_ns()
            os.kill(supervisor.states[0].pid or 0, signal.SIGKILL)
            wait_for(lambda: len(lines.of("a")) == 2, "up again")
        phases = [state.phase for _, state in reports]
        assert phases == ["running", "waiting to restart", "running", "stopped"]
        (at_ns, dead), (_, back) = reports[1:3]
        assert (dead.exit_code, dead.last_exit, dead.pid) == (-signal.SIGKILL, "SIGKILL", None)
        assert (dead.nodes, dead.restart_in) == (("node_a",), 0.3)
        assert killed_ns < dead.down_steady_ns <= at_ns
        assert abs(dead.down - time.time()) < DEADLINE
        assert (back.restarts, back.down_steady_ns) == (1, dead.down_steady_ns)

    def test_a_process_that_a_signal_stops_is_reported_as_frozen_and_its_return_too(
        self, lines: Lines
    ) -> None:
        states: list[ProcessState] = []
        deaths = Deaths(time.monotonic_ns())
        found: list[ProcessState] = []

        def take(now: list[ProcessState]) -> None:
            states.extend(now)
            found.extend(deaths.new(now))

        with Supervisor([spec("a", SLEEPER)], lines, take) as supervisor:
            wait_for(lambda: lines.of("a"), "up")
            pid = supervisor.states[0].pid or 0
            for number, phase in (
                (signal.SIGSTOP, "stopped by a signal"),
                (signal.SIGCONT, "running"),
            ):
                os.kill(pid, number)
                wait_for(lambda phase=phase: states[-1].phase == phase, phase)
            os.kill(pid, signal.SIGSTOP)
            wait_for(lambda: states[-1].frozen, "the second freeze")
            os.kill(pid, signal.SIGKILL)
            wait_for(lambda: states[-1].restarts == 1, "the restart")
        assert [state.frozen for state in found] == [True, True, False]
        assert found[-1].last_exit == "SIGKILL"

    @pytest.mark.parametrize("unblocks_sigint", [True, False])
    def test_a_program_that_unblocks_sigint_is_started_with_it_blocked(
        self, lines: Lines, unblocks_sigint: bool
    ) -> None:
        code = """
            import signal, sys, time
            print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ()), flush=True)
            time.sleep(600)
        """
        argv = (sys.executable, "-S", "-c", textwrap.dedent(code))
        what = ProcessSpec("a", argv, unblocks_sigint=unblocks_sigint)
        with Supervisor([what], lines):
            wait_for(lambda: lines.of("a"), "its mask")
        assert lines.of("a")[0] == str(unblocks_sigint)

    def test_no_orphan_when_the_supervisor_is_killed(self, tmp_path: Path) -> None:
        code = f"""
            import sys, time
            from mrlab_ros.processes.child_process import ProcessSpec
            from mrlab_ros.processes.supervisor import Supervisor
            argv = (sys.executable, "-u", "-S", "-c", {textwrap.dedent(STUBBORN)!r})
            specs = [ProcessSpec("a", argv), ProcessSpec("b", argv)]
            ups = []
            supervisor = Supervisor(specs, lambda name, line: ups.append(line))
            supervisor.start()
            while ups.count("up") < 2:
                time.sleep(0.01)
            print(*(state.pid for state in supervisor.states), flush=True)
            time.sleep(600)
        """
        script = tmp_path / "supervise.py"
        script.write_text(textwrap.dedent(code))
        with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE) as supervisor:
            try:
                assert supervisor.stdout is not None
                pids = [int(pid) for pid in supervisor.stdout.readline().split()]
                assert len(pids) == 2
                assert not any(gone(pid) for pid in pids)
            finally:
                supervisor.kill()
        wait_for(lambda: all(gone(pid) for pid in pids), "both processes gone")


class TestRunFile:
    @pytest.fixture(autouse=True)
    def folder(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))

    def test_says_what_the_living_supervisor_keeps(self, lines: Lines) -> None:
        file = RunFile(7)
        assert RunFile(7).read() is None
        file.claim(state_dir="/somewhere")
        with Supervisor([spec("a", SLEEPER)], lines, changed=file.write):
            wait_for(lambda: lines.of("a"), "up")
            said = RunFile(7).read()
            assert said is not None
            assert (said["domain"], said["pid"], said["state_dir"]) == (
                7,
                os.getpid(),
                "/somewhere",
            )
            assert [p["phase"] for p in said["processes"]] == ["running"]
        file.release()
        assert RunFile(7).read() is None

    def test_a_domain_has_one_supervisor(self) -> None:
        file = RunFile(7)
        file.claim()
        with pytest.raises(Misuse, match=rf"domain 7 already \(process {os.getpid()}\)"):
            RunFile(7).claim()
        RunFile(8).claim()
        file.release()
        RunFile(7).claim()

    def test_what_a_killed_supervisor_left_is_not_believed(self) -> None:
        code = (
            "import os, signal\nfrom mrlab_ros.processes.run_file import RunFile\n"
            "RunFile(7).claim()\nos.kill(os.getpid(), signal.SIGKILL)"
        )
        done = subprocess.run([sys.executable, "-c", code], check=False)
        assert done.returncode == -signal.SIGKILL
        assert RunFile(7).read() is None
        RunFile(7).claim()
