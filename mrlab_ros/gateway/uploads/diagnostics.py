"""Diagnostics of files that people send, and of their conversion."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

CAME_AS_FORM = Code(
    "came_as_form",
    "'{file}' came as a form.",
    "Send the file itself as the body of the request.",
    commands=("curl -T {file} URL",),
)
BROKE_OFF = Code("upload_broke_off", "'{file}' broke off and nothing was kept.", "Send it again.")
EMPTY_UPLOAD = Code("empty_upload", "'{file}' is empty.", "Save it again and send it.")
FILE_TOO_LARGE = Code(
    "upload_too_large",
    "The file has more than {most:bytes}, the limit.",
    "Save the trajectory alone, with save('file.mat', 'q', 't').",
)
QUOTA_FULL = Code(
    "quota_full",
    "Your files take {used:bytes} of {most:bytes} and this one does not fit.",
    "Uploads are removed after some days.",
)
NO_ROOM = Code(
    "gateway_disk_full",
    "The gateway has no room for '{file}' ({why:problem}), and nothing was kept.",
    "Ask for room on its disk, then try again.",
)
FILE_NAME_LENGTH = Code(
    "file_name_length",
    "The name of the file has {count:count character|characters}; the limit is {most:integer}.",
    "Give it a shorter one.",
)
NO_FILE_NAME = Code(
    "no_file_name",
    "The file has no name[: '{file}' is none].",
    "Give it one that says what it is, such as traj.mat.",
)
FILE_NAME_SIGNS = Code(
    "file_name_signs",
    "The name of the file, {file}, has characters that cannot be printed.",
    "Give it another one, of letters, digits and signs.",
)
OTHER_ENDING = Code(
    "other_ending",
    "'{file}' is none of the files that are read.",
    "Expected a name that ends with {endings:either}.",
)
NO_UPLOAD = Code("no_upload", "The upload {upload} is not there.", "Send the file again.")
NEWER_IS_SHOWN = Code(
    "newer_is_shown",
    "A newer motion of this program came while '{file}' waited.",
    "The newer one is shown.",
)
NO_MOTION = Code(
    "no_such_motion",
    "That motion is not there any more.",
    "Convert the file again, or open the trajectory that it became.",
)
NOT_YOURS = Code("not_yours", "'{trajectory}' belongs to {owner}; {person} may only look at it.")
LABS_OWN = Code("labs_own", "'{trajectory}' belongs to the lab; {person} may only look at it.")
NOT_AMONG_YOURS = Code(
    "not_among_yours",
    "There is no trajectory '{trajectory}' among yours and the shared ones.",
    "Look it up in the list.",
)
