"""Every route has a line in the policy, and roles get what they shall."""

from __future__ import annotations

from fastapi.routing import APIRoute, APIWebSocketRoute
from gateway_side import Gateway, code_of, values_of

from mrlab_ros.core.bridge.access import Verb
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.app import ROUTERS
from mrlab_ros.gateway.people.person import Person
from mrlab_ros.gateway.policy import EVERYBODY, ROUTES, SOCKET, Need, may, read_policy


def lines(lab: Gateway) -> set[tuple[str, str]]:
    found = set()
    for route in (*lab.app.routes, *(route for router in ROUTERS for route in router.routes)):
        if isinstance(route, APIRoute):
            found |= {(method, route.path) for method in route.methods}
        elif isinstance(route, APIWebSocketRoute):
            found.add((SOCKET, route.path))
    return found


def test_every_route_has_a_line(local_lab: Gateway) -> None:
    assert lines(local_lab) - set(ROUTES) == set()
    assert len(lines(local_lab)) > 15


def test_a_route_without_a_line_answers_nobody(local_lab: Gateway) -> None:
    # Before the pages, which answer any path.
    local_lab.app.router.add_api_route("/api/forgotten", lambda: "open")
    local_lab.app.router.routes.insert(0, local_lab.app.router.routes.pop())
    local = local_lab.local()
    assert local.get("/api/forgotten").status_code in (401, 403)


def test_every_key_that_a_route_names_is_in_the_allow_list() -> None:
    policy = read_policy(None)
    for line, need in ROUTES.items():
        if isinstance(need, Need):
            assert policy.needed(need.verb, need.key, own=need.own) is not None, line


def test_what_is_open_to_everybody_is_the_sign_in_and_the_pages() -> None:
    opened = {line for line, need in ROUTES.items() if need is EVERYBODY}
    signing_in = {
        ("GET", "/api/session"), ("POST", "/api/session"), ("DELETE", "/api/session"),
        ("GET", "/api/oidc/start"), ("GET", "/api/oidc/callback"),
        ("GET", "/api/lti/login"), ("POST", "/api/lti/login"), ("POST", "/api/lti/launch"),
        ("GET", "/api/lti/keys"),
        ("GET", "/api/invitations/{token}"), ("POST", "/api/invitations/{token}"),
        ("POST", "/api/pairings"), ("GET", "/api/pairings/{secret}"),
    }  # fmt: skip
    pages = {("GET", "/{path:path}"), ("HEAD", "/{path:path}")}
    about_the_gateway = {("GET", p) for p in ("/ca", "/ca.css", "/ca.pem", "/healthz")}
    assert opened == signing_in | pages | about_the_gateway


def test_a_student_changes_what_is_their_own() -> None:
    policy = read_policy(None)
    student, display = Person("anna", Role.STUDENT), Person("screen", Role.DISPLAY)
    for key in ("converter/convert", "converter/delete"):
        assert may(student, policy, Verb.CALL, key, own=True)
        assert not may(student, policy, Verb.CALL, key)
        assert not may(display, policy, Verb.CALL, key, own=True)
    assert not may(student, policy, Verb.CALL, "ur5e_1/play", own=True)
    assert may(Person("olga", Role.OPERATOR), policy, Verb.CALL, "ur5e_1/play")


def test_a_role_that_is_too_small_is_told_which_one_is_needed(class_lab: Gateway) -> None:
    response = class_lab.browser("anna").get("/api/people")
    assert code_of(response) == (403, "role_too_low")
    told = {"person": "anna", "role": "student", "needed": "instructor"}
    assert values_of(response) == told


def test_people_are_the_instructors_alone_and_what_a_person_has_is_a_students() -> None:
    """By the path, so that a line that is wrong in the table differs from this."""
    for (method, path), need in ROUTES.items():
        if path.startswith(("/api/people", "/api/class")):
            assert need is Role.INSTRUCTOR, (method, path)
        if path.startswith("/api/devices") or path.endswith("/approve"):
            assert need is Role.STUDENT, (method, path)
        if path.startswith("/api/trajectories") and method != "GET":
            assert need == Need(Verb.CALL, "converter/convert", own=True), (method, path)


def test_only_instructors_reach_people_whatever_the_method(class_lab: Gateway) -> None:
    student = class_lab.browser("anna")
    for method, path in ROUTES:
        if path.startswith("/api/people"):
            answer = student.send(method, path.replace("{name}", "anna"), json={})
            assert answer.status_code == 403, (method, path)
