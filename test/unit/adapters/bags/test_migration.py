"""Messages of earlier definitions become messages of today's."""

import numpy as np
from refusals import refused
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.adapters.bags.diagnostics import FIELD_CHANGED
from mrlab_ros.adapters.bags.migration import migration
from mrlab_ros.core.base.errors import BadInput

KIND = "lab_msgs/msg/State"
INNER = "=" * 80 + "\nMSG: lab_msgs/Clock\n"
OLD = f"string label  # a comment\nClock clock\nClock[] more\nint32 gone\n{INNER}float64 rate\n"
NEW = (
    "string label\nuint32 version\nClock clock\nClock[] more\nfloat64[3] place\nstring[] names\n"
    f"float64[] values\nbool known\n{INNER}float64 rate\nfloat64 position\n"
)


def store(text):
    found = get_typestore(Stores.EMPTY)
    found.register(get_types_from_msg(text, KIND))
    return found


def test_fields_of_the_same_name_stay_and_new_ones_have_defaults():
    old, new = store(OLD), store(NEW)
    clock = old.types["lab_msgs/msg/Clock"]
    message = old.types[KIND]("PLAYING", clock(2.0), [clock(3.0), clock(4.0)], 7)
    convert = migration(KIND, OLD, NEW)
    assert convert is not None
    moved = new.deserialize_cdr(convert(bytes(old.serialize_cdr(message, KIND))), KIND)
    assert (moved.label, moved.version, moved.known) == ("PLAYING", 0, False)
    assert (moved.clock.rate, moved.clock.position) == (2.0, 0.0)
    assert [each.rate for each in moved.more] == [3.0, 4.0]
    np.testing.assert_array_equal(moved.place, [0.0, 0.0, 0.0])
    assert (moved.names, len(moved.values)) == ([], 0)


def test_what_is_the_same_but_for_its_comments_passes_as_it_is():
    assert migration(KIND, OLD, OLD.replace("  # a comment", "# said otherwise")) is None


def test_a_field_of_another_kind_is_refused():
    with refused(FIELD_CHANGED, BadInput, field="label", type="lab_msgs/msg/State"):
        migration(KIND, OLD, OLD.replace("string label", "int32 label"))
