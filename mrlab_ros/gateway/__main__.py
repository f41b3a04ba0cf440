"""`python -m mrlab_ros.gateway`: serves the application with uvicorn until SIGINT or SIGTERM."""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import signal
import socket
import ssl
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.parent_exit import end_with_launcher
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.sandbox.python_process import keep_to_installed_modules
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, LabError, Unavailable
from mrlab_ros.gateway.diagnostics import HTTPS_UNUSABLE, PORT_TAKEN
from mrlab_ros.gateway.settings import PORT, Settings, parsed_address

# EX_CONFIG of sysexits.h: a restart would end the same way.
WRONG_CONFIGURATION = 78
# Time for last messages after a wanted stop, s; the lab ends its processes after 1.5 s.
LAST_WORDS_S = 1
# Connections that may wait to be accepted: a class that opens the pages at once.
BACKLOG = 256
GONE = "socket.send() raised exception."
# Of a WebSocket, bytes: its own frames are smaller.
LARGEST_FRAME = 4 * 1024 * 1024


def main() -> None:
    """Serve; a wrong configuration is one sentence and exit code 78."""
    # A supervisor starts its processes with SIGINT blocked, see processes/child_process.py.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    end_with_launcher()
    keep_to_installed_modules()
    guard()
    os.umask(0o077)
    # As ROS's nodes log, for a lab's common output.
    logging.addLevelName(logging.WARNING, "WARN")
    logging.basicConfig(
        format="[%(levelname)s] [web]: %(message)s", level=logging.INFO, stream=sys.stdout
    )
    # Each request of a client of an OpenID Connect provider would be a line.
    logging.getLogger("httpx").setLevel(logging.WARNING)
    logging.getLogger("uvicorn.error").addFilter(_is_news)
    # A line for every write to a socket whose other side is gone.
    logging.getLogger("asyncio").addFilter(lambda record: record.msg != GONE)
    try:
        serve(settings_of(sys.argv[1:]))
    except LabError as error:
        logging.error("%s", error)
        for fix in error.diagnostic.fixes:
            logging.error("try: %s", fix.command)
        lasting = isinstance(error, BadInput) and not isinstance(error, Unavailable)
        sys.exit(WRONG_CONFIGURATION if lasting else 1)


def _is_news(record: logging.LogRecord) -> bool:
    """Return False for two tracebacks.

    One is of a request that the gateway's own end cut off, the other of a text frame that is no
    UTF-8: uvicorn has closed its socket.
    """
    cut_off = (asyncio.CancelledError, UnicodeDecodeError)
    return not (record.exc_info and isinstance(record.exc_info[1], cut_off))


def settings_of(arguments: list[str]) -> Settings:
    """Return what the command line says; raise BadInput where it is wrong."""
    parser = argparse.ArgumentParser(prog="python -m mrlab_ros.gateway", description=__doc__)
    parser.add_argument("--http", default=f"127.0.0.1:{PORT}", metavar="HOST:PORT")
    paths = {field.name for field in fields(Settings) if "Path" in str(field.type)}
    given = [field for field in fields(Settings) if field.name not in ("host", "port")]
    for field in given:
        name = f"--{field.name.replace('_', '-')}"
        if field.type == "bool":
            parser.add_argument(name, action="store_true")
        else:
            kind = Path if field.name in paths else str
            parser.add_argument(name, type=kind, required=field.name == "state_dir")
    options = vars(parser.parse_args(arguments))
    host, port = parsed_address(options.pop("http"))
    chosen = {name: value for name, value in options.items() if value is not None}
    return Settings(host=host, port=port, **chosen)


def serve(settings: Settings) -> None:
    """Serve until SIGINT or SIGTERM.

    Raises BadInput where the settings cannot be served, Unavailable where the port is taken.
    """
    import uvicorn

    from mrlab_ros.gateway import patience
    from mrlab_ros.gateway.app import create_app
    from mrlab_ros.gateway.ports import real_ports

    settings.check()
    listening = listen(settings)
    https: dict[str, Any] = {}
    if settings.https:
        https = {
            "ssl_certfile": settings.certificate_file,
            "ssl_keyfile": settings.certificate_key_file,
        }
    config = uvicorn.Config(
        create_app(settings, real_ports(settings)),
        http=patience.protocol(),
        ws=patience.ReadingSocket,
        # 316 instead of 64 KiB a connection, and a seventh of the processor time.
        ws_per_message_deflate=False,
        ws_max_size=LARGEST_FRAME,
        server_header=False,
        # Only a proxy of this machine is believed, and only where there shall be one.
        proxy_headers=bool(settings.public_url),
        access_log=False,
        log_config=None,
        log_level="warning",
        timeout_graceful_shutdown=LAST_WORDS_S,
        **https,
    )
    try:
        config.load()
    except (OSError, ssl.SSLError) as error:
        files = str(settings.certificate_file), str(settings.certificate_key_file)
        unusable = HTTPS_UNUSABLE(certificate=files[0], key=files[1], why=str(error))
        raise BadInput(unusable) from error
    host, port = listening.getsockname()[:2]
    scheme = "https" if settings.https else "http"
    address = f"{scheme}://{f'[{host}]' if ':' in host else host}:{port}"
    logging.info("serves the pages on %s", address)
    # uvicorn ends with the signal that stopped it, which a launcher calls a crash.
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, _end)
    server = uvicorn.Server(config)
    stop_once = server.handle_exit
    # A Ctrl-C arrives twice, from the terminal and from a launcher: the second one would cut the
    # end short, which uvicorn prints as a traceback. LAST_WORDS_S bounds it.
    server.handle_exit = lambda *signal: server.should_exit or stop_once(*signal)  # type: ignore
    server.run(sockets=[listening])


def _end(_signal: int, _frame: object) -> None:
    """End the process as a wanted stop; uvicorn has closed everything and raises its signal again.

    A thread of zenoh that comes back to Python while the interpreter ends would abort the process.
    """
    sys.stdout.flush()
    os._exit(0)


def listen(settings: Settings) -> socket.socket:
    """Return a socket that listens; raises Unavailable where another program does."""
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.socket(family)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((settings.host, settings.port))
        listening.listen(BACKLOG)
    except OSError as error:
        listening.close()
        why = os.strerror(error.errno or 0)
        fixes = (Fix(command="mrlab up --http HOST:PORT"),)
        raise Unavailable(
            PORT_TAKEN(host=settings.host, port=settings.port, why=why, fixes=fixes)
        ) from error
    listening.setblocking(False)
    return listening


if __name__ == "__main__":
    main()
