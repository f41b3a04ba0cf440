"""LTI over HTTP: launches, the choice of a task, hand-ins, the course's people and its gradebook.

The two addresses to which the platform lets a browser post are no pages of ours: what proves such
a post is the state in the browser's cookie and the platform's signature, see `launch`.
"""

from __future__ import annotations

import secrets
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any
from urllib.parse import parse_qsl, urlsplit

import orjson
from anyio import to_thread
from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import RedirectResponse
from pydantic import BaseModel

from mrlab_ros.classroom.desk import Desk
from mrlab_ros.classroom.diagnostics import NOT_RELEASED
from mrlab_ros.classroom.lti.course import Connected, Course, Member
from mrlab_ros.classroom.lti.diagnostics import (
    LTI_NOT_UNDERSTOOD,
    MARKS_OF_ANOTHER_FORM,
    MARKS_SENT,
    NO_LTI,
)
from mrlab_ros.classroom.lti.hand_ins import HandIns
from mrlab_ros.classroom.lti.launch import CLAIM, LINKING, Launch, Launches
from mrlab_ros.classroom.lti.platform import own_key, read_platform
from mrlab_ros.classroom.marks import gradebook
from mrlab_ros.classroom.marks.exports import COURSE_FORM
from mrlab_ros.classroom.marks.result import TO_REPEAT
from mrlab_ros.classroom.routes import TheDesk, desk_of
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.base.foreign_text import for_html
from mrlab_ros.gateway.checks.desk import CheckFinding
from mrlab_ros.gateway.errors import NotFound, TooLarge
from mrlab_ros.gateway.people.accounts import Account, plain_name
from mrlab_ros.gateway.people.oidc import PENDING_LIFETIME_S, NotConfirmed
from mrlab_ros.gateway.people.oidc_routes import back_to_sign_in
from mrlab_ros.gateway.people.people import People, ThePeople, address_of
from mrlab_ros.gateway.people.person import CurrentPerson, Limit, RateLimit
from mrlab_ros.gateway.people.routes import base_url

if TYPE_CHECKING:  # it imports an HTTP client, which a gateway without a platform does not need
    from mrlab_ros.classroom.lti.services import Score, Services

PATH = "/api/lti"
MOST_FORM = 256 << 10  # bytes
KEY_FILE = "lti_key.json"
# A whole lecture hall opens the lab from one address.
LAUNCHES = Limit("launches", 400, 0.2)
HAND_INS = Limit("hand_ins", 10, 20.0)
router = APIRouter(tags=["course"])


@dataclass
class Lti:
    """What a gateway has for one platform. launched, handed: limits."""

    launches: Launches
    services: Services
    course: Course
    hand_ins: HandIns
    launched: RateLimit
    handed: RateLimit


def lti_of(request: Request) -> Lti:
    """Return what this gateway has for its platform; raises NotFound where it has none."""
    app, settings = request.app, request.app.state.settings
    if settings.lti is None:
        raise NotFound(NO_LTI())
    if (found := getattr(app.state, "lti", None)) is not None:
        assert isinstance(found, Lti)
        return found
    from mrlab_ros.classroom.lti.services import Services

    people: People = app.state.people
    platform = read_platform(settings.lti)
    desk: Desk = desk_of(request)
    course = Course(desk.folder)
    made = Lti(
        Launches(platform, people.database),
        Services(platform, own_key(people.database.path.with_name(KEY_FILE))),
        course,
        HandIns(desk, course),
        RateLimit(LAUNCHES),
        RateLimit(HAND_INS),
    )
    app.state.lti = made
    return made


TheLti = Annotated[Lti, Depends(lti_of)]


# launches


@router.api_route(f"{PATH}/login", methods=["GET", "POST"], include_in_schema=False)
async def login(request: Request, people: ThePeople) -> Response:
    """Send somebody who opens the lab in the course to the platform, which says who it is."""
    try:
        lti = lti_of(request)
        lti.launched.check(address_of(request), people.steady())
        asked = dict(request.query_params) | await _form(request)
        redirect = f"{base_url(request, people)}{PATH}/launch"
        url, state = lti.launches.begin(asked, redirect, people.clock())
    except LabError as error:
        return back_to_sign_in(error)
    response = RedirectResponse(url, 303)
    # None: the platform's page posts here. It signs nobody in; it proves that this browser began.
    response.set_cookie(
        state_cookie(people), state, max_age=int(PENDING_LIFETIME_S), path=PATH,
        secure=people.secure, httponly=True, samesite="none" if people.secure else "lax",
    )  # fmt: skip
    if people.secure:
        # The choice of a task is in a frame of the platform, where browsers keep no other cookie.
        name, value = response.raw_headers.pop()
        response.raw_headers.append((name, value + b"; Partitioned"))
    return response


@router.post(f"{PATH}/launch", include_in_schema=False)
async def launch(request: Request, people: ThePeople) -> Response:
    """Sign in whom the platform names, or offer its teacher the task for the course."""
    try:
        lti = lti_of(request)
        cookie = request.cookies.get(state_cookie(people), "")
        found = await lti.launches.finish(await _form(request), cookie, people.clock())
        if found.links:
            return await to_thread.run_sync(_linking, request, people, lti, found)
        account = await to_thread.run_sync(_entered, people, lti, found)
    except LabError as error:
        return back_to_sign_in(error)
    response = RedirectResponse("/class", 303)
    response.delete_cookie(state_cookie(people), path=PATH)
    await to_thread.run_sync(people.sign_in, response, account.name, account.role)
    return response


@router.get(f"{PATH}/keys", include_in_schema=False)
async def keys(lti: TheLti) -> Response:
    """Return the public key by which the platform knows what this lab says."""
    known = {"keys": [lti.services.key.as_dict(private=False)]}
    return Response(orjson.dumps(known), media_type="application/json")


def state_cookie(people: People) -> str:
    """Return the name of the cookie that binds a launch to its browser."""
    return f"mrlab-lti-{people.database.lab_id}"


async def _form(request: Request) -> dict[str, str]:
    """Return the fields of a form that was posted; raises TooLarge, NotConfirmed."""
    body = b""
    async for chunk in request.stream():
        body += chunk
        if len(body) > MOST_FORM:
            raise TooLarge(LTI_NOT_UNDERSTOOD(why=f"> {MOST_FORM} bytes"))
    try:
        return dict(parse_qsl(body.decode("ascii"), max_num_fields=50))
    except ValueError as error:
        raise NotConfirmed(LTI_NOT_UNDERSTOOD(why=str(error))) from None


def _entered(people: People, lti: Lti, found: Launch) -> Account:
    """Return the person of a launch with the role that the course gives, and know the course.

    Who teaches there is a teacher here as long as the platform says so.
    """
    platform, accounts = lti.launches.platform, people.accounts
    role = platform.teacher if found.teacher else platform.student
    subject = f"lti {platform.issuer} {platform.client_id} {found.subject}"
    account = accounts.of_provider(subject, plain_name(found.name), role)
    raised = found.teacher and not account.role.may(role)
    ended = not found.teacher and account.role is platform.teacher
    if raised or (ended and role is not platform.teacher):
        with suppress(Misuse):  # the only instructor stays one
            accounts.set_role(account.name, role)
            account = accounts.get(account.name)
    if found.teacher:
        here = Connected(
            found.course, found.course_title, found.task, found.task_title, found.members,
            dict(found.scores),
        )  # fmt: skip
        lti.course.connect(here)
    elif lti.course.connected is None or lti.course.connected.task == found.task:
        lti.course.enter(account.id, Member(found.subject, found.name, found.email))
    return account


# The choice of a task (deep linking): without a script, and in the platform's frame.
WORDS = {
    "en": ("Add this task to the course", "Task", "Points", "Add it"),
    "de": ("Diese Aufgabe in den Kurs aufnehmen", "Aufgabe", "Punkte", "Aufnehmen"),
}
LINKING_PAGE = """<!doctype html>
<html lang="{language}">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>MR-Lab</title>
<link rel="stylesheet" href="/ca.css">
<main>
<h1>{head}</h1>
<p>{task}: <strong>{title}</strong>{points}</p>
<form method="post" action="{action}">
<input type="hidden" name="JWT" value="{token}">
<button class="button" type="submit">{press}</button>
</form>
</main>
</html>
"""


def _linking(request: Request, people: People, lti: Lti, found: Launch) -> Response:
    """Return the page on which a teacher adds the task of this class to the course."""
    from mrlab_ros.classroom.lti.services import signed

    platform = lti.launches.platform
    action = str(found.linking.get("deep_link_return_url", ""))
    if not found.teacher or not platform.owns(action):
        raise NotConfirmed(LTI_NOT_UNDERSTOOD(why="deep_link_return_url"))
    rubric = lti.hand_ins.rubric()
    title = (rubric.name if rubric else "") or "MR-Lab"
    item: dict[str, Any] = {
        "type": "ltiResourceLink", "title": title, "url": f"{base_url(request, people)}/class",
        "window": {"targetName": "_blank"},
    }  # fmt: skip
    if rubric is not None:
        item["lineItem"] = {"label": title, "scoreMaximum": rubric.points}
    now = round(people.clock())
    claims: dict[str, Any] = {
        "iss": platform.client_id, "aud": platform.issuer, "iat": now, "exp": now + 600,
        "nonce": secrets.token_urlsafe(16),
        f"{CLAIM}deployment_id": found.deployment,
        f"{CLAIM}message_type": "LtiDeepLinkingResponse",
        f"{CLAIM}version": "1.3.0",
        "https://purl.imsglobal.org/spec/lti-dl/claim/content_items": [item],
    }  # fmt: skip
    if "data" in found.linking:
        claims[f"{LINKING.rpartition('/')[0]}/data"] = found.linking["data"]
    language = "de" if found.locale.lower().startswith("de") else "en"
    head, task, points, press = WORDS[language]
    worth = f", {points}: {gradebook.number(rubric.points)}" if rubric else ""
    text = LINKING_PAGE.format(
        language=language, head=head, task=task, title=for_html(title), points=worth,
        action=for_html(action), token=for_html(signed(lti.services.key, claims)), press=press,
    )  # fmt: skip
    framed, posted = (_origin(each) for each in (platform.sign_in, action))
    policy = (
        f"default-src 'none'; style-src 'self'; form-action {posted}; base-uri 'none'; "
        f"frame-ancestors {framed}"
    )
    return Response(
        text,
        media_type="text/html; charset=utf-8",
        headers={"Content-Security-Policy": policy},
    )


def _origin(address: str) -> str:
    parts = urlsplit(address)
    return f"{parts.scheme}://{parts.netloc}"


# hand-ins of students


class CheckedTest(BaseModel):
    """What was found for a test that is not hidden. points: of `of`."""

    name: str
    passed: bool
    found: CheckFinding
    hint: str
    points: float
    of: float


class InstantCheck(BaseModel):
    """What a student is told. said: the whole in a sentence. hints: of hidden tests."""

    said: CheckFinding
    tests: list[CheckedTest]
    hints: list[str]


class ReleasedMark(InstantCheck):
    """The mark that a student got. comment: of the teacher."""

    points: float
    of: float
    comment: str


class HandedInFile(BaseModel):
    """The newest file of a student. at: s since 1970; size: bytes."""

    file: str
    at: float
    size: int


class HandInState(BaseModel):
    """A student's own hand-in. member: came from the course. closed: by whom, empty: open. check:
    null while it goes on."""

    course: str
    task: str
    robot: str
    member: bool
    closed: str
    handed_in: HandedInFile | None
    check: InstantCheck | None
    mark: ReleasedMark | None


@router.get("/api/hand_in")
async def hand_in_state(lti: TheLti, person: CurrentPerson) -> HandInState:
    """Return what the person handed in, what its check found, and the mark once it is released."""
    return HandInState.model_validate(await lti.hand_ins.state(person.id))


@router.put("/api/hand_in/{name}", status_code=202)
async def hand_in(
    lti: TheLti, people: ThePeople, person: CurrentPerson, name: str, request: Request
) -> None:
    """Take a file in place of the one before, and begin to check it."""
    lti.handed.check(person.id, people.steady())
    await lti.hand_ins.take(person.id, name, request.stream(), people.clock())


# the course at the teacher's desk


class CourseState(BaseModel):
    """The course of the class. connected: a teacher has opened the lab from it. silent: names of
    those who handed in nothing. members, scores: the platform offers them."""

    connected: bool
    course: str
    task: str
    count: int
    handed_in: int
    silent: list[str]
    members: bool
    scores: bool


class Sent(BaseModel):
    """What became of the marks that were sent."""

    said: CheckFinding
    problems: list[CheckFinding]


@router.get("/api/class/course")
async def course_state(lti: TheLti) -> CourseState:
    """Return the course, and who of it has handed in."""
    return await to_thread.run_sync(_course_state, lti.course)


def _course_state(course: Course) -> CourseState:
    members = course.members()
    silent = [m.name for m, person in members if not person or course.handed_in(person) is None]
    found = course.connected
    return CourseState(
        connected=found is not None,
        course=found.title or found.course if found else "",
        task=found.task_title if found else "",
        count=len(members),
        handed_in=len(members) - len(silent),
        silent=silent,
        members=bool(found and found.members),
        scores=bool(found and found.scores),
    )


@router.delete("/api/class/course", status_code=204)
async def disconnect(lti: TheLti) -> None:
    """Let the next task that a teacher opens in the course be the one of this class."""
    await to_thread.run_sync(lti.course.disconnect)


@router.post("/api/class/course/members", status_code=204)
async def members(lti: TheLti) -> None:
    """Take the list of the course's students from the platform."""
    found = await lti.services.members(lti.course.found().members)
    await to_thread.run_sync(lti.course.enrol, found)


@router.post("/api/class/course/export", status_code=204)
async def pack(lti: TheLti, desk: TheDesk) -> None:
    """Let what was handed in be the export that the next run marks."""
    await to_thread.run_sync(lti.course.pack, desk.export)


@router.post("/api/class/course/marks")
async def send_marks(lti: TheLti, desk: TheDesk) -> Sent:
    """Send the marks that were released to the course's gradebook."""
    found = lti.course.found()
    label, marks = await to_thread.run_sync(_released, desk)
    sent, problems, column = await lti.services.send(found.scores, label, found.task, marks)
    if found.scores.get("lineitem") != column:
        scores = {**found.scores, "lineitem": column}
        known = Connected(**{**vars(found), "scores": scores})
        await to_thread.run_sync(lti.course.connect, known)
    said = {"said": plain(MARKS_SENT(count=sent)), "problems": plain(problems)}
    return Sent.model_validate(said)


def _released(desk: Desk) -> tuple[str, list[Score]]:
    """Return the name of the task and all marks that were released. Raises BadInput."""
    from mrlab_ros.classroom.lti.services import Score

    if not desk.journal.state().released:
        raise BadInput(NOT_RELEASED())
    document = desk.graded.document()
    if document["form"] != COURSE_FORM:
        raise BadInput(MARKS_OF_ANOTHER_FORM())
    return document["title"], [
        Score(s["identifier"], s["name"], s["points"], s["of"], gradebook.words_of(s))
        for s in document["students"]
        if s["outcome"] != TO_REPEAT and s["identifier"]
    ]
