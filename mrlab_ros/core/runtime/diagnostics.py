"""Diagnostics of the processes of a lab, of other labs beside it, and of the machine."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

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
    meaning="Requests without a send time are refused for a moment after a long freeze.",
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

# threads

THREAD_FAILED = Code(
    "thread_failed",
    "The thread {thread} failed: {error:problem}[; {again:integer} times since this was said].",
    meaning="An error that the program did not expect. The thread goes on with its next work.",
)
THREAD_ENDS = Code(
    "thread_ends",
    "The thread {thread} failed {failures:integer} times in a row. Its process ends; the lab "
    "starts it again.",
    meaning="A process ends where one of its threads cannot go on.",
)

UNDECODABLE = Code(
    "undecodable",
    "{count:count message|messages} on {topic} could not be decoded as {type} and had no effect"
    "[; publishers: {publishers:list}].",
    "End the program that publishes them, or have it publish {type}.",
    severity=WARNING,
    meaning="Bytes that are no message of the topic's type: of a foreign program, or of another "
    "version of the lab.",
)

# signs of life

EXITED = Code(
    "exited",
    "exit code {exit_code:integer}",
    severity=INFO,
    meaning="How a process of the lab ended by itself.",
)
DIED = Code(
    "died",
    "it died[ ({last_exit:problem})] and was restarted {ago:integer} s ago; nothing was lost",
    severity=WARNING,
    meaning="A process of the lab ended, was started again, and has all that it had.",
    data=("lost",),
)
DIED_AND_LOST = Code(
    "died_and_lost",
    "it died[ ({last_exit:problem})] and was restarted {ago:integer} s ago; lost: {lost:problem}",
    severity=WARNING,
    meaning="A process of the lab ended and was started again; something was not brought back.",
)
DIED_AND_LOOKS = Code(
    "died_and_looks",
    "it died[ ({last_exit:problem})] and was restarted {ago:integer} s ago; what was lost is "
    "being determined",
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

# the machine, hop by hop

PYTHON_FITS = Code("python_fits", "Python {version}", severity=INFO)
PYTHON_UNFIT = Code(
    "python_unfit",
    "Python {version}; expected {first} to {last}",
    "Install Python 3.11 and set the lab up with it: MRLAB_PYTHON=python3.11 make demo.",
)
WHEELS_THERE = Code("wheels_there", "wheels: all there", severity=INFO)
WHEELS_MISSING = Code(
    "wheels_missing",
    "wheels: {modules:list} missing",
    "Run make demo once; in a shell of its own: . .venv/mrlab.sh",
)
SET_UP_CURRENT = Code("set_up_current", "set-up: as new as the sources", severity=INFO, page=False)
SET_UP_OUTDATED = Code(
    "set_up_outdated",
    "set-up: {steps:list} older than the sources, or missing",
    "Run make setup in {folder}.",
    meaning="The sources have changed since set-up built from them, as after git pull.",
    page=False,
)
MODULE_THERE = Code("module_there", "{module}: there", severity=INFO)
MODULE_MISSING = Code(
    "module_missing",
    "{module} is missing; the lab runs without physics: no contacts, no grasps",
    "Install it.",
    commands=("pip install {module}",),
)
MODULE_WITHOUT_WHEEL = Code(
    "module_without_wheel",
    "{module} has no wheel for this Python; the lab runs without physics: no contacts, no grasps",
    "Use Python 3.10 or 3.11.",
)
MIDDLEWARE_THERE = Code(
    "middleware_there", "middleware: {middlewares:list}", severity=INFO, meaning="Of ROS."
)
MIDDLEWARE_NONE = Code(
    "middleware_none", "middleware: none", "Run make demo: it installs rmw_fastrtps_cpp."
)
MIDDLEWARE_OTHER = Code(
    "middleware_other",
    "RMW_IMPLEMENTATION is {wanted}[; installed: {middlewares:list}]",
    "Unset RMW_IMPLEMENTATION, or install that middleware.",
)
MULTICAST_WORKS = Code("multicast_works", "multicast: nodes find each other by it", severity=INFO)
MULTICAST_BLOCKED = Code(
    "multicast_blocked",
    "multicast: a packet to {group} does not come back[ ({why:problem})]",
    "Set ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST for a lab on one machine, or allow UDP multicast "
    "to {group} in the firewall.",
)
PAGES_BUILT = Code("pages_built", "pages: built", severity=INFO)
PAGES_NOT_BUILT = Code(
    "pages_not_built", "pages: not built", "Run make demo, or scripts/npm run build."
)
PORT_OURS = Code(
    "port_ours", "port {port:integer} ({what}): the running lab has it", severity=INFO
)
PORT_FREE = Code("port_free", "port {port:integer} ({what}): free", severity=INFO)
PORT_IN_USE = Code(
    "port_in_use",
    "port {port:integer} ({what}): another program has it",
    "End that program, or start the lab with another port.",
)
GATEWAY_SILENT = Code(
    "gateway_silent",
    "gateway {url}: {why:problem}",
    "Start the lab; for other machines with keys or a certificate, and with its port open in the "
    "firewall.",
    commands=("mrlab up",),
)
GATEWAY_SAME = Code(
    "gateway_same", "gateway {url}: version {version}, as this machine", severity=INFO
)
GATEWAY_DIFFERS = Code(
    "gateway_differs",
    "gateway {url}: version {version}; this machine has {own}",
    "Bring both to one version, then reload the pages.",
)
CLOCKS_AGREE = Code(
    "clocks_agree", "clocks: {offset:time} between the gateway and this machine", severity=INFO
)
CLOCKS_DIFFER = Code(
    "clocks_differ",
    "clocks: {offset:time} between the gateway and this machine; expected {limit:time} at most",
    "Switch on time synchronisation on both.",
    commands=("timedatectl set-ntp true",),
)
CERTIFICATE_LASTS = Code("certificate_lasts", "certificate {path} expires {day}", severity=INFO)
CERTIFICATE_ENDS = Code(
    "certificate_ends",
    "certificate {path} expires {day}",
    "Make a new one.",
    commands=("mrlab keys renew",),
)
STORE_WRITABLE = Code("store_writable", "store: {folder} can be written", severity=INFO)
STORE_READ_ONLY = Code(
    "store_read_only",
    "store: {folder} cannot be written",
    "Make it writable for this user, or choose another folder for the lab's state.",
)
DISK_ROOM = Code("disk_room", "disk: {free:bytes} free", severity=INFO)
DISK_FULL = Code(
    "disk_almost_full",
    "disk: {free:bytes} free; expected {least:bytes} at least",
    "Make room: bags and uploads need it.",
)
SANDBOX_HAS = Code("sandbox_has", "sandbox of files from outside: {layers:list}", severity=INFO)
NO_LANDLOCK = Code(
    "no_landlock",
    "sandbox of files from outside: the kernel has no Landlock; a reader of bags, meshes or "
    "submissions can open every file of this user, and a xacro is refused",
    "Use Linux 5.13 or newer with Landlock, or a container that allows its system calls; until "
    "then read files only from people whom you trust.",
)
NO_SECCOMP = Code(
    "no_seccomp",
    "sandbox of files from outside: the kernel takes no filter of system calls; a reader can open "
    "sockets and change the modes of files, and a xacro is refused",
    "Use a kernel with seccomp on x86_64 or aarch64; until then read files only from people whom "
    "you trust.",
)
