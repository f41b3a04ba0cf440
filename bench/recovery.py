"""How long after a kill or a freeze of a process of the lab the next command works.

A real lab with physics and bridge, a system of two robots that plays and a robot beside it. Each
process is killed (kill -9), and frozen for 3 s; from then on, or from the end of the freeze, a
client repeats the command that a person would give next, until it succeeds. Mark: 5 s each.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import time
from pathlib import Path
from typing import Any

import report
import zenoh
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from safety import Bench, motion
from tf2_msgs.msg import TFMessage

from mrlab_ros.adapters.trajectories.npz_file import write
from mrlab_ros.messages import qos
from mrlab_ros.processes.lab import lab_processes, parameter_file
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.ros.calls import NoAnswer, call

MODEL = "ur5e"
FREEZE_S = 3.0
# A client that has no answer by then asks again, s.
ANSWER_S = 1.0
# Members have moved to their places, and processes have run for a while, after this time, s.
SETTLE_S = 5.0
# A lab that takes longer is broken, s.
LONGEST_S = 40.0


class Commands:
    """What a person does next, by the process that was hit. Each returns whether it worked."""

    def __init__(self, bench: Bench, endpoint: str) -> None:
        self._bench, self._endpoint = bench, endpoint
        self.said = ""
        self._transforms = 0
        bench.node.create_subscription(TFMessage, "/tf", self._on_transforms, qos.STREAM)

    def _on_transforms(self, _: TFMessage) -> None:
        self._transforms += 1

    def _ask(self, kind: Any, service: str, **fields: Any) -> Any:
        try:
            return call(self._bench.client(kind, service), kind.Request(**fields), ANSWER_S)
        except NoAnswer as error:
            self.said = str(error)
            return None

    def _works(self, kind: Any, service: str, **fields: Any) -> bool:
        answer = self._ask(kind, service, **fields)
        if answer is not None:
            self.said = answer.message
        return answer is not None and answer.success

    def play(self) -> bool:
        return self._works(Trigger, "/cell/play") or "cannot play in" in self.said

    def lab(self) -> bool:
        found = self._ask(srv.ListTrajectories, "/converter/list_any", robot_model=MODEL)
        return found is not None and self._works(Trigger, "/cell/pause")

    def playback(self) -> bool:
        alone = self._works(Trigger, f"/{MODEL}_3/stop")
        return alone and self.play()

    def recorder(self) -> bool:
        # A start that came too late for its caller is one.
        started = self._works(srv.StartRecording, "/recorder/start")
        return started or "runs; stop it" in self.said

    def tidy(self) -> None:
        """End what a command began."""
        call(self._bench.client(Trigger, "/recorder/stop"), Trigger.Request(), LONGEST_S)

    def physics(self) -> bool:
        return self._works(srv.SpawnObject, "/physics/spawn_object", type="cube", automatic=True)

    def frames(self) -> bool:
        before = self._transforms
        time.sleep(0.1)
        return self._transforms > before

    def bridge(self) -> bool:
        config = zenoh.Config()
        config.insert_json5("mode", '"client"')
        config.insert_json5("connect/endpoints", f'["{self._endpoint}"]')
        config.insert_json5("scouting/multicast/enabled", "false")
        try:
            with zenoh.open(config) as session:
                return any(r.ok for r in session.get("@mrlab/bridge/clock", timeout=ANSWER_S))
        except zenoh.ZError:
            return False


def until(commands: Commands, name: str) -> float:
    """Repeat a command until it works; return how long that took, s."""
    began = time.monotonic()
    while not getattr(commands, name)():
        if time.monotonic() - began > LONGEST_S:
            raise SystemExit(f"{name} does not work again within {LONGEST_S:g} s: {commands.said}")
        time.sleep(0.02)
    return time.monotonic() - began


def run(folder: Path, rounds: float) -> list[dict[str, Any]]:
    (folder / "trajectories").mkdir()
    with (folder / "trajectories" / "short.npz").open("wb") as file:
        write(motion("short", 6_000), file)
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    options = LabOptions(
        parameter_file(None), folder, (MODEL,) * 3, listen=endpoint, lab_id=new_lab_id()
    )
    processes = lab_processes(options)
    rows = []
    with Supervisor([p.spec(options) for p in processes], lambda name, line: None) as up:
        bench = Bench()
        robots = [f"{MODEL}_{i + 1}" for i in range(3)]
        for robot in robots:
            bench.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
        members = [msg.SystemMember(robot=robot) for robot in robots[:2]]
        bench.ask(srv.CreateSystem, "/coordinator/create_system", name="cell", members=members)
        bench.ask(SetLoop, "/cell/set_loop", loop=True)
        commands = Commands(bench, endpoint)
        names = [process.name for process in processes]
        for blow in ("kill -9", "freeze 3 s") if rounds else ("kill -9",):
            for name in names if rounds else names[:1]:
                took = []
                for _ in range(round(rounds) or 1):
                    until(commands, "play")
                    # Until it plays; and a process that has just begun is restarted later.
                    time.sleep(SETTLE_S)
                    pid = up.states[names.index(name)].pid
                    assert pid is not None
                    if blow == "kill -9":
                        os.kill(pid, signal.SIGKILL)
                    else:
                        os.kill(pid, signal.SIGSTOP)
                        time.sleep(FREEZE_S)
                        os.kill(pid, signal.SIGCONT)
                    took.append(until(commands, name))
                    commands.tidy()
                    print(f"{blow} {name}: {took[-1]:.2f} s", file=sys.stderr, flush=True)
                rows.append(
                    {
                        "blow": blow,
                        "process": name,
                        "rounds": rounds,
                        "median s": sorted(took)[len(took) // 2],
                        "max s": max(took),
                    }
                )
        bench.close()
    return rows


if __name__ == "__main__":
    report.whole_lab(__doc__, "From a blow to the next command that works", run, 1, 5)
