"""Diagnostics of calls and services of the graph."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

FAULT = Code(
    "fault",
    "The lab failed at {service} ({error}); its log has the details.",
    meaning="A fault of the lab: what was asked for was not done, or only in part.",
)
NOT_OFFERED = Code(
    "not_offered",
    "Nobody offers {service}[ on ROS domain {domain:integer}]; that part of the lab may not run.",
    meaning="A service of the graph is not there.",
    commands=("mrlab status",),
)
SERVICE_ENDED = Code(
    "service_ended",
    "{service} ended before it could answer.",
    "Try again.",
    meaning="A service left the graph while a call of it waited.",
)
NO_ANSWER_IN_TIME = Code(
    "no_answer_in_time",
    "{service} did not answer within {timeout:time}.",
    "Try again.",
    meaning="Whether the call was carried out is not known.",
)
WAITED_TOO_LONG = Code(
    "waited_too_long",
    "This request waited {waited:time} for the ones before it, so it was not carried out.",
    "Send it again.",
    meaning="A request whose turn comes late: its caller may have given up.",
)
NOTHING_CAME = Code(
    "nothing_came",
    "Nothing came on {topic} within {timeout:time}; that part of the lab may not run.",
    meaning="A topic was waited for.",
    commands=("mrlab status",),
)
NOT_AS_AWAITED = Code(
    "not_as_awaited",
    "What was waited for did not come on {topic} within {timeout:time}.",
    meaning="A topic was waited for until it says something.",
    commands=("mrlab status",),
)
NO_LAB_ANSWERS = Code(
    "no_lab_answers",
    "No lab answers on ROS domain {domain:integer}.",
    "Start one, or set ROS_DOMAIN_ID to the domain of a running one.",
    meaning="A client found no lab.",
)
CLIENT_CLOSED = Code(
    "client_closed",
    "This client of the lab is closed.",
    "Open another one: Lab().",
    meaning="A client was used after its end.",
)
BAD_DOMAIN = Code(
    "bad_domain",
    "ROS_DOMAIN_ID is '{found}'; expected a number from 0 to 232.",
    meaning="The environment names no ROS domain.",
    page=False,
)
BAD_ROS_ARGUMENTS = Code(
    "bad_ros_arguments",
    "ROS refuses the command line: {why}. Expected arguments as ROS has them, such as a parameter "
    "file or a parameter lab:robots:='[[ur5e]]'.",
    meaning="The arguments of a node are not those that rcl knows.",
)
NO_LOG_FOLDER = Code(
    "no_log_folder",
    "ROS cannot write its log to {folder}: {why:problem}.",
    "Make the folder writable for this user, or set ROS_LOG_DIR to one that is.",
    meaning="Every program of ROS writes a log: below ROS_LOG_DIR, ROS_HOME or ~/.ros.",
    page=False,
)
NO_ARRIVALS = Code(
    "no_arrivals",
    "The middleware does not announce the messages of {topic} (error {error:integer}).",
    "Set RMW_IMPLEMENTATION to one that does, such as rmw_fastrtps_cpp.",
    meaning="A middleware without callbacks for new messages.",
)
PARAMETERS_REFUSED = Code(
    "parameters_refused",
    "{mistakes:problem}.",
    "The parameters of {node} are set in the parameter file, or with -p {node}:NAME:=VALUE, "
    "before it starts; docs/parameters.md lists them.",
    meaning="A node does not start with these parameters.",
    page=False,
)
PARAMETER_FIXED = Code(
    "parameter_fixed",
    "{parameter} is read when {node} starts and cannot change while it runs.",
    "Set it in the parameter file, or with -p {node}:NAME:=VALUE, and start the node again; "
    "docs/parameters.md lists all.",
    meaning="A parameter that takes effect at the start of its node alone.",
    page=False,
)
SEVERAL_NODES_REFUSE = Code(
    "several_nodes_refuse",
    "{count:integer} nodes do not start:{mistakes:problems}",
    meaning="The nodes of a process refuse their parameters.",
    page=False,
)
