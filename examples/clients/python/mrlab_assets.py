#!/usr/bin/env python3
"""Fetches what a client draws the lab with: models, end effectors, objects, meshes.

    python mrlab_assets.py                                  # lists robots and objects
    python mrlab_assets.py robots.json
    python mrlab_assets.py robots/ur5e+parallel_gripper.urdf ur5e   # the URDF with its meshes

package://mrlab_ros/robots/... of a URDF is the key assets/mrlab_ros/robots/... A file that is
larger than a reply comes in pieces; each says size and SHA-256 of the whole.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import sys
from pathlib import Path

import zenoh
from mrlab_client import LOOPBACK, connect

# Bytes a reply; the lab sends up to 1 MiB at a time. A slow link wants less.
PIECE = 1 << 18
MESH = re.compile(r'"package://([^"]+)"')


def fetch(session: zenoh.Session, path: str, prefix: str = "") -> bytes:
    """Return an asset; exit with the lab's reason where there is none."""
    data = b""
    whole = None
    while whole is None or len(data) < whole["size"]:
        selector = f"{prefix}assets/{path}?offset={len(data)};length={PIECE}"
        # Behind joint states, which the same link carries.
        replies = list(session.get(selector, timeout=10.0, priority=zenoh.Priority.BACKGROUND))
        if not replies:
            sys.exit("no lab answers: check --connect and --prefix")
        if replies[0].ok is None:
            sys.exit(replies[0].err.payload.to_string())
        found = json.loads(replies[0].ok.attachment.to_bytes())
        if whole is not None and found["sha256"] != whole["sha256"]:
            data, whole = b"", None  # another version meanwhile: from the beginning
            continue
        whole = found
        data += replies[0].ok.payload.to_bytes()
    if hashlib.sha256(data).hexdigest() != whole["sha256"]:
        sys.exit(f"{path} arrived damaged; fetch it again")
    return data


def fetch_urdf(session: zenoh.Session, path: str, folder: Path, prefix: str = "") -> Path:
    """Write a URDF and all its meshes into `folder`; return the URDF, which names them there."""
    text = fetch(session, path, prefix).decode()
    for place in sorted(set(MESH.findall(text))):
        file = folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(fetch(session, place, prefix))
    urdf = folder / Path(path).name
    urdf.write_text(MESH.sub(r'"\1"', text))
    return urdf


def list_all(session: zenoh.Session, prefix: str) -> None:
    """Print robots and objects, one a line."""
    for robot in json.loads(fetch(session, "robots.json", prefix))["robots"]:
        joints = len(robot["joints"])
        print(f"{robot['id']:<22} {robot['name']}, {joints} joints, {robot['payload']:g} kg")
    for kind in json.loads(fetch(session, "objects.json", prefix))["objects"]:
        print(f"{kind['id']:<22} {kind['about']}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("path", nargs="?", help="an asset, such as robots.json")
    parser.add_argument("folder", nargs="?", type=Path, help="where it is written")
    parser.add_argument("--prefix", default="", help="of the lab's keys, such as lab_1")
    parser.add_argument("--connect", default="", help=f"endpoint; {LOOPBACK} if not given")
    parser.add_argument("--config", type=Path, help="file for a lab with keys: NAME.json5")
    arguments = parser.parse_args()
    path, folder = arguments.path, arguments.folder
    prefix = f"{arguments.prefix}/" if arguments.prefix else ""
    with connect(arguments.connect, arguments.config) as session:
        if path is None:
            list_all(session, prefix)
        elif folder is None:
            sys.stdout.buffer.write(fetch(session, path, prefix))
        elif path.endswith(".urdf"):
            folder.mkdir(parents=True, exist_ok=True)
            print(fetch_urdf(session, path, folder, prefix))
        else:
            folder.mkdir(parents=True, exist_ok=True)
            (folder / Path(path).name).write_bytes(fetch(session, path, prefix))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(0)
