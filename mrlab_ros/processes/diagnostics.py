"""Diagnostics of a lab's processes that cannot be started."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import WARNING, Code

NO_PRIVATE_FOLDER = Code(
    "no_private_folder",
    "No folder is this user's alone: {reasons:reasons}.",
    "Set XDG_RUNTIME_DIR to one.",
    meaning="Where a lab keeps its socket, others must not write.",
)
NO_SUCH_PROCESS = Code(
    "no_such_process",
    "'{name}' is no process of a lab.",
    "Expected some of {known:list}, with commas between them.",
    page=False,
)
NOT_A_ROUTER = Code(
    "not_a_router",
    "In {path} zenoh's mode is {mode}; a router's is router.",
    "Give the file of a router.",
    page=False,
)
DOMAIN_TAKEN = Code(
    "domain_taken",
    "A lab runs on ROS domain {domain:integer} already[ (process {pid:integer})].",
    "Use that one, stop it, or set ROS_DOMAIN_ID to another number.",
    meaning="A ROS domain has one lab of a user.",
)
LABS_ELSEWHERE = Code(
    "labs_elsewhere",
    "No lab answers on ROS domain {domain:integer}; yours are on {labs:list}.",
    "Set ROS_DOMAIN_ID to the domain of one.",
    meaning="This user's labs run on other ROS domains.",
)
NO_NODE = Code(
    "no_node",
    "{node}: there is no such node in the lab; expected one of {nodes:list}, or /** for all.",
    "[Did you mean '{close}'?]",
    meaning="A section of a parameter file names no node.",
    page=False,
)
NO_PARAMETER_FILE = Code(
    "no_parameter_file",
    "There is no parameter file {path}.",
    "Name an existing one as config, or leave it out.",
    meaning="The parameter file that was chosen is not there.",
    page=False,
)
NOBODY_WAITS = Code(
    "nobody_waits",
    "Nobody waits for the lab any longer.",
    meaning="The launch file waits for its lab for a limited time.",
)
NO_PHYSICS = Code(
    "no_physics", "There is no physics: {why:problem}.", meaning="Physics was asked for."
)
RUNS_WITHOUT_PHYSICS = Code(
    "runs_without_physics",
    "The lab runs without physics: {why:problem}.",
    severity=WARNING,
    meaning="Physics was not asked for and cannot run here.",
)
