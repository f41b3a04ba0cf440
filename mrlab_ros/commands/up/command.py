"""`mrlab up`: checks what a lab is started with, and keeps it running until Ctrl-C."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.commands.up.keys import (
    asks_for_passwords,
    checked_listen,
    checked_router,
    free_endpoint,
)
from mrlab_ros.commands.up.lab_run import LabRun
from mrlab_ros.commands.up.surroundings import (
    folder_for_state,
    stay_on_this_machine,
    stop_signals,
)
from mrlab_ros.commands.up.web import checked_web, prepare_keys
from mrlab_ros.processes import physics_support
from mrlab_ros.processes.lab import parameter_file, parts_of_lab, robot_models
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.zygote import Zygote
from mrlab_ros.ros.environment import domain_id


def up(
    config: Annotated[
        Path | None, typer.Option(help="ROS parameter file; the shipped lab.yaml if not given.")
    ] = None,
    robots: Annotated[
        str, typer.Option(help="Robots to begin with, such as ur5e,kuka_kr3_r540.")
    ] = "",
    bridge: Annotated[bool, typer.Option(help="Carry the graph over zenoh.")] = True,
    physics: Annotated[
        bool | None,
        typer.Option(
            "--physics/--no-physics",
            help="Simulate contacts and grasps; not given: where pybullet is installed.",
        ),
    ] = None,
    frames: Annotated[
        bool, typer.Option(help="Publish /tf and markers for RViz, Foxglove and recordings.")
    ] = True,
    keys: Annotated[
        Path | None,
        typer.Option(
            help="Keys folder (mrlab keys init): only its people may connect, with TLS, from "
            "anywhere."
        ),
    ] = None,
    zenoh_listen: Annotated[
        str,
        typer.Option(
            help="Where the bridge listens for zenoh clients; not given: tcp/127.0.0.1:7447, "
            "with --keys tls/0.0.0.0:7447."
        ),
    ] = "",
    zenoh_connect: Annotated[
        str,
        typer.Option(
            help="With --keys: a router of your own (mrlab keys router) that lets people in, in "
            "place of the bridge itself, such as tls/router.example.org:7447."
        ),
    ] = "",
    insecure: Annotated[
        bool,
        typer.Option(
            "--insecure", help="Listen beyond this machine without keys: anybody may do anything."
        ),
    ] = False,
    state_dir: Annotated[
        Path | None,
        typer.Option(help="Folder for scene and trajectories; not given: gone with the lab."),
    ] = None,
    store: Annotated[
        str,
        typer.Option(
            help="Where uploads and trajectories are kept: a folder, or an URL such as "
            "s3://bucket/lab; not given: in the folder for state."
        ),
    ] = "",
    only: Annotated[
        str,
        typer.Option(
            metavar="NAME,NAME",
            help="Run these processes alone, such as playback,physics: another machine runs the "
            "others of the same lab.",
        ),
    ] = "",
    sim_time: Annotated[
        bool,
        typer.Option(
            "--sim-time", help="The topic /clock gives the time, as use_sim_time says in ROS."
        ),
    ] = False,
    web: Annotated[bool, typer.Option(help="Serve the pages for browsers and headsets.")] = True,
    http: Annotated[
        str,
        typer.Option(
            metavar="HOST:PORT",
            help="Where the pages are served; not given: 127.0.0.1:8080, with --keys or a "
            "certificate 0.0.0.0:8080. Port 0: any free one.",
        ),
    ] = "",
    https_cert: Annotated[
        Path | None,
        typer.Option(help="Certificate for HTTPS (PEM, whole chain), if not that of --keys."),
    ] = None,
    https_key: Annotated[
        Path | None, typer.Option(help="The private key of --https-cert (PEM).")
    ] = None,
    public_url: Annotated[
        str,
        typer.Option(
            help="Address of a reverse proxy that offers the pages, such as "
            "https://lab.example.org; people then sign in."
        ),
    ] = "",
    oidc: Annotated[
        Path | None,
        typer.Option(help="YAML file of an OpenID Connect provider by which people sign in."),
    ] = None,
    web_limits: Annotated[
        Path | None,
        typer.Option(help="YAML file of how many pages there may be and what each may send."),
    ] = None,
    class_folder: Annotated[
        Path | None,
        typer.Option(
            "--class",
            help="Folder that mrlab class made: instructors step through it in pages and room.",
        ),
    ] = None,
    lti: Annotated[
        Path | None,
        typer.Option(help="YAML file of the learning platform whose course the class is."),
    ] = None,
) -> None:
    """Start the lab and keep it running until Ctrl-C.

    Every line of output says which process it came from. A process that dies is started again.
    Where the parameter file is wrong, nothing starts and all its mistakes are named; where a
    process refuses its configuration, the lab ends with exit code 1.
    The graph stays on this machine unless ROS_AUTOMATIC_DISCOVERY_RANGE says otherwise, and is
    on the domain of ROS_DOMAIN_ID.
    """
    stay_on_this_machine()
    # Imports take longest: they begin before the checks.
    with Zygote() as zygote:
        parts = parts_of_lab(only)
        bridge = bridge and (not parts or "bridge" in parts)
        models = robot_models(robots)
        listen = None
        if bridge and zenoh_connect:
            listen = checked_router(zenoh_connect, zenoh_listen, keys, insecure)
        elif bridge:
            listen = checked_listen(zenoh_listen, keys, insecure)
            if zenoh_listen or config is None:
                listen = free_endpoint(listen)
        pages = None
        if web and bridge:
            pages = checked_web(
                http,
                keys=keys,
                insecure=insecure,
                certificate=https_cert,
                certificate_key=https_key,
                public_url=public_url.rstrip("/"),
                oidc=oidc,
                limits=web_limits,
                classroom=class_folder,
                lti=lti,
            )
            if keys is not None:
                prepare_keys(keys)
        with_physics, no_physics = physics_support.wanted(physics)
        domain = domain_id()
        run_file = RunFile(domain)
        with folder_for_state(state_dir) as folder, stop_signals() as stop:
            options = LabOptions(
                lab_id="" if parts else new_lab_id(),
                config=parameter_file(config),
                state_dir=folder,
                robots=models,
                physics=with_physics,
                frames=frames,
                bridge=bridge,
                listen=(zenoh_listen and listen) or "",
                connect=zenoh_connect,
                keys=keys,
                insecure=insecure,
                store=checked_store(store),
                socket=run_file.socket if bridge and not asks_for_passwords(keys) else "",
                web=pages,
                sim_time=sim_time,
                only=parts,
            )
            LabRun(options, listen, no_physics, stop, zygote).keep(run_file, domain)


def checked_store(place: str) -> str:
    """Return the store's URL or its folder's whole path; raise BadInput for one of no use."""
    if not place:
        return ""
    from mrlab_ros.adapters.store.objects import open_store

    return open_store(place).place
