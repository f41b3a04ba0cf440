"""`mrlab keys`: who may connect to a lab, and the lab's own certificates."""

from __future__ import annotations

import ipaddress
import json
import socket
import sys
from datetime import timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import LAB_OR_HUB
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.diagnostics import ALLOW_LIST_UNREADABLE

if TYPE_CHECKING:
    from mrlab_ros.adapters.keys.folder import Keys
    from mrlab_ros.adapters.keys.people import Entry
    from mrlab_ros.core.bridge.rules import Rules

app = typer.Typer(
    no_args_is_help=True, help="Who may connect to a lab over the network: certificates, roles."
)

Folder = Annotated[Path, typer.Option("--dir", help="The keys folder.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Hosts = Annotated[
    list[str] | None,
    typer.Option(
        "--host", help="Name or address by which clients reach this machine; repeatable."
    ),
]
Prefix = Annotated[str, typer.Option(help="What the lab's keys begin with.")]
AllowList = Annotated[
    Path | None, typer.Option(help="The bridge's YAML file, if not the shipped one.")
]
# An address of RFC 5737, which no machine has, and a port: what is beyond this network.
ROUTED = ("192.0.2.1", 9)
RUNNING = (
    "A lab that runs under mrlab up takes this over within seconds: its bridge starts again, and "
    "clients come back by themselves. Any other bridge reads its keys only when it is started."
)


@app.command()
def init(
    folder: Folder = Path("keys"),
    host: Hosts = None,
    login: Annotated[
        Login, typer.Option(help="How people prove who they are.")
    ] = Login.CERTIFICATE,
    as_json: AsJson = False,
) -> None:
    """Make a keys folder: an authority of your own and the lab's certificate.

    The certificate names each --host, this machine's address and host name, and localhost.
    Nothing that exists is overwritten.
    """
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys.create(folder, [*(host or []), *this_machine()], login, now())
    expires = keys.server_expires()
    if as_json:
        show(
            {
                "folder": str(keys.folder),
                "login": login.value,
                "hosts": keys.hosts,
                "expires": expires.isoformat(),
            }
        )
        return
    where = "" if folder == Path("keys") else f" --dir {folder}"
    print(
        f"{keys.folder} holds an authority and the lab's certificate, for "
        f"{', '.join(keys.hosts)}, until {expires:%d %B %Y}.\n\n"
        "Next, in this order:\n"
        f"  mrlab keys add anna ben --role operator{where}\n"
        f"      makes keys for people; hand each the file {folder}/clients/NAME.json5\n"
        f"  mrlab up --keys {folder}\n"
        "      starts the lab; clients connect with TLS to port 7447, browsers to its pages\n"
        "  mrlab users add anna --role student\n"
        "      lets a person sign in to the pages: prints a link for once, and its QR code\n\n"
        f"Who has {folder}/ca.key can make a key for anybody: it belongs on this machine alone."
    )
    if not host:
        print(
            f"Other machines must find this one as {keys.hosts[0]}. Name further addresses with: "
            f"mrlab keys renew --host ADDRESS{where}, before you add people."
        )


@app.command()
def add(
    names: Annotated[list[str], typer.Argument(help="Who may connect; one or several names.")],
    role: Annotated[
        Role,
        typer.Option(
            help="display: watch; student: the same, and own uploads in the browser; operator: "
            "play robots too; instructor: everything."
        ),
    ],
    folder: Folder = Path("keys"),
    days: Annotated[int, typer.Option(min=1, max=1825, help="How long, in days.")] = 365,
    as_json: AsJson = False,
) -> None:
    """Let people connect, and write for each the one file that their client needs."""
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    for name in names:
        keys.check_new(name)
    added = [keys.add(name, role, now(), timedelta(days=days)) for name in dict.fromkeys(names)]
    if as_json:
        show([{**e.record(), "file": str(keys.client_file(e.person.name))} for e in added])
        return
    for entry in added:
        name = entry.person.name
        print(f"{name}: {role.value} until {entry.expires:%d %B %Y}; {keys.client_file(name)}")
    print(
        "\nHand each file over on a way that you trust, then delete it here: who has it is that "
        "person.\n" + who_has_it(keys)
    )


@app.command()
def gateway(folder: Folder = Path("keys"), as_json: AsJson = False) -> None:
    """Make the web gateway's key anew, for a gateway on another machine or after its file is lost.

    The one before is taken back. A gateway may do what all people together may do.
    """
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    file = keys.gateway(now())
    if as_json:
        show({"file": str(file)})
        return
    print(
        f"{file} lets a gateway connect; whoever has it may do everything. On another machine:\n"
        "  python -m mrlab_ros.gateway --zenoh-config gateway.json5 --state-dir STATE "
        "--http 0.0.0.0:8080 --certificate CERT --certificate-key KEY\n" + who_has_it(keys)
    )


@app.command("list")
def list_people(folder: Folder = Path("keys"), as_json: AsJson = False) -> None:
    """List who may connect, as what and until when."""
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    expires = keys.server_expires()
    if as_json:
        show(
            {
                "login": keys.login.value,
                "hosts": keys.hosts,
                "expires": expires.isoformat(),
                "fingerprint": keys.fingerprint.replace("\n", ":"),
                "people": [entry.record() for entry in keys.entries],
            }
        )
        return
    from rich.table import Table

    table = Table("name", "role", "until")
    for entry in keys.entries:
        table.add_row(entry.person.name, entry.person.role.value, until(entry))
    console = output.console()
    console.print(table)
    late = expires < now()
    console.print(
        f"login by {keys.login.value}; the lab's certificate, for {', '.join(keys.hosts)}, "
        f"{'expired on' if late else 'holds until'} {expires:%d %B %Y}"
    )
    console.print(f"SHA-256 of the authority, as the page /ca shows it:\n{keys.fingerprint}")


@app.command()
def revoke(
    names: Annotated[list[str], typer.Argument(help="Who may no longer connect.")],
    folder: Folder = Path("keys"),
    as_json: AsJson = False,
) -> None:
    """Take keys back: at once under mrlab up; elsewhere they work until the bridge restarts."""
    from mrlab_ros.adapters.keys.folder import Keys

    keys = Keys(folder)
    for name in names:
        keys.check_known(name)
    revoked = [keys.revoke(name) for name in dict.fromkeys(names)]
    if as_json:
        show([entry.record() for entry in revoked])
        return
    for entry in revoked:
        print(f"{entry.person.name}'s key is taken back")
    print(who_has_it(keys))


@app.command()
def renew(folder: Folder = Path("keys"), host: Hosts = None, as_json: AsJson = False) -> None:
    """Make a new certificate of the lab: for further --host names, or for another two years.

    Everybody's keys stay valid.
    """
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    expires = keys.renew(host or [], now())
    if as_json:
        show({"hosts": keys.hosts, "expires": expires.isoformat()})
        return
    print(f"the lab's certificate is for {', '.join(keys.hosts)}, until {expires:%d %B %Y}")
    print(who_has_it(keys))


@app.command()
def config(
    folder: Folder = Path("keys"),
    prefix: Prefix = "",
    allow_list: AllowList = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON, as without it.")] = True,
) -> None:
    """Print the zenoh settings of the lab as JSON: to read, or for zenoh's own bridge."""
    from mrlab_ros.adapters.keys.folder import Keys, now
    from mrlab_ros.core.bridge.links import EVERYWHERE, nested
    from mrlab_ros.core.bridge.rules import checked_prefix

    rules = rules_of(allow_list)
    keys = Keys(folder)
    keys.check(now())
    settings = keys.settings(rules, checked_prefix(prefix), now())
    show(nested({"listen/endpoints": list(EVERYWHERE)} | settings))


@app.command()
def router(
    folder: Folder = Path("keys"),
    prefix: Prefix = "",
    lab: Annotated[
        list[str] | None,
        typer.Option(
            help="Makes a campus's router: a lab behind it, whose keys begin with the prefix and "
            "this name. Repeatable; name every lab each time."
        ),
    ] = None,
    hub: Annotated[
        Path | None,
        typer.Option(help="The file labs/NAME.json5 of the campus: the router connects there."),
    ] = None,
    hub_role: Annotated[
        Role, typer.Option(help="With --hub: what people at the campus's router may do here.")
    ] = Role.DISPLAY,
    allow_list: AllowList = None,
    as_json: AsJson = False,
) -> None:
    """Write the file of a zenoh router on another machine that lets people in for the lab.

    The names under which people reach that machine must be the lab's: mrlab keys init --host, or
    renew --host. The folder of a campus's router is one of its own, and no lab runs with it.
    """
    from mrlab_ros.adapters import share
    from mrlab_ros.adapters.keys.folder import Keys, now
    from mrlab_ros.adapters.keys.zenoh_settings import Hub
    from mrlab_ros.adapters.zenoh.configuration import limits
    from mrlab_ros.core.bridge.rules import checked_prefix

    keys = Keys(folder)
    shipped = limits(share.directory() / "config" / "zenoh" / "lab.json5")
    if lab and hub:
        raise BadInput(LAB_OR_HUB())
    whole = {
        "--prefix": [prefix],
        "--lab": lab or [],
        "--hub": [str(hub.resolve())] if hub else [],
        "--hub-role": [hub_role.value] if hub else [],
        "--allow-list": [str(allow_list.resolve())] if allow_list else [],
    }
    file = keys.router(
        rules_of(allow_list),
        checked_prefix(prefix),
        shipped,
        now(),
        labs=lab or (),
        hub=None if hub is None else Hub.read(hub, hub_role),
        options=[
            word for name, of in whole.items() for value in of if value for word in (name, value)
        ],
    )
    files = {name: str(keys.lab_file(name)) for name in lab or ()}
    if as_json:
        found = {"file": str(file), "endpoint": f"tls/{keys.hosts[0]}:7447"}
        show({**found, "labs": files} if files else found)
        return
    if files:
        after = "\nHand each lab its file; there:\n" + "".join(
            f"  mrlab keys router --hub {name}.json5 --prefix {prefix and prefix + '/'}{name}"
            f"    # {path}\n"
            for name, path in files.items()
        )
    else:
        after = (
            " Have the lab connect to it:\n"
            f"  mrlab up --keys {folder} --zenoh-connect tls/{keys.hosts[0]}:7447\n"
        )
    print(
        f"{file} is all that the router needs. Take it there on a way that you trust, and run it "
        "with zenohd -c router.json5, or with python -m mrlab_ros.processes.router "
        f"router.json5.{after}"
        "Who is added or taken back later counts at the router once it has a new file and is "
        f"started again. Whoever has this file can pass for {'every lab' if files else 'the lab'}."
    )


def who_has_it(keys: Keys) -> str:
    """Say when a change of the keys counts."""
    if (keys.folder / "router.json5").exists():
        return f"{RUNNING} A router needs a new file: {keys.command('router')}"
    return RUNNING


def rules_of(allow_list: Path | None) -> Rules:
    """Read an allow-list, the shipped one if none is named; raise BadInput where it is none."""
    import yaml

    from mrlab_ros.adapters import share
    from mrlab_ros.adapters.yaml_files import Loader
    from mrlab_ros.core.bridge.rules import parse

    path = allow_list or share.directory() / "config" / "bridge.yaml"
    try:
        return parse(yaml.load(path.read_text(), Loader=Loader))
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(ALLOW_LIST_UNREADABLE(path=str(path), why=str(error))) from error


def this_machine() -> list[str]:
    """Return this machine's address in its network and its host name, as far as it has them.

    The address comes first: many networks, and older Android devices, do not resolve names.
    """
    from mrlab_ros.adapters.keys.certificates import is_host

    name = socket.gethostname()
    return [*own_address(), *([name] if is_host(name) else [])]


def own_address() -> list[str]:
    """Return the address with which this machine reaches others; none where it is on its own."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            # Asks the routing table; a datagram's connect sends nothing.
            probe.connect(ROUTED)
        except OSError:
            return []
        address = str(probe.getsockname()[0])
    return [] if ipaddress.ip_address(address).is_loopback else [address]


def until(entry: Entry) -> str:
    """Say until when a key is good."""
    from mrlab_ros.adapters.keys.folder import now

    text = f"{entry.expires:%d %B %Y}"
    return f"{text} (expired)" if entry.expires < now() else text


def show(document: object) -> None:
    """Print JSON."""
    sys.stdout.write(json.dumps(document, indent=2) + "\n")
