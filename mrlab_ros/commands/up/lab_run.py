"""A lab under `mrlab up`, from its start to its end."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, field

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.scenes.files import SCENE_FILE
from mrlab_ros.adapters.set_up import ROOT, outdated
from mrlab_ros.commands.diagnostics import OPEN_TO_ALL, SCENE_COMES_BACK, WAITS_FOR_CLOCK
from mrlab_ros.commands.up.keys import follow_keys, keys_changed_at, tell_when_keys_expire
from mrlab_ros.commands.up.refusals import Refusals
from mrlab_ros.commands.up.speaker import Speaker
from mrlab_ros.commands.up.web import run_facts, say_where
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.diagnostics import SET_UP_OUTDATED
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.runtime.process_states import ProcessState
from mrlab_ros.processes.announcer import Announcer
from mrlab_ros.processes.child_process import SELF
from mrlab_ros.processes.lab import lab_nodes, lab_processes
from mrlab_ros.processes.options import LabOptions
from mrlab_ros.processes.parameter_file import parameter
from mrlab_ros.processes.readiness import READY_TIMEOUT_S, Readiness
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.processes.web import gateway_answers
from mrlab_ros.processes.zygote import Zygote


@dataclass
class LabRun:
    """Keeps the processes of one lab running, and says what a person has to know of it.

    listen: where zenoh clients connect; None: there is no bridge. no_physics: why there is none;
    None: there is, or nobody wants it. stop: ends the lab. zygote: forks its processes.
    """

    options: LabOptions
    listen: str | None
    no_physics: Diagnostic | None
    stop: threading.Event
    zygote: Zygote
    say: Speaker = field(default_factory=Speaker)

    def __post_init__(self) -> None:
        self._keys = self.options.keys if self.options.bridge else None
        self._web = {} if self.options.web is None else run_facts(self.options)
        self._begin = 0.0
        self._late: threading.Thread | None = None
        self._identity = Identity(self.options.lab_id, lambda said: self.say(SELF, str(said)))

    def keep(self, run_file: RunFile, domain: int) -> None:
        """Keep the lab running until it is stopped.

        Raises Misuse where another lab has the domain, BadInput where a process refuses its
        configuration.
        """
        specs = [process.spec(self.options) for process in lab_processes(self.options)]
        # Before bridge and pages read them: no later change is missed.
        seen = None if self._keys is None else keys_changed_at(self._keys)
        run_file.claim(**self._facts())
        if run_file.not_usual:
            self.say(SELF, f"{run_file.not_usual}; {run_file.folder} is used instead")
        self._begin = time.monotonic()
        refusals = Refusals(self.stop)
        self._announcer = announcer = Announcer(self.options.lab_id)

        def changed(states: list[ProcessState]) -> None:
            announcer.announce(states)
            run_file.write(states)
            refusals.check(states)

        try:
            with Supervisor(specs, self.say, changed, zygote=self.zygote) as supervisor:
                self.say(SELF, f"starts the lab on ROS domain {domain}; Ctrl-C stops it")
                self._say_notices()
                announcer.open()
                missing = self._missing()
                refusals.raise_any()
                self._say_ready_or_wait(missing)
                if self._keys is None or seen is None or self.options.connect:
                    self.stop.wait()
                else:
                    follow_keys(self._keys, seen, self.stop, self.say, supervisor.restart)
                # Another lab on this domain may have been taken for the process that refused.
                refusals.raise_any()
                self.say(SELF, "stops")
        finally:
            if self._late is not None:  # it is in the announcer's graph
                self.stop.set()
                self._late.join()
            announcer.close()
            run_file.release()

    def _facts(self) -> dict[str, object]:
        """Return what the commands of this machine's users have to know of the lab."""
        options = self.options
        facts: dict[str, object] = {
            "state_dir": str(options.state_dir),
            "zenoh": self.listen,
            "socket": "" if options.connect else options.socket,
            "prefix": parameter(options.config, "bridge", "prefix") or "",
        }
        return {**facts, "web": self._web} if self._web else facts

    def _say_notices(self) -> None:
        """Say what of the options has an effect that is easily overlooked."""
        options = self.options
        if options.robots and (options.state_dir / SCENE_FILE).exists():
            self.say(SELF, str(SCENE_COMES_BACK(folder=str(options.state_dir))))
        if self.listen is not None and options.insecure:
            self.say(SELF, str(OPEN_TO_ALL(endpoint=self.listen)))
        if self._keys is not None:
            tell_when_keys_expire(self._keys, self.say, router=bool(options.connect))
        if steps := outdated():
            self.say(SELF, str(SET_UP_OUTDATED(folder=str(ROOT), steps=steps)))
        if self.no_physics:
            self.say(SELF, str(self.no_physics))
        if options.sim_time:
            self.say(SELF, str(WAITS_FOR_CLOCK()))

    def _missing(self) -> str:
        """Wait until the lab is complete; return what is missing after READY_TIMEOUT_S."""
        from mrlab_ros.ros.graph_node import Graph

        answers = gateway_answers(self._web["here"]) if self._web else None
        nodes, robots = lab_nodes(self.options), len(self.options.robots)
        with Graph(context=self._announcer.context) as graph:
            return Readiness(graph, nodes, robots, self._identity).wait(self.stop, answers)

    def _say_ready_or_wait(self, missing: str) -> None:
        """Say that the lab is ready, and where; say so later where something is missing."""
        if missing:
            self.say(
                SELF,
                f"not complete after {READY_TIMEOUT_S:g} s: {missing} missing; waits on",
            )
        else:
            self._say_ready()
        if self._web and not self.stop.is_set():
            say_where(self._web, self.say)
        if missing:
            self._late = threads.loop("follow_late", self._follow_late)
            self._late.start()

    def _say_ready(self) -> None:
        if self.stop.is_set():
            return
        took = time.monotonic() - self._begin
        zenoh = f"; zenoh clients connect to {self.listen}" if self.options.bridge else ""
        self.say(SELF, f"the lab is ready after {took:.1f} s{zenoh}")

    def _follow_late(self) -> None:
        """Wait on until a lab is complete that was not in time, and say so; ends with `stop`."""
        while self._missing():
            pass
        self._say_ready()
