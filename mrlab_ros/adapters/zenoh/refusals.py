"""Diagnostics in zenoh's error replies: English as payload, code and values in the encoding."""

from __future__ import annotations

import json

import zenoh

from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, of_text, plain

# Bytes of an encoding's schema; with a longer one zenoh's pipeline panics.
LONGEST_SCHEMA = 255


def encoding_of(reason: Diagnostic) -> zenoh.Encoding:
    """Return the encoding of a reply that says `reason`; values that are too long are left out."""
    told = json.dumps({"code": reason.code, "values": plain(reason.values)})
    if len(told) > LONGEST_SCHEMA:
        told = json.dumps({"code": reason.code, "values": {}})
    return zenoh.Encoding.TEXT_PLAIN.with_schema(told)


def refusal(error: zenoh.ReplyError) -> Diagnostic:
    """Return what an error reply says."""
    text = error.payload.to_string()
    try:
        told = json.loads(str(error.encoding).partition(";")[2])
        return Diagnostic(told["code"], Severity.ERROR, text, values=dict(told["values"]))
    except (ValueError, KeyError, TypeError):
        return of_text(text)
