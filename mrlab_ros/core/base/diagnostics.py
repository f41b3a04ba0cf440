"""Diagnostics of fields, of names and of state machines."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, Code

# what a machine has run out of
MACHINE_LACKS = Code(
    "machine_lacks",
    "{lack:choice disk=The disk is full|quota=The quota on the disk is used up"
    "|read_only=The disk is read-only|device=The disk has a fault"
    "|descriptors=The process has no file descriptor left"
    "|files=The machine has no file descriptor left|memory=No memory is left}.",
    "{lack:choice disk=Make room on that disk.|quota=Make room on that disk."
    "|read_only=Name a folder that can be written.|device=Check that disk."
    "|descriptors=Raise the limit (ulimit -n).|files=End other programs."
    "|memory=End other programs.}",
)

# places in a file, and what was expected there: parts of other texts

FIELD = Code("field", "{place:problem}: {key}", severity=INFO, meaning="A field of a mapping.")
FIELD_BELOW = Code(
    "field_below", "{place:problem}, {key}", severity=INFO, meaning="A mapping in a mapping."
)
ENTRY = Code(
    "entry",
    "{place:problem}, {one:choice part=part|hold=hold|member=member|robot=robot|object=object"
    "|surface=surface|system=system} {number:integer}",
    severity=INFO,
    meaning="An entry of a list, counted from 1.",
)
LIMITS_BETWEEN = Code(
    "limits_between",
    "from {low:exact} to {high:exact}",
    severity=INFO,
    meaning="Numbers between two limits, both included.",
)
LIMITS_ABOVE = Code(
    "limits_above",
    "above {low:exact}[ and at most {high:exact}][ and below {below:exact}]",
    severity=INFO,
    meaning="Numbers above a limit, which is not included.",
)
LIMITS_FROM = Code(
    "limits_from",
    "of at least {low:exact}[ and below {below:exact}]",
    severity=INFO,
    meaning="Numbers from a limit on.",
)
LIMITS_TO = Code(
    "limits_to", "of at most {high:exact}", severity=INFO, meaning="Numbers up to a limit."
)
LIMITS_BELOW = Code(
    "limits_below",
    "below {below:exact}",
    severity=INFO,
    meaning="Numbers below a limit, which is not included.",
)
A_NUMBER = Code(
    "a_number",
    "a number[ {limits:problem}][ ({unit})][{sign:choice either=, or its negative}]",
    severity=INFO,
    meaning="A finite number was expected.",
)
AN_INTEGER = Code(
    "an_integer",
    "a whole number[ {limits:problem}][ ({unit})]",
    severity=INFO,
    meaning="A whole number was expected.",
)
TRUE_OR_FALSE = Code("true_or_false", "true or false", severity=INFO, meaning="A flag.")
A_TEXT = Code("a_text", "a text", severity=INFO, meaning="A text was expected.")
A_FILLED_TEXT = Code(
    "a_filled_text",
    "a text that is not empty",
    severity=INFO,
    meaning="A text that is not empty was expected.",
)
A_NAME = Code(
    "a_name",
    "a name of lower-case letters, digits and underscores that begins with a letter, such as "
    "cube_1",
    severity=INFO,
    meaning="The name of a robot, an object or a system was expected.",
)
ONE_OF = Code("one_of", "{choices:either}", severity=INFO, meaning="One of a few words.")
SOME_NUMBERS = Code(
    "some_numbers",
    "a list of numbers[ {limits:problem}][ ({unit})]",
    severity=INFO,
    meaning="A list of at least one number was expected.",
)
COUNTED_NUMBERS = Code(
    "counted_numbers",
    "a list of {count:count number|numbers}[ {limits:problem}][ ({unit})]",
    severity=INFO,
    meaning="A list of so many numbers was expected.",
)
ROWS_OF_NUMBERS = Code(
    "rows_of_numbers",
    "a list of rows of {columns:integer} {numbers:choice any=numbers|whole=whole numbers} each",
    severity=INFO,
    meaning="A matrix was expected, as a list of its rows.",
)
SOME_TEXTS = Code(
    "some_texts",
    "a list of texts[, each {item:problem}]",
    severity=INFO,
    meaning="A list of texts was expected.",
)
TEXT_OR_TEXTS = Code(
    "text_or_texts",
    "a text or a list of texts[, each {item:problem}]",
    severity=INFO,
    meaning="One text or a list of texts was expected.",
)
A_MAPPING = Code(
    "a_mapping",
    "a mapping with the fields {fields:list}",
    severity=INFO,
    meaning="A mapping with these fields was expected.",
)
NAMED_ENTRIES = Code(
    "named_entries",
    "a mapping of names to entries",
    severity=INFO,
    meaning="A mapping of names to entries was expected.",
)
A_LIST = Code("a_list", "a list", severity=INFO, meaning="A list was expected.")
WITHOUT_QUOTES = Code(
    "without_quotes",
    "Write {number} without quotes",
    severity=INFO,
    meaning="A text stands where a number was meant; YAML numbers need a point and a sign.",
)
IN_QUOTES = Code(
    "in_quotes",
    'Write "{text}" in quotes',
    severity=INFO,
    meaning="A number stands where a text was meant.",
)
IN_BRACKETS = Code(
    "in_brackets",
    "Write [[{text}]]",
    severity=INFO,
    meaning="A text stands where a list of texts was meant.",
)
FINITE_NUMBERS = Code(
    "finite_numbers",
    "Every number must be finite",
    severity=INFO,
    meaning="NaN and infinities are never accepted.",
)

# mistakes

BAD_VALUE = Code(
    "bad_value",
    "{what:problem} is {found}; expected {expected:problem}.",
    "[{hint:problem}.]",
    meaning="A field, a parameter or a file holds something else than expected.",
)
EMPTY_VALUE = Code(
    "empty_value",
    "{what:problem} is empty; expected {expected:problem}.",
    meaning="A field or a file is empty.",
)
MISSING_FIELD = Code(
    "missing_field",
    "{what:problem} is missing; expected {expected:problem}.",
    meaning="A field that must be given is not there.",
)
UNKNOWN_FIELD = Code(
    "unknown_field",
    "{place:problem}: '{key}' is unknown[; expected {fields:list}].",
    "[Did you mean '{close}'?]",
    meaning="A mapping holds a field that does not exist.",
)
IN_PLACE = Code(
    "in_place", "{place:problem}: {why:problem}.", meaning="The place of a mistake in a file."
)
MISTAKES = Code(
    "mistakes",
    "{what:problem} has {count:count mistake|mistakes}:{all:problems}",
    meaning="Several mistakes of one file or of one call, all named at once.",
)

# names, states, times and poses

BAD_NAME = Code(
    "bad_name",
    "'{name}' cannot name {what:choice robot=a robot|object=an object|system=a system}; expected "
    "lower-case letters, digits and single underscores, beginning with a letter, such as ur5e_1.",
    meaning="A name that a namespace cannot have.",
)
RESERVED_NAME = Code(
    "reserved_name",
    "'{name}' is a name of the lab's own.",
    "Choose another, such as {name}_1.",
    meaning="A name below which the lab's own topics and services live.",
)
NAME_TAKEN = Code(
    "name_taken",
    "The name '{name}' is taken.",
    "Choose another or leave it empty.",
    meaning="A name that something else in the scene has.",
)
NO_ROBOT_IN_SCENE = Code(
    "no_robot_in_scene",
    "No robot {robot} is in the scene[; there are: {known:list}].",
    "[Did you mean '{close}'?]",
    meaning="A robot was named that the scene does not have.",
)
# Words that a language may have its own for; others are said as they are.
COMMANDS = (
    "load|unload|play|pause|stop|seek|step|clear the halt|set the mode|start a recording|split "
    "the recording|start a replay|pause the replay|resume the replay|seek in the replay|set the "
    "rate|set the loop"
)
ILLEGAL_EVENT = Code(
    "illegal_event",
    f"cannot {{event:choice {COMMANDS}}} in {{state:state}}[; {{reason:problem}}]"
    "[; possible now: {possible:list}]",
    meaning="A command that the present state does not allow; nothing was changed.",
)
BAD_RATE = Code(
    "bad_speed",
    "The rate is {rate:exact}; expected {low:exact} to {high:exact}, or -{low:exact} to "
    "-{high:exact} to play backwards; 1 is the declared speed.",
    meaning="A speed of playback that is out of range.",
)
BAD_POSITION = Code(
    "bad_position",
    "The position is {position:time}; expected 0 to {duration:time}, the length of the timeline.",
    meaning="A position that the timeline does not have.",
)
BAD_VECTOR = Code(
    "bad_vector",
    "The {what:choice position=position|velocity=velocity|angular_velocity=angular velocity} is "
    "{found:list}; expected three finite numbers within ±{limit:exact}.",
    meaning="A vector that is too long, not finite, or has no three numbers.",
)
POSE_NOT_FINITE = Code(
    "pose_not_finite",
    "The pose {found:list} is not finite.",
    meaning="A pose with a number that is none.",
)
BAD_QUATERNION = Code(
    "bad_quaternion",
    "The orientation {found:list} has length {length:number}; expected a unit quaternion "
    "(x, y, z, w), such as 0, 0, 0, 1.",
    meaning="An orientation that is no unit quaternion.",
)

# messages

TYPE_NOT_INSTALLED = Code(
    "type_not_installed",
    "The message type '{type}' is not installed here.",
    "Install its package and start the lab again.",
    meaning="A topic or a service has a type that this machine does not know.",
)
TYPE_WITHOUT_TEXT = Code(
    "type_without_text",
    "The text of {type} is not installed.",
    "Install the package {package}, or leave out the topics of that type.",
    meaning="The definition of a message is needed, to write a bag for instance.",
)
BAD_REQUEST_FIELD = Code(
    "bad_request_field",
    "{field} is {found}; expected {expected:choice number=a number|integer=a whole number|boolean="
    "True or False|text=a text}.",
    meaning="A field of a request has a value of another type.",
)
JOINT_STATE_CUT = Code(
    "joint_state_cut",
    "{size:integer} bytes end before the joint state that they begin.",
    meaning="A serialized joint state is cut short.",
)
NO_JOINT_STATE = Code(
    "no_joint_state",
    "{size:integer} bytes are no joint state: {why:problem}.",
    meaning="A serialized joint state cannot be read.",
)
JOINT_STATE_WITHOUT = Code(
    "joint_state_without",
    "A joint state lacks {missing:list}; it has {found:list}.",
    meaning="A joint state does not name all joints of its robot.",
)
JOINT_STATE_UNEVEN = Code(
    "joint_state_uneven",
    "A joint state has {names:integer} names and {values:integer} positions or velocities; "
    "expected as many.",
    meaning="A joint state whose lists differ in length.",
)
