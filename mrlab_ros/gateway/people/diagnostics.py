"""Diagnostics of people, sign-ins, invitations and paired devices."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import WARNING, Code, Fix
from mrlab_ros.gateway.diagnostics import ROLE

NO_PERSON = Code("no_person", "There is nobody called '{name}'.")
BAD_PERSON_NAME = Code(
    "bad_person_name",
    "'{name}' is no name for a person.",
    "Expected up to 41 letters, digits, '_', '-' and '.', beginning with a letter or digit, and "
    "not {reserved:either}.",
)
PERSON_EXISTS = Code(
    "person_exists",
    "There is somebody called '{name}' already.",
    "Choose another name, or remove that person first.",
)
LAST_INSTRUCTOR = Code(
    "last_instructor",
    "{name} is the only instructor of this lab.",
    "Make somebody else an instructor first.",
)
DEVICE_LETS_IN = Code(
    "device_lets_in",
    "A paired device cannot let another device in.",
    "Confirm the code in a browser in which you signed in with your password.",
)
LINK_USED = Code(
    "link_used",
    "This link was used already, or is too old.",
    "Ask your instructor for a new one.",
)
USERS_UNUSABLE = Code(
    "users_unusable",
    "{path} cannot be used for people and sign-ins: {why:problem}.",
    "Expected a file that this user can write, or none.",
)
USERS_LOCKED = Code(
    "users_locked",
    "{path} cannot be read now: {why:problem}. Sign-ins that end meanwhile keep their pages open.",
    "End the program that has the file open.",
    severity=WARNING,
    meaning="Another program holds a lock on the file of people and sign-ins.",
)
USERS_OTHER_VERSION = Code(
    "users_other_version",
    "{path} was written by another version of this program.",
    "Move it away and add the people again.",
)
PASSWORD_LENGTH = Code(
    "password_length",
    "The password has {count:count character|characters}; expected {least:integer} to "
    "{most:integer}.",
    "Several words are easy to remember.",
)
WRONG_PASSWORD = Code(
    "wrong_password", "This name and password do not belong together.", "Try again."
)
NO_DEVICE = Code("no_device", "There is no such device.", "It may have signed out.")
ONE_LOCAL_USER = Code(
    "one_local_user",
    "This lab has one local user, no sign-in and no paired devices.",
    "For more people start it with keys.",
)
DEVICES_FULL = Code("devices_full", "Too many devices wait to be paired.", "Try again later.")
CODES_WRONG = Code(
    "codes_wrong",
    "{count:count code was|codes were} wrong.",
    "Wait until the device shows a new one.",
)
NO_DEVICE_SHOWS = Code(
    "no_device_shows",
    "No device shows the code {shown}.",
    "A code is good for {minutes:count minute|minutes}; compare it with the device again.",
)
PAIRED_ROLE_TOO_HIGH = Code(
    "paired_role_too_high",
    f"{{person}} is {{role:choice {ROLE}}} and cannot pair a device as {{wanted:choice {ROLE}}}.",
    f"Choose {{role:choice {ROLE}}} or less.",
)
PAIRING_ENDED = Code("pairing_ended", "This pairing has ended.", "Begin another one.")
OWN_PAGES_ONLY = Code("own_pages_only", "Only this gateway's own pages may ask this.")

# OpenID Connect
NO_PROVIDER = Code(
    "no_provider", "This lab has no OpenID Connect provider.", "Sign in with a password."
)
SIGN_INS_FULL = Code(
    "sign_ins_full", "Too many people sign in at once.", "Try again in a few minutes."
)
SIGN_IN_NOT_BEGUN = Code(
    "sign_in_not_begun",
    "This sign-in took too long, or was not begun in this browser.",
    "Begin again.",
)
NOT_CONFIRMED = Code(
    "not_confirmed", "The provider did not confirm who you are: {why:problem}.", "Begin again."
)
NO_NAME_LEFT = Code(
    "no_name_left", "The name '{name}' is taken.", "Ask your instructor for another one."
)
MAIL_NOT_ADMITTED = Code(
    "mail_not_admitted",
    "Somebody with this address may not sign in[: {email}].",
    "It must be verified, and one that this lab admits.",
)
PROVIDER_SILENT = Code(
    "provider_silent",
    "The provider {issuer} does not answer as it should: {why:problem}.",
    "Try again, or sign in with a password.",
)
PROVIDER_INCOMPLETE = Code("provider_incomplete", "{url} does not name {missing:list}.")
PROVIDER_OTHER = Code(
    "provider_other", "{url} is of another provider[: {issuer}], not of the configured one."
)
# How a lab is started for several people.
WITH_KEYS = (Fix(command="mrlab keys init"), Fix(command="mrlab up --keys keys"))
