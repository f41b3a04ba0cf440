#!/usr/bin/env python3
"""A client of the lab that needs nothing of it: the lab delivers its definitions itself.

    pip install eclipse-zenoh rosbags
    python mrlab_client.py watch ur5e_1/joint_states sensor_msgs/msg/JointState
    python mrlab_client.py watch robots mrlab_msgs/msg/Robots --latched
    python mrlab_client.py call ur5e_1/play mrlab_msgs/srv/Trigger
    python mrlab_client.py call ur5e_1/seek mrlab_msgs/srv/Seek position=1.5

A key is the topic's or service's name without its leading slash; a payload is CDR.
"""

from __future__ import annotations

import argparse
import json
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import zenoh
from rosbags.interfaces import Nodetype
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore
from zenoh import ext

LOOPBACK = "tcp/127.0.0.1:7447"
# Over a network: a link that is silent for 1.5 s is given up and tried again twice a second.
HEALING = {
    "transport/link/tx/lease": 1500,
    "transport/unicast/open_timeout": 2000,
    "connect/retry": {
        "period_init_ms": 250,
        "period_max_ms": 500,
        "period_increase_factor": 1.5,
    },
}
SCHEMA = "schema"


def schema(session: zenoh.Session, prefix: str = "") -> tuple[dict[str, str], dict[str, str]]:
    """Return the lab's definitions, messages and services: type -> text; exit without them."""
    for reply in session.get(f"{prefix}{SCHEMA}", timeout=10.0):
        if reply.ok is not None:
            found = json.loads(reply.ok.payload.to_bytes())
            return found["messages"], found["services"]
    sys.exit(
        f"no lab answers {prefix}{SCHEMA}: check --connect and --prefix; behind the stock bridge "
        "give the folder with the lab's msg/ and srv/ with --definitions"
    )


def folder(
    definitions: Path, package: str = "mrlab_msgs"
) -> tuple[dict[str, str], dict[str, str]]:
    """Return the definitions in a folder with msg/ and srv/."""
    messages, services = (
        {f"{package}/{kind}/{f.stem}": f.read_text() for f in definitions.glob(f"{kind}/*.{kind}")}
        for kind in ("msg", "srv")
    )
    return messages, services


def typestore(messages: dict[str, str], services: dict[str, str]) -> Typestore:
    """Return the standard types and those with the given texts."""
    store = get_typestore(Stores.ROS2_JAZZY)
    found: dict[str, Any] = {}
    for name, text in messages.items():
        found |= get_types_from_msg(text, name)
    for name, text in services.items():
        request, _, response = text.partition("---\n")
        for half, part in (("Request", request), ("Response", response)):
            # A message without fields has no CDR of its own: nothing is sent for it.
            if any(line.split("#")[0].strip() for line in part.splitlines()):
                found |= get_types_from_msg(part, f"{name}_{half}".replace("/srv/", "/msg/"))
    # Those that the store has already are the same there.
    store.register({name: fields for name, fields in found.items() if name not in store.types})
    return store


def decode(store: Typestore, payload: bytes, kind: str) -> Any:
    """Return the message of type `kind` in `payload`, CDR; raise SerdeError where it is none.

    ROS counts padding before an empty list of numbers, which it then does not write: an answer may
    be followed by bytes that mean nothing, which rosbags takes for a mistake.
    """
    for end in range(len(payload), 4, -4):
        try:
            return store.deserialize_cdr(payload[:end], kind)
        except SerdeError:
            continue
    return store.deserialize_cdr(payload, kind)


def connect(endpoint: str, file: Path | None = None) -> zenoh.Session:
    """Open a session with the lab's bridge; exit with the reason where that fails.

    file: what the lab's instructor has handed over (clients/NAME.json5): where the lab is, and
    the certificate or password. An `endpoint` then says where the lab is instead.
    """
    # zenoh's exception does not say why; its log does.
    zenoh.init_log_from_env_or("off,zenoh::net::runtime::orchestrator=warn")
    try:
        config = zenoh.Config() if file is None else zenoh.Config.from_file(str(file))
        config.insert_json5("mode", '"client"')
        config.insert_json5("scouting/multicast/enabled", "false")
        if endpoint or file is None:
            config.insert_json5("connect/endpoints", json.dumps([endpoint or LOOPBACK]))
        if "127.0.0.1" not in config.get_json("connect/endpoints"):
            for path, value in HEALING.items():
                config.insert_json5(path, json.dumps(value))
        return zenoh.open(config)
    except zenoh.ZError as error:
        sys.exit(
            f"no connection to the lab: {str(error).split(' at /')[0]}\n"
            "The lines above say why. 'Connection refused': no lab is there. 'invalid peer "
            "certificate': not the lab that your file is for. 'fatal alert' or 'close message': "
            "the lab does not take your certificate or password."
        )


def watch(
    session: zenoh.Session, store: Typestore, key: str, kind: str, latched: bool, count: int
) -> int:
    """Print the messages of a topic; of a latched one, first the newest from before now."""
    if kind not in store.types:
        sys.exit(f"the lab has no message type {kind}; docs/protocol.md lists each key's")
    done = threading.Event()
    seen = 0

    def show(sample: zenoh.Sample) -> None:
        nonlocal seen
        if done.is_set():
            return
        print(decode(store, sample.payload.to_bytes(), kind), flush=True)
        seen += 1
        if seen == count:
            done.set()

    if latched:
        history = ext.HistoryConfig(detect_late_publishers=True)
        subscriber = ext.declare_advanced_subscriber(session, key, show, history=history)
    else:
        subscriber = session.declare_subscriber(key, show)
    done.wait()
    subscriber.undeclare()
    return 0


def call(
    session: zenoh.Session, store: Typestore, key: str, kind: str, values: dict[str, Any]
) -> int:
    """Call a service and print its answer; return 0 where it succeeded."""
    request = None
    # The halves of a service are registered as messages, so that they find their package's own.
    service, kind = kind, kind.replace("/srv/", "/msg/")
    if f"{kind}_Response" not in store.types:
        sys.exit(f"the lab has no service type {service}; docs/protocol.md lists each key's")
    if f"{kind}_Request" in store.types:
        request = store.serialize_cdr(fill(store, f"{kind}_Request", values), f"{kind}_Request")
    for reply in session.get(key, payload=request and bytes(request), timeout=70.0):
        if reply.ok is None:
            print(reply.err.payload.to_string(), file=sys.stderr)
            return 1
        answer = decode(store, reply.ok.payload.to_bytes(), f"{kind}_Response")
        print(answer)
        return 0 if getattr(answer, "success", True) else 1
    print(
        f"nobody answers {key}: the robot is not there, or in a lab with keys your role may not "
        "call that",
        file=sys.stderr,
    )
    return 1


def fill(store: Typestore, kind: str, values: dict[str, Any]) -> Any:
    """Return a message with `values` in it and zeros elsewhere, in an orientation no turn; exit
    where a field is unknown or its value cannot be."""
    definition = dict(store.get_msgdef(kind).fields)
    strangers = set(values) - set(definition)
    if strangers:
        sys.exit(f"{kind} has no field {', '.join(strangers)}; it has {', '.join(definition)}")
    if kind == "geometry_msgs/msg/Quaternion" and not values:
        values = {"w": 1.0}
    parts = {name: part(store, field, values.get(name)) for name, field in definition.items()}
    return store.types[kind](**parts)


def part(store: Typestore, field: Any, value: Any) -> Any:
    """Return `value` as a field holds it; None becomes a number, text, array or message of 0."""
    form, detail = field
    if form is Nodetype.NAME:
        if not isinstance(value or {}, dict):
            sys.exit(f"{value} is no {detail}; give its fields, such as {{...}} in JSON")
        return fill(store, detail, value or {})
    if form is Nodetype.BASE:
        name = detail[0]
        if name == "string":
            return "" if value is None else str(value)
        try:
            return np.zeros(1, name)[0] if value is None else np.dtype(name).type(value)
        except (TypeError, ValueError, OverflowError):
            sys.exit(f"{value!r} is no {name}")
    (inner, inner_detail), length = detail
    if not isinstance(value or [], list):
        sys.exit(f"{value!r} is no list; give it in JSON, such as [1, 2]")
    values = value or [None] * (length if form is Nodetype.ARRAY else 0)
    parts = [part(store, (inner, inner_detail), each) for each in values]
    numbers = inner is Nodetype.BASE and inner_detail[0] != "string"
    return np.array(parts, inner_detail[0]) if numbers else parts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("action", choices=("watch", "call"))
    parser.add_argument("key")
    parser.add_argument("type")
    parser.add_argument("values", nargs="*", help="fields of a request, such as position=1.5")
    parser.add_argument("--connect", default="", help=f"endpoint; {LOOPBACK} if not given")
    parser.add_argument("--config", type=Path, help="file for a lab with keys: NAME.json5")
    parser.add_argument("--prefix", default="", help="of the lab's keys, such as lab_1")
    parser.add_argument("--definitions", type=Path, help="folder with msg/ and srv/, not schema")
    parser.add_argument("--latched", action="store_true", help="ask for the newest state first")
    parser.add_argument("--count", type=int, default=0, help="messages to watch; 0: no end")
    arguments = parser.parse_intermixed_args()
    prefix = f"{arguments.prefix}/" if arguments.prefix else ""
    key = f"{prefix}{arguments.key}"
    with connect(arguments.connect, arguments.config) as session:
        given = arguments.definitions
        store = typestore(*(folder(given) if given else schema(session, prefix)))
        if arguments.action == "watch":
            kind, latched, count = arguments.type, arguments.latched, arguments.count
            return watch(session, store, key, kind, latched, count)
        values = {}
        for text in arguments.values:
            name, _, value = text.partition("=")
            try:
                values[name] = json.loads(value)
            except ValueError:
                values[name] = value
        return call(session, store, key, arguments.type, values)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(0)
