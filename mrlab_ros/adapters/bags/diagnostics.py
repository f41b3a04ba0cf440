"""What is said of bags: what is wrong with their files, and what in them cannot be read."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# what is wrong with a bag that is read all the same
BAG_NOT_BEGUN = Code(
    "bag_not_begun",
    "{file} ends before its first record: its writer was killed",
    severity=WARNING,
)
BAG_DAMAGED = Code(
    "bag_damaged",
    "{file} is damaged at byte {offset:integer}[ ({problem})]",
    severity=WARNING,
)
BAG_NO_INDEX = Code(
    "bag_no_index",
    "{file} has no index: its writer was killed or lost its disk",
    severity=WARNING,
)
BAG_CUT_SHORT = Code(
    "bag_cut_short",
    "{file} ends within a record at byte {offset:integer}; what is before it is read",
    severity=WARNING,
)
BAG_LIVE = Code(
    "bag_live",
    "it is being recorded; this is what it holds so far",
    severity=INFO,
)
# what a report says of a session
NOTHING_RECORDED = Code("nothing_recorded", "nothing was recorded in it", severity=WARNING)
BAG_WITHOUT_ROBOTS = Code(
    "bag_without_robots",
    "no robot of a lab is in it; it holds {topics:list}[ and {more:integer} more]",
    severity=WARNING,
    meaning="A bag without robots of a lab. Where it holds joint states, importing it makes a "
    "session of it by the joints' names.",
    data=("types",),
)
TRAJECTORY_UNREADABLE = Code(
    "trajectory_unreadable",
    "{attachment} cannot be read, so runs of it are compared with nothing",
    severity=WARNING,
)
MESSAGES_UNREADABLE = Code(
    "messages_unreadable",
    "{messages:count message|messages} of {topic} cannot be read and were left out",
    severity=WARNING,
)
CLOCK_SET_BACK = Code(
    "clock_set_back",
    "at {time:time} the clock was set back by {by:time}; {then:choice "
    "even=the times of this report go on evenly|"
    "piled=what was recorded until it had caught up stands at that instant}",
    severity=WARNING,
)
BAD_MESSAGE = Code(
    "bad_message",
    "a message is no {type} ({problem})",
    "Bring back a copy of the bag.",
)
