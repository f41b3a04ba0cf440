"""What is said of the processes of a lab, of other labs beside it, and of the machine."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import WARNING, Code

# requests that came too late

WAITED_IN_FREEZE = Code(
    "waited_in_freeze",
    "The process {process} did not run for {frozen:integer} s and this request waited "
    "{waited:integer} s of that, so it was not carried out.",
    "Send it again.",
    meaning="A request that waited while a process did not run: its caller may have given up.",
)
MAY_BE_OLD = Code(
    "may_be_old",
    "The process {process} did not run for {frozen:integer} s and this may have been sent before, "
    "so it was not carried out.",
    "Send it again.",
    meaning="What does not say when it was sent is refused for a moment after a long freeze.",
)

# other labs on the same ROS domain

OTHER_LAB = Code(
    "other_lab",
    "Another lab, {other_lab}, is on this ROS domain. This one, {lab}, ignores it, but topics and "
    "services of one name are shared.",
    "Start one of them again with another ROS_DOMAIN_ID.",
    severity=WARNING,
    meaning="Two labs use one ROS domain.",
)
LAB_WITHOUT_ID = Code(
    "lab_without_id",
    "A lab node without an id is on this ROS domain; this lab, {lab}, ignores the robots that it "
    "lists.",
    "Stop that node, or start it with another ROS_DOMAIN_ID.",
    severity=WARNING,
    meaning="A lab node that was started by hand is beside a lab.",
)
SHARED_SERVICE = Code(
    "shared_service",
    "{service} was not called, as another lab on this ROS domain has it too: {labs:list}.",
    "Start one of the labs again with another ROS_DOMAIN_ID; pause and stop still reach both.",
    meaning="A call would move the robots of two labs.",
)

# signs of life

DIED = Code(
    "died",
    "it died[ ({last_exit})] and was restarted {ago:integer} s ago; nothing was lost",
    severity=WARNING,
    meaning="A process of the lab ended, was started again, and has all that it had.",
    data=("lost",),
)
DIED_AND_LOST = Code(
    "died_and_lost",
    "it died[ ({last_exit})] and was restarted {ago:integer} s ago; lost: {lost:problem}",
    severity=WARNING,
    meaning="A process of the lab ended and was started again; something was not brought back.",
)
DIED_AND_LOOKS = Code(
    "died_and_looks",
    "it died[ ({last_exit})] and was restarted {ago:integer} s ago; what was lost is being "
    "determined",
    severity=WARNING,
    meaning="A process of the lab ended and was started again a moment ago.",
    data=("lost",),
)
DID_NOT_RUN = Code(
    "did_not_run",
    "it did not run for about {frozen:integer} s, until {ago:integer} s ago",
    severity=WARNING,
    meaning="A process of the lab was stopped, swapped out or suspended for a while.",
)
PROCESS_SILENT = Code(
    "process_silent",
    "no sign of life for {silent:integer} s: it died or hangs",
    meaning="A process of the lab has given no sign of life for some seconds.",
)
AND_ALSO = Code(
    "and_also",
    "{first:problem}; {then:problem}",
    severity=WARNING,
    meaning="Two things that are said of one process.",
)
