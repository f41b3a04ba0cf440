"""Why a check in the lab is refused or fails."""

from mrlab_ros.core.base.diagnostic import Code

TOO_MANY_CHECKS = Code(
    "too_many_checks",
    "{count:count motion|motions} wait to be checked already; try again in {seconds:time}.",
)
CHECK_FAILED = Code(
    "check_failed", "The check failed; the gateway's log, on the lab's machine, says why."
)
CHECK_TOO_SLOW = Code(
    "check_too_slow",
    "The check took longer than {limit:time}, because this machine is busy or the motion is long.",
    "Pause what plays and check again.",
)
CHECK_ENDED_EARLY = Code(
    "check_ended_early",
    "The check ended early (status {status:integer}), as when it needs too much memory or time.",
    "Check a shorter motion, or check it on your own machine.",
)
ROBOTS_NOT_KNOWN = Code(
    "robots_not_known",
    "The lab does not say which robots it has; wait until it runs, then try again.",
)
