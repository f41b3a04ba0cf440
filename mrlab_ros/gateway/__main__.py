"""`python -m mrlab_ros.gateway`: serves the application with uvicorn until SIGINT or SIGTERM."""

from __future__ import annotations

import argparse
import signal
import sys
from dataclasses import fields
from pathlib import Path

from mrlab_ros.core.errors import LabError
from mrlab_ros.gateway.settings import PORT, Settings, parsed_address

# EX_CONFIG of sysexits.h: a restart would end the same way.
WRONG_CONFIGURATION = 78
# What may still be sent after a wanted stop, s; the lab ends its processes after 1.5 s.
LAST_WORDS_S = 1
# Of a WebSocket: its own frames are smaller.
LARGEST_FRAME = 4 * 1024 * 1024


def main() -> None:
    """Serve; a wrong configuration is one sentence and exit code 78."""
    # A supervisor starts its processes with SIGINT blocked, see processes/supervisor.py.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    try:
        serve(settings_of(sys.argv[1:]))
    except LabError as error:
        print(f"[ERROR] {error}", file=sys.stderr)
        sys.exit(WRONG_CONFIGURATION)


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
    """Serve until SIGINT or SIGTERM."""
    import uvicorn

    from mrlab_ros.gateway.app import create_app
    from mrlab_ros.gateway.ports import real_ports

    uvicorn.Server(
        uvicorn.Config(
            create_app(settings, real_ports(settings)),
            host=settings.host,
            port=settings.port,
            ws="websockets-sansio",
            # 316 instead of 64 KiB a connection, and a seventh of the processor time.
            ws_per_message_deflate=False,
            ws_max_size=LARGEST_FRAME,
            server_header=False,
            proxy_headers=False,
            access_log=False,
            log_level="warning",
            timeout_graceful_shutdown=LAST_WORDS_S,
        )
    ).run()


if __name__ == "__main__":
    main()
