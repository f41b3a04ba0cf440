"""A running lab: check, show, convert, play, record, watch."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_client.errors import FileRefused, LabError
from mrlab_client.http import Gateway
from mrlab_client.link import Link, Newest
from mrlab_client.motion import Check, Motion, check_of, motion_of, packed
from mrlab_client.recording import Recording
from mrlab_client.robot import LabRobot, Run, standing

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

LOCAL = "http://127.0.0.1:8080"


class Lab:
    """A running lab at the address of its pages; use it as a context manager.

    The first time it shows a code, which a person who is signed in confirms on a page; the token
    is kept in the user's folder for settings. Every call returns when the lab has answered, and
    raises LabError with the lab's own sentence where it refuses.
    """

    def __init__(self, url: str = LOCAL, *, token: str = "", ca: str | Path = "") -> None:
        """token: of `mrlab users token`. ca: the lab's own authority, from its page /ca."""
        self._http = Gateway(url, token, ca)
        self._link: Link | None = None

    @property
    def link(self) -> Link:
        """The connection for topics and services, made when it is needed first."""
        if self._link is None:
            self._link = Link(self._http)
            self._scene = Newest(self._link, "robots")
        return self._link

    def close(self) -> None:
        """End all subscriptions; the lab goes on."""
        if self._link is not None:
            self._link.close()
            self._link = None

    def __enter__(self) -> Lab:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def robots(self) -> list[LabRobot]:
        """Return the robots of the scene."""
        link = self.link
        return [LabRobot(link, each) for each in self._scene.newest().robots]

    def robot(self, name: str = "") -> LabRobot:
        """Return the robot called `name`; empty: the only one."""
        there = self.robots()
        found = [each for each in there if not name or each.name == name]
        if len(found) != 1:
            names = ", ".join(each.name for each in there) or "none"
            raise LabError(f"Name one of the lab's robots: {names}.", "name_a_robot")
        return found[0]

    def spawn(
        self,
        model: str,
        *,
        at: tuple[float, float] | None = None,
        yaw: float = 0.0,
        end_effector: str = "",
        name: str = "",
    ) -> LabRobot:
        """Put a robot into the scene. at: x and y of its base, m; None: a free place."""
        request: dict[str, Any] = {"model": model, "end_effector": end_effector, "name": name}
        request["automatic"] = at is None
        if at is not None:
            request["pose"] = standing(*at, yaw)
        return LabRobot(self.link, self.link.call("lab/spawn_robot", request).robot)

    def trajectories(self) -> list[Motion]:
        """Return what there is to load."""
        found = self._http.get("/api/trajectories")["trajectories"]
        return [motion_of(each, self._http, ()) for each in found]

    def check(
        self,
        q: ArrayLike | str | Path,
        fs: ArrayLike | None = None,
        robot: str = "",
        **options: Any,
    ) -> Check:
        """Say what is wrong with a motion; nothing is shown or published.

        q: (N, J) rad, a row a frame, or a Path. fs: Hz, or (N,) s. robot: a model; empty: that of
        the lab's first robot. options: as of `mrlab convert`, such as units="deg".
        """
        return self._sent(q, fs, robot, shown=False, **options)

    def show(
        self,
        q: ArrayLike | str | Path,
        fs: ArrayLike | None = None,
        robot: str = "",
        **options: Any,
    ) -> Check:
        """Show a motion on the page that is open, in place of the one before."""
        return self._sent(q, fs, robot, shown=True, **options)

    def convert(
        self,
        file: ArrayLike | str | Path,
        robot: LabRobot | str = "",
        *,
        fs: ArrayLike | None = None,
        end_effector: str = "",
        id: str = "",
        shared: bool = False,
        **options: Any,
    ) -> Motion:
        """Put a motion into the catalogue; raise FileRefused, with the findings, where it is not
        taken. robot: the one that will play it, or a model."""
        model = robot if isinstance(robot, str) else robot.model
        tool = end_effector if isinstance(robot, str) else robot.end_effector
        name = id.rsplit("/", 1)[-1] or "array"
        found = self._sent(file, fs, model, shown=False, name=name, end_effector=tool, **options)
        if not found.ok:
            raise FileRefused(found)
        body = {"draft": found.draft, "id": id, "shared": shared}
        made = self._http.post("/api/trajectories", body)
        return motion_of(made, self._http, found.findings)

    def play(
        self,
        motion: Motion | str | Path | ArrayLike,
        robot: LabRobot | str = "",
        *,
        fs: ArrayLike | None = None,
        speed: float | None = None,
        loop: bool | None = None,
        **options: Any,
    ) -> Run:
        """Play an array, a Path or a trajectory of the catalogue; return the run.

        robot: empty: the only robot of the lab.
        """
        if not isinstance(robot, LabRobot):
            robot = self.robot(robot)
        if not isinstance(motion, Motion | str):
            motion = self.convert(motion, robot, fs=fs, **options)
        return robot.play(motion, speed=speed, loop=loop)

    def record(self, robot: LabRobot | str = "*") -> Recording:
        """Record the joint states of a robot, or of all, in this program; see Recording."""
        name = robot if isinstance(robot, str) else robot.name
        return Recording(self.link, f"{name}/joint_states")

    def watch(self, topic: str, callback: Callable[[Any], None]) -> None:
        """Call `callback` with every message of a topic, such as objects, in a thread of its own.

        A latched topic gives its newest message at once.
        """
        self.link.subscribe(topic.lstrip("/"), lambda _, message: callback(message))

    def _sent(
        self,
        q: ArrayLike | str | Path,
        fs: ArrayLike | None,
        robot: str,
        *,
        shown: bool,
        name: str = "array",
        **options: Any,
    ) -> Check:
        if not robot:
            there = self._http.get("/api/robots")["robots"]
            if not there:
                raise LabError("Name the model, such as ur5e: the lab has no robot.", "no_model")
            robot = there[0]["model"]
        if isinstance(q, str | Path):
            try:
                data, file = Path(q).read_bytes(), Path(q).name
            except OSError as error:
                raise LabError(
                    f"{q} cannot be read: {error.strerror}.", "file_unreadable"
                ) from None
            if fs is not None:
                options["frame_rate"] = fs
        else:
            data, file = packed(q, fs), f"{name}.npz"
        answer = self._http.put(
            f"/api/live/{file}", data, robot_model=robot, shown=shown, **options
        )
        return check_of(answer, self._http.url)


def check(
    q: ArrayLike, fs: ArrayLike | None = None, robot: str = "", *, url: str = LOCAL, **options: Any
) -> Check:
    """Ask a lab what is wrong with a motion; see Lab.check."""
    with Lab(url) as lab:
        return lab.check(q, fs, robot, **options)
