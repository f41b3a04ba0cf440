"""`mrlab users`: who signs in to the pages of a lab with keys."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import DATA_OF_ANOTHER_LAB, GIVEN_OR_ERASED, NO_USERS_HERE
from mrlab_ros.commands.output import say
from mrlab_ros.commands.up.web import qr_lines
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse, WrongUsage
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.people.diagnostics import ONE_LOCAL_USER, PAIRED_ROLE_TOO_HIGH, WITH_KEYS

if TYPE_CHECKING:
    from mrlab_ros.gateway.people.accounts import Accounts
    from mrlab_ros.gateway.people.sign_ins import Database

DAY_S = 24 * 3600.0
# A store far away takes its time.
SETTLING_S = 70.0
app = typer.Typer(no_args_is_help=True, help="Who signs in to the pages of a lab with keys.")

Folder = Annotated[
    Path | None,
    typer.Option(
        "--dir", help="Keys folder of the lab; not given: that of the running lab, or ./keys."
    ),
]
Url = Annotated[
    str, typer.Option(help="Address of the pages; not given: the running lab's, or port 8080.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
NewRole = Annotated[
    Role,
    typer.Option(
        help="display: watch; student: upload and publish their own; operator: play robots too; "
        "instructor: everything."
    ),
]


@app.command()
def add(
    names: Annotated[list[str], typer.Argument(help="Who shall sign in; one or several names.")],
    role: NewRole,
    folder: Folder = None,
    url: Url = "",
    as_json: AsJson = False,
) -> None:
    """Let people sign in; print for each a link, good once, to choose a password."""
    with opened(folder, url) as users:
        for name in names:
            users.accounts.check_new(name)
        for name in dict.fromkeys(names):
            users.accounts.add(name, role)
        show_links(users, list(dict.fromkeys(names)), as_json)


@app.command()
def invite(
    name: Annotated[str, typer.Argument(help="Who has lost the password or the link.")],
    folder: Folder = None,
    url: Url = "",
    as_json: AsJson = False,
) -> None:
    """Print a new link for somebody; earlier ones are good no longer."""
    with opened(folder, url) as users:
        show_links(users, [name], as_json)


@app.command("list")
def list_users(folder: Folder = None, as_json: AsJson = False) -> None:
    """List who may sign in, and as what."""
    with opened(folder, "") as users:
        found = users.accounts.all()
    if as_json:
        show([{"name": a.name, "role": a.role.value, "signs_in": a.signs_in} for a in found])
        return
    from rich.table import Table

    ways = {"": "has not used the link yet", "password": "password", "oidc": "OpenID Connect"}
    table = Table("name", "role", "signs in by")
    for account in found:
        table.add_row(account.name, account.role.value, ways[account.signs_in])
    output.console().print(table)


@app.command()
def role(
    name: Annotated[str, typer.Argument(help="Whose role.")],
    new: Annotated[Role, typer.Argument(metavar="ROLE", help="The new role.")],
    folder: Folder = None,
    as_json: AsJson = False,
) -> None:
    """Give somebody another role; it counts at once."""
    with opened(folder, "") as users:
        users.accounts.set_role(name, new)
    say(f"{name} is {new.value} now", as_json=as_json, name=name, role=new.value)


@app.command()
def token(
    name: Annotated[
        str, typer.Argument(help="For whom the program acts; not given: this machine's user.")
    ] = "",
    program: Annotated[str, typer.Option(help="Its name in the list of devices.")] = "program",
    role: Annotated[
        Role | None, typer.Option(help="What it may do; not given: what the person may.")
    ] = None,
    days: Annotated[float, typer.Option(min=0.01, max=366, help="How long it is good.")] = 90.0,
    folder: Folder = None,
    as_json: AsJson = False,
) -> None:
    """Print a token, with which a program acts for somebody over HTTP and /link.

    The program sends the header `Authorization: Bearer TOKEN`. The page of devices ends it.
    """
    from mrlab_ros.gateway.people.person import LOCAL
    from mrlab_ros.gateway.people.sign_ins import SignIns, new_token

    with opened(folder, "", local=not name) as users:
        own = users.accounts.get(name).role if name else Role.INSTRUCTOR
        if role is not None and not own.may(role):
            person = name or LOCAL
            raise BadInput(PAIRED_ROLE_TOO_HIGH(person=person, role=own.value, wanted=role.value))
        made = SignIns(users.database).begin(
            name or LOCAL,
            role or own,
            time.time(),
            device=program,
            lifetime=days * DAY_S,
            secret=new_token(),
        )
    if as_json:
        show({"token": made, "url": users.address})
    else:
        print(made)


@app.command()
def remove(
    names: Annotated[list[str], typer.Argument(help="Who may no longer sign in.")],
    give_to: Annotated[
        str, typer.Option(help="Who gets their trajectories; what was not published is erased.")
    ] = "",
    erase: Annotated[
        bool, typer.Option("--erase", help="Erase all that they uploaded and published, for good.")
    ] = False,
    folder: Folder = None,
    as_json: AsJson = False,
) -> None:
    """Remove people; their browsers, headsets and programs are signed out within a second.

    Without --give-to or --erase, which need the running lab, their trajectories stay for
    instructors.
    """
    if erase and give_to:
        raise WrongUsage(GIVEN_OR_ERASED())
    removed = list(dict.fromkeys(names))
    with opened(folder, "") as users:
        leaving = [users.accounts.check_leaves(name) for name in removed]
        if erase or give_to:
            settle(users, [each.id for each in leaving], give_to)
        for name in removed:
            users.accounts.remove(name)
    data = "erased" if erase else "handed_over" if give_to else "kept"
    if as_json:
        print(json.dumps({"removed": removed, "data": data}))
        return
    fate = {
        "erased": "all that was uploaded and published is erased",
        "handed_over": f"the trajectories belong to {give_to}",
        "kept": "the trajectories stay for instructors",
    }
    for name in removed:
        print(f"{name} is removed and signed out everywhere; {fate[data]}")


def settle(users: Users, owners: list[str], heir: str) -> None:
    """Give the data of people, by id, to the person called `heir`; empty: erase it.

    Raises Misuse where the lab of these people does not run: another lab has another store.
    """
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.commands.open import running_web

    to = users.accounts.get(heir).id if heir else ""
    if Path(running_web()["users"]).resolve() != users.database.path.resolve():
        raise Misuse(DATA_OF_ANOTHER_LAB())
    with open_graph() as graph:
        for owner in owners:
            if to:
                given = srv.HandOver.Request(owner=owner, to=to)
                graph.order(srv.HandOver, "/converter/hand_over", given, SETTLING_S)
            else:
                request = srv.Remove.Request(name=owner)
                graph.order(srv.Remove, "/converter/erase", request, SETTLING_S)


@dataclass(frozen=True)
class Users:
    """The people of a lab, and the address of its pages."""

    accounts: Accounts
    address: str
    database: Database


@contextmanager
def opened(folder: Path | None, url: str, *, local: bool = False) -> Iterator[Users]:
    """Open the users of a keys folder, or of the lab that runs here.

    local: the lab may be one whose only user is that of this machine.
    """
    from mrlab_ros.adapters.keys.folder import Keys
    from mrlab_ros.commands.open import running_web
    from mrlab_ros.gateway.people.accounts import Accounts
    from mrlab_ros.gateway.people.sign_ins import FILE, Database

    running = None
    try:
        running = running_web()
    except Misuse:
        if folder is None and Path("keys").is_dir():
            folder = Path("keys")
    if folder is not None:
        keys = Keys(folder)
        file = keys.folder / FILE
        host = keys.hosts[0]
        address = f"https://{f'[{host}]' if ':' in host else host}:8080"
        if running is not None and Path(running["users"]) == file:
            address = running["address"]
    elif running is not None and (local or running["signs_in"]):
        file, address = Path(running["users"]), running["address"]
    elif running is not None:
        raise Misuse(ONE_LOCAL_USER(fixes=WITH_KEYS))
    else:
        raise BadInput(NO_USERS_HERE(fixes=(Fix(command="mrlab keys init"),)))
    database = Database(file)
    try:
        yield Users(Accounts(database), (url or address).rstrip("/"), database)
    finally:
        database.close()


def show_links(users: Users, names: list[str], as_json: bool) -> None:
    """Make a link for each of these people, and print it."""
    links = {
        name: f"{users.address}/invitation/{users.accounts.invite(name, time.time())}"
        for name in names
    }
    if as_json:
        roles = {name: users.accounts.get(name).role.value for name in names}
        show([{"name": n, "role": roles[n], "url": link} for n, link in links.items()])
        return
    for name, link in links.items():
        print(f"\n{name}: {link}")
        if sys.stdout.isatty():
            print("\n".join(qr_lines(link)))
    print(
        "\nEach link is for one person, and good once, for a week: whoever opens it first has it."
    )


def show(document: object) -> None:
    """Print JSON."""
    sys.stdout.write(json.dumps(document, indent=2) + "\n")
