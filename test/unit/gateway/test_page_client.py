"""The pages' client of the HTTP API asks what the gateway offers and reads what it answers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mrlab_ros.gateway.app import create_app
from mrlab_ros.gateway.ports import Ports
from mrlab_ros.gateway.settings import Settings

API = Path(__file__).parents[3] / "web" / "src" / "api"
WORDS = API.parent / "words"
# Interface of web/src/api/types.ts and the gateway's model that it reads.
ANSWERS = {
    "Upload": "Upload",
    "Conversion": "Converted",
    "Diagnostic": "Finding",
    "Fix": "Fix",
    "Candidate": "Candidate",
    "Preview": "Preview",
    "TrajectoryInfo": "Trajectory",
    "Version": "Version",
    "Invitation": "Invited",
    "InvitationLink": "Invitation",
    "Person": "PersonEntry",
    "Device": "Device",
    "Pairing": "PairingShown",
    "PairingState": "PairingState",
    "Session": "Session",
    "Check": "Check",
    "CheckFinding": "CheckFinding",
}


@pytest.fixture(scope="module")
def offered(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the gateway says of itself."""
    settings = Settings(state_dir=tmp_path_factory.mktemp("state"))
    described: dict[str, Any] = create_app(settings, Ports()).openapi()
    return described


def fields(interface: str) -> set[str]:
    """Return the names of an interface's fields, those of interfaces in it left out."""
    texts = (API / "types.ts").read_text() + (WORDS / "diagnostic.ts").read_text()
    text = re.sub(r"/\*\*.*?\*/", "", texts, flags=re.DOTALL)
    match = re.search(rf"interface {interface}\b[^{{]*\{{(.*?)\n\}}", text, re.DOTALL)
    assert match, interface
    return set(re.findall(r"^  readonly (\w+)\??:", match[1], re.MULTILINE))


@pytest.mark.parametrize(("interface", "model"), ANSWERS.items())
def test_what_pages_read_is_answered(offered: dict[str, Any], interface: str, model: str) -> None:
    schemas = offered["components"]["schemas"]
    assert fields(interface) <= set(schemas[model]["properties"])


def test_the_options_of_a_conversion_are_all_known(offered: dict[str, Any]) -> None:
    model = offered["components"]["schemas"]["Conversion"]["properties"]
    assert fields("ConvertOptions") | fields("ConversionRequest") == set(model) - {"id"}


def asked() -> Iterator[tuple[str, str]]:
    """Yield verb and path of each request of the client; a part that varies is {}."""
    text = (API / "http.ts").read_text()
    for verb, path in re.findall(r"'(GET|POST|PATCH|DELETE)',\s*[`'](/api/[^`']*)[`']", text):
        yield verb, re.sub(r"\$\{.*?\)\}", "{}", path.partition("?")[0])
    parts = re.findall(r"'(GET|POST|PATCH|DELETE)', trajectoryUrl\(id(?:, '(\w+)')?\)", text)
    for verb, part in parts:
        yield verb, f"/api/trajectories/{{}}{'/' if part else ''}{part}"


def test_every_route_that_pages_ask_is_there(offered: dict[str, Any]) -> None:
    routes = {
        (verb.upper(), re.sub(r"\{.*?\}", "{}", path))
        for path, verbs in offered["paths"].items()
        for verb in verbs
    }
    wanted = set(asked())
    assert len(wanted) > 12
    assert wanted <= routes
