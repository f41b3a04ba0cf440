"""The arguments of the launch files, from which they and their page in the docs are made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mrlab_ros.adapters.bullet.support import missing

FLAG = ("true", "false")
# What an argument with such a default may be; others may be anything.
CHOICES = {"true": FLAG, "false": FLAG, "localhost": ("localhost", "subnet")}


@dataclass(frozen=True)
class Argument:
    """An argument, NAME:=VALUE. default: None: it has to be given."""

    name: str
    default: str | None
    about: str

    @property
    def choices(self) -> tuple[str, ...]:
        """The values that it may have; none: any."""
        return CHOICES.get(self.default or "", ())

    @property
    def settings(self) -> dict[str, Any]:
        """Return what launch's DeclareLaunchArgument takes beside the name."""
        found: dict[str, Any] = {"description": self.about}
        if self.default is not None:
            found["default_value"] = self.default
        if self.choices:
            found["choices"] = list(self.choices)
        return found


LAB = (
    Argument("config", "", "ROS parameter file; empty: the shipped config/lab.yaml"),
    Argument("robots", "", "robots to begin with, such as ur5e,kuka_kr3_r540"),
    Argument(
        "scene",
        "",
        "scene to load when the lab is ready, such as handover; it replaces the robots",
    ),
    Argument(
        "remap",
        "",
        "names to remap in the lab's nodes, such as /clock:=/sim/clock, with commas",
    ),
    Argument("physics", "false" if missing() else "true", "simulate contacts and grasps"),
    Argument("frames", "true", "publish /tf and markers for RViz, Foxglove and recordings"),
    Argument("rviz", "false", "start RViz with config/mrlab.rviz"),
    Argument("record", "", "bag to record into from when the lab is ready"),
    Argument("bridge", "true", "carry the graph over zenoh"),
    Argument(
        "listen",
        "",
        "where zenoh clients connect; empty: tcp/127.0.0.1:7447, with keys tls/0.0.0.0:7447",
    ),
    Argument("connect", "", "with keys: a secured router that lets people in (mrlab keys router)"),
    Argument("keys", "", "keys folder (mrlab keys init); empty: no keys, this machine only"),
    Argument("insecure", "false", "listen beyond this machine without keys"),
    Argument("web", "true", "serve the pages for browsers and headsets"),
    Argument(
        "http",
        "",
        "where the pages are served, HOST:PORT; empty: 127.0.0.1:8080, with keys 0.0.0.0:8080",
    ),
    Argument("https_cert", "", "certificate for HTTPS (PEM, whole chain), if not that of keys"),
    Argument("https_key", "", "the private key of https_cert (PEM)"),
    Argument("public_url", "", "address of a reverse proxy that offers the pages; people sign in"),
    Argument("oidc", "", "YAML file of an OpenID Connect provider by which people sign in"),
    Argument("web_limits", "", "YAML file of how many pages there may be and what each may send"),
    Argument("class", "", "folder that mrlab class made, for instructors to step through"),
    Argument("lti", "", "YAML file of the learning platform whose course the class is"),
    Argument("state_dir", "", "folder for scene and trajectories; empty: a temporary one"),
    Argument("store", "", "uploads and trajectories: a folder or URL; empty: in state_dir"),
    Argument(
        "discovery",
        "localhost",
        "who finds the ROS graph, which asks for no key; subnet: everybody on this network",
    ),
    Argument("only", "", "processes to run, such as playback,physics; empty: the whole lab"),
    Argument("use_sim_time", "false", "the topic /clock gives the time"),
)
ROBOT = (
    Argument("model", None, "a robot model, such as ur5e; mrlab robots lists them"),
    Argument("name", "", "its name; empty: the model and a number"),
    Argument("x", "", "where its base goes, m; empty, and y too: a free place"),
    Argument("y", "", "where its base goes, m"),
    Argument("yaw", "0", "turn about the vertical, degrees"),
    Argument("end_effector", "", "an end effector, such as parallel_gripper; empty: none"),
    Argument(
        "discovery",
        "localhost",
        "who finds the ROS graph, as of lab.launch.py: localhost, subnet",
    ),
)
