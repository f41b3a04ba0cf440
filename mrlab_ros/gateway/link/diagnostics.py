"""Diagnostics of the WebSocket /link: refusals of frames, calls and pages."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.gateway.diagnostics import ROLE

# frames
FRAME_LENGTH = Code(
    "frame_length",
    "A frame of kind {frame:integer} has {size:count byte|bytes}; expected {expected:integer}.",
)
FRAME_SHORT = Code(
    "frame_short",
    "A frame of kind {frame:integer} has {size:count byte|bytes}; expected {least:integer} or "
    "more.",
)
FRAME_KIND = Code(
    "frame_kind", "A frame begins with {frame:integer}; expected 1 to 4.", "See docs/link.md."
)
KEY_TOO_LONG = Code(
    "key_too_long",
    "A key of {length:count byte|bytes} does not fit a frame of {size:count byte|bytes}.",
)
KEY_NOT_TEXT = Code("key_not_text", "A key is no UTF-8: {why:problem}.")
NO_HELLO = Code(
    "no_hello",
    "The first frame is no hello, or did not come within {wait:time}.",
    "See docs/link.md.",
)
NO_JSON = Code("text_no_json", "A text frame is no JSON object[: {why:problem}].")
BAD_OP = Code("bad_op", "'{op}' is no op of {protocol}.", "See docs/link.md.")
BAD_SUBSCRIPTIONS = Code(
    "bad_subscriptions", "The subscriptions of a hello are no {{number: key expression}}."
)
BAD_NUMBER = Code("bad_frame_number", "{field} is {found}; expected a number from 0 to 2^32 - 1.")

# pages
OTHER_PROTOCOL = Code(
    "other_protocol",
    "This gateway speaks {ours}[, and the page {theirs}].",
    "Reload the page.",
)
PAGES_FULL = Code(
    "pages_full",
    "{own:count page|pages} of {person} and {all:integer} of all people are connected.",
    "Close some, then reload this one.",
)
SENDS_TOO_MUCH = Code("sends_too_much", "This page sends too much.", "Reload it.")
PAGE_SILENT = Code("page_silent", "Nothing came from this page for {wait:time}.")
NEWER_SOCKET = Code("newer_socket", "This page has a newer connection.")
SIGN_IN_ENDED = Code(
    "sign_in_ended", "Your sign-in has ended, or your role has changed.", "Sign in."
)
TEXTS_WAIT = Code(
    "texts_wait",
    "{size:bytes} of text wait for this page, which does not read them.",
    "Reconnect.",
)
TOO_MUCH_WAITS = Code(
    "too_much_waits",
    "{count:count message|messages} with {size:bytes} wait for this page, which does not "
    "acknowledge them.",
    "Reconnect, and fetch what was missed.",
)

# calls, subscriptions, messages of a page
MAY_NOT_CALL = Code(
    "may_not_call", f"As {{role:choice {ROLE}}} you may not call {{key}}.", "Ask your instructor."
)
MAY_NOT_PUBLISH = Code(
    "may_not_publish",
    f"As {{role:choice {ROLE}}} you may not publish {{key}}.",
    "Ask your instructor.",
)
NO_TOPIC_OF_PAGES = Code(
    "no_topic_of_pages",
    "{key} is no topic that the lab gives to pages.",
    "docs/protocol.md lists them, with * for one part of a key.",
)
SUBSCRIPTIONS_FULL = Code(
    "subscriptions_full",
    "This page has {count:count subscription|subscriptions}.",
    "End some first.",
)
CALLS_FULL = Code("calls_full", "Too many calls at once.", "Wait for their answers.")
BAD_DISPLAY_ID = Code(
    "bad_display_id",
    "The display has the id '{id}'.",
    "Expected 1 to {most:integer} characters that can be printed.",
)
DISPLAY_TAKEN = Code(
    "display_taken",
    "The display '{id}' belongs to another page.",
    "Choose an id of your own.",
)
DISPLAY_TOO_FAR = Code(
    "display_too_far",
    "The display '{id}' is at {at:length}; expected finite numbers of at most {most:length}.",
)
