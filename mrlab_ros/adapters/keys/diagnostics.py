"""Diagnostics of the keys folder: its people, certificates and private files."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

# files
NO_KEY_FILE = Code("no_key_file", "There is no file {path}.", "Put back a copy, or make new keys.")
KEY_FILE_UNREADABLE = Code("key_file_unreadable", "{path} cannot be read: {why:problem}.")
KEY_FILE_OPEN = Code(
    "key_file_open",
    "{path} can be read by others on this machine (mode {mode}).",
    "Take that right away.",
    commands=("chmod 600 {path}",),
)
FOLDER_NOT_EMPTY = Code(
    "keys_folder_not_empty",
    "{folder} exists and is not empty; nothing was changed.",
    "Name another folder, or remove this one: whoever has keys from it then needs new ones.",
)
NO_KEYS = Code("no_keys", "{folder} has no keys.", "Make them first.")
KEYS_DAMAGED = Code(
    "keys_damaged",
    "{path} is damaged: {why:problem}.",
    "Put back a copy, or make new keys.",
)

# certificates
NO_PRIVATE_KEY = Code(
    "no_private_key", "{path} is no private key without password (PEM): {why:problem}."
)
NO_EC_KEY = Code("no_ec_key", "{path} is a {found}; expected an EC key.")
OTHER_KEY = Code(
    "other_key", "{path} is not the key of {certificate}.", "Put back the one made with it."
)
NO_CERTIFICATE = Code("no_certificate", "{path} is no certificate (PEM): {why:problem}.")
CERTIFICATE_EXPIRED = Code("certificate_expired", "The certificate {path} expired on {end} UTC.")
CERTIFICATE_EARLY = Code(
    "certificate_early",
    "The certificate {path} is valid from {begin} UTC, and this machine's clock says {now}.",
    "Set the clock.",
)
OTHER_AUTHORITY = Code(
    "other_authority",
    "The certificate {path} was signed by {signer}, not by this folder's authority {authority}.",
)
NEW_KEYS_NEEDED = Code(
    "new_keys_needed",
    "The keys cannot be used any more: {why:problem}.",
    "Make new keys in another folder, and hand them out again.",
)
RENEWAL_NEEDED = Code(
    "renewal_needed",
    "The lab's certificate cannot be used: {why:problem}.",
    "Make a new one.",
)
ROUTER_KEYS_NEEDED = Code(
    "router_keys_needed",
    "The lab cannot connect to its router with its keys: {why:problem}.",
    "Make the router's file anew.",
)
NO_HOST = Code(
    "no_host",
    "'{host}' is neither a host name nor an address.",
    "Expected one such as lab.example.org or 192.168.1.20, without a port.",
)

# people
BAD_KEY_NAME = Code(
    "bad_key_name",
    "'{name}' is no name for a key.",
    "Expected up to 41 letters, digits, '_', '-' and '.', beginning with a letter or digit, and "
    "not {reserved:either}.",
)
HAS_KEY = Code(
    "has_key",
    "{name} has a key already, as "
    "{role:choice display=display|student=student|operator=operator|instructor=instructor}.",
    "Take that one back first.",
)
HAS_NO_KEY = Code("has_no_key", "{name} has no key in {folder}[; {known:list} have one].")
CAMPUS_WITHOUT_LABS = Code(
    "campus_without_labs",
    "The keys in {folder} are those of a campus's router, for {labs:list}.",
    "Name all of its labs, and its prefix, again: a lab that is not named is locked out.",
    page=False,
)
NO_HUB_FILE = Code(
    "no_hub_file",
    "{path} does not say how to connect to a campus's router: {why:problem}.",
    "Expected the file labs/NAME.json5 that was made for this lab there.",
    page=False,
)
ROUTER_TAKES_CERTIFICATES = Code(
    "router_takes_certificates",
    "The people of {folder} log in by {login}, and a router takes certificates only.",
    "Make a folder whose people log in by certificate.",
)
