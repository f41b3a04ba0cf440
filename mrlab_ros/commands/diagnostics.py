"""Diagnostics of single commands; only here may a text name options."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import INFO, WARNING, Code

# every command
COMMAND_FAULT = Code("command_fault", "{error}", "mrlab --debug ... shows where.")
DISK_REFUSES = Code(
    "disk_refuses",
    "{file:problem}: {why:problem}.",
    "{remedy:choice room=Make room on that disk, or name a folder on another one."
    "|may=Check who may read and write there, or name another folder.}",
)
UNNAMED_FILE = Code("unnamed_file", "a file could not be written")
MODULE_NOT_INSTALLED = Code(
    "module_not_installed",
    "{error}.",
    "Install what requirements.lock names, or run make demo in a clone.",
)
NEEDS_ROS = Code(
    "needs_ros",
    "This command needs ROS 2 and the lab's messages, and {package} is not installed here: no "
    "wheel has them.",
    "In a clone make demo sets both up, on a ROS machine colcon builds them. Without them mrlab "
    "convert, show, check, rubric, robots and keys work.",
)

# up
SCENE_COMES_BACK = Code(
    "scene_comes_back",
    "--state-dir {folder} holds a scene, which is brought back; --robots is for an empty one.",
    severity=INFO,
)
OPEN_TO_ALL = Code(
    "open_to_all",
    "--insecure: whoever reaches {endpoint} sees and moves everything.",
    severity=WARNING,
)
WAITS_FOR_CLOCK = Code(
    "waits_for_clock",
    "--sim-time: nothing moves until somebody publishes /clock.",
    severity=INFO,
)
KEYS_EXPIRE = Code(
    "keys_expire",
    "The lab's certificate expires in {days:count day|days}.",
    severity=WARNING,
)

# record
NOT_A_BAG_NAME = Code(
    "not_a_bag_name",
    "'{bag}' is no name for a bag.",
    "Name the whole path of the bag where it shall be called so.",
)
STOP_WITH_BAG = Code("stop_with_bag", "--stop ends the recording that runs.", "Leave '{bag}' out.")
RECORDING_CONTINUES = Code(
    "recording_continues",
    "{why:problem}; the recording continues in {bag}",
    severity=WARNING,
)
RECORDER_BACK = Code(
    "recorder_back",
    "the recorder answers again; the recording continues in {bag}",
    severity=INFO,
)
ENDED_BY_ANOTHER = Code(
    "ended_by_another", "another client ended the recording into {bag}", severity=INFO
)
RECORDING_GONE = Code(
    "recording_gone",
    "The recording into {bag} has ended while its recorder did not answer.",
    meaning="A recorder returned without the recording that ran; the bag holds what came before.",
)
RECORDER_SILENT = Code(
    "recorder_silent",
    "The recorder has been silent for {silent:time}[; what it wrote into {bag} stays readable, "
    "and a restarted recorder continues in that bag].",
)
RECORDER_AWAITED = Code(
    "recorder_awaited",
    "the recorder has been silent for {silent:time}; waits for its restart",
    severity=WARNING,
)
LAB_SILENT = Code(
    "lab_silent",
    "the lab has been silent for {silent:time}, but the recording continues in {bag}; Ctrl-C "
    "ends it",
    severity=WARNING,
)
RECORDER_FROZEN = Code(
    "recorder_frozen",
    "The recorder gave no sign of life for {silent:time}: a frozen one ends the recording when it "
    "continues, a restarted one continues the recording.",
)
STOP_WAITS = Code(
    "stop_waits",
    "The recorder gave no sign of life for {silent:time}; the order to end the recording into "
    "{bag} waits for it, and is carried out as soon as a recorder runs.",
)
STOP_NOT_AWAITED = Code(
    "stop_not_awaited",
    "did not wait for the recorder; the order to end the recording into {bag} waits for it, and "
    "is carried out as soon as a recorder runs",
    severity=WARNING,
)
STOP_UNKNOWN = Code(
    "stop_unknown",
    "did not wait for the recorder, which may still record[ into {bag}]",
    severity=WARNING,
)
BAG_CLOSED = Code("bag_closed", "the bag is closed", severity=INFO)

# bags of others
ROBOT_WITHOUT_PATH = Code(
    "robot_without_path",
    "There is no bag {path}; --robot is for the bags of others, by their path.",
)
REFERENCE_REFUSED = Code(
    "reference_refused",
    "The reference {file} is refused for {model}: {why:problem}.",
    "Mend it, and name what a conversion of it writes.",
)
EXTRACTED = Code(
    "extracted",
    "wrote {files:count file|files} to {folder}",
    severity=INFO,
    data=("names",),
)
EXPORTED = Code(
    "exported",
    "{file} ({size:bytes}) has {robots:list}; rerun {file:problem} shows it.",
    severity=INFO,
)

# users
NO_USERS_HERE = Code(
    "no_users_here",
    "There is no keys folder here and no lab runs.",
    "Make one, or name it with --dir.",
)
GIVEN_OR_ERASED = Code(
    "given_or_erased", "The data is to be erased and given away.", "Choose one of the two."
)
DATA_OF_ANOTHER_LAB = Code(
    "data_of_another_lab",
    "The lab that runs here is not the one of these people.",
    "Start theirs, or leave out --erase and --give-to.",
)

# show
PAGE_NAME = Code("page_name", "The page is '{name}'; expected a name that ends in .html.")
REPORT_WITHOUT_BAG = Code(
    "report_without_bag", "{path} does not say which bag it is of.", "Name the bag itself."
)
BAG_OF_REPORT_GONE = Code(
    "bag_of_report_gone",
    "{path} is of the bag {bag}, which is not there.",
    "Name the bag itself.",
)

# robots of the library
BAD_ANGLES = Code(
    "bad_angles",
    "--joints is '{text}'; expected {count:integer} angles in degrees with commas between them, "
    "one each for {joints:list}.",
)
ROBOTS_HAVE_ERRORS = Code(
    "robots_have_errors",
    "{count:count error was|errors were} found.",
    "See the remedies above.",
)
ROBOT_NOT_IMPORTED = Code(
    "robot_not_imported", "{file} was not imported: {count:count error|errors}."
)
AS_TOOL_WITHOUT = Code(
    "as_tool_without",
    "--as-tool takes no {options:list}: a hand alone has no arm.",
    "Leave out {options:list}.",
)
MESHES_NOT_INSTALLED = Code(
    "meshes_not_installed",
    "The meshes of {file} were not installed: {count:count error|errors}, listed above.",
)
MESHES_INSTALLED = Code(
    "meshes_installed",
    "{robot} has the meshes of {file}; undo it with: mrlab robots remove {robot}",
    severity=INFO,
)
NO_MESHES_INSTALLED = Code(
    "no_meshes_installed",
    "No meshes were installed: {count:count robot keeps its body|robots keep their bodies}.",
)
NO_OWN_DESCRIPTION = Code(
    "no_own_description",
    "No public description of '{robot}' itself is known, so it keeps the lab's body.",
    severity=INFO,
)
OWN_MESHES_AGAIN = Code("own_meshes_again", "{robot} has its own meshes again.", severity=INFO)
MODEL_REMOVED = Code("model_removed", "{robot} was removed.", severity=INFO)
BAD_PACKAGE_OPTION = Code("bad_package_option", "--package is '{text}'; expected NAME=FOLDER.")

# objects
NO_PHYSICS_HERE = Code(
    "no_physics_here",
    "This lab runs without physics.",
    meaning="Objects need the physics node, which this lab was started without.",
)
BAD_PLACE = Code("bad_place", "The place is '{text}'; expected x,y,z in m, such as 0.5,0,0.8.")
# robots and systems of the running lab
DISSOLVED_IN_PLAY = Code("dissolved_in_play", "{system} was dissolved while it played.")
SYSTEM_STANDS = Code("system_stands", "{system} is {state:state}[: {why:problem}].")
NO_MODE = Code("no_mode", "The mode is '{mode}'; expected parallel or sequential.")
YAW_WITHOUT_PLACE = Code(
    "yaw_without_place", "--yaw {yaw:number} needs a place.", "Give it with --at X,Y."
)
BAD_AT = Code("bad_at", "--at is '{found}'; expected X,Y or X,Y,Z in m, such as 1,-0.5.")
ONLY_FOR_A_FILE = Code(
    "only_for_a_file",
    "{option} is for a file; a trajectory[ such as '{trajectory}'] is converted already.",
    "[The speed is set with {speed}.]",
)
NO_PAGES = Code(
    "no_pages",
    "The lab that runs serves no pages.",
    "Start it without --no-web and --no-bridge.",
)
NO_PEM = Code("no_pem", "{path} is no certificate in PEM: {why:problem}.")

# up
KEYS_OR_INSECURE = Code(
    "keys_or_insecure", "--keys and --insecure exclude each other.", "Leave one of them out."
)
BRIDGE_PORT_TAKEN = Code(
    "bridge_port_taken",
    "The bridge cannot listen on {endpoint}: {why}. Another lab may have that port.",
    "Choose another one, such as {option}tcp/127.0.0.1:0 (0: any that is free).",
)
PAGES_PORT_TAKEN = Code(
    "pages_port_taken",
    "The pages cannot be served on {host}:{port:integer}: {why}. Another lab may have that port.",
    "Choose another one with --http {host}:{next:integer} (0: any that is free), or leave the "
    "pages out with --no-web.",
)
ROUTER_WITHOUT_KEYS = Code(
    "router_without_keys",
    "--zenoh-connect {router} is for a lab with keys, which its people reach at that router "
    "alone.",
    "Give --keys FOLDER, and leave --zenoh-listen and --insecure out.",
)
LAB_OR_HUB = Code(
    "lab_or_hub",
    "A router is either a campus's, with --lab, or a lab's that connects to one, with --hub.",
    page=False,
)
PROCESSES_REFUSE = Code(
    "processes_refuse",
    "The lab does not start: {processes:list} refused the configuration and said above what is "
    "wrong.",
    "Correct it and start again.",
)

# demo
WAITED_IN_DEMO = Code(
    "waited_in_demo",
    "Waited {timeout:time} for {part:choice lab=all parts of the lab|pages=the pages|playback=the "
    "playback of|zenoh=zenoh and}[ {name}][; its last complaint: {complaint}].",
)
DEMO_WITHOUT_ZENOH = Code(
    "demo_without_zenoh", "There is no zenoh session to the bridge at {endpoint}: {why:problem}."
)
DEMO_TOO_SLOW = Code(
    "demo_too_slow",
    "The run of {duration:time} did not end in time[; its last complaint: {complaint}].",
)
DEMO_NEVER_PLAYED = Code(
    "demo_never_played",
    "{robot} never said that it plays[; its last complaint: {complaint}].",
)
DEMO_HALTED = Code("demo_halted", "The run was halted: {why:problem}.")
DEMO_ENDED_EARLY = Code(
    "demo_ended_early", "The run ended too early in {state:state}[: {why:problem}]."
)
DEMO_FAULT = Code(
    "demo_fault",
    "{robot}: {received:integer} of {expected:integer} frames arrived over zenoh in order and as "
    "the file has them, {lost:integer} were left out by the playback; first fault: {fault}.",
)
NO_PORT_LEFT = Code(
    "no_port_left", "No TCP port is free on this machine.", "End some programs, then try again."
)
NO_DOMAIN_LEFT = Code(
    "no_domain_left",
    "Every ROS domain is in use on this machine.",
    "End some labs, then try again.",
)
NO_DEMO_FILE = Code(
    "no_demo_file", "There is no file {path}.", "Name a workspace file with --file."
)

# capturing and comparing
CAPTURED = Code(
    "captured",
    "{bag} holds {messages:count message|messages} of {topic}",
    severity=INFO,
)
COMPARED = Code(
    "compared",
    "{measured} is[ {delay:number} s] {side:choice late=later than|ahead=ahead of|same=in time "
    "with} {planned}, {clock:choice frames=counted from the first frame of each|stamps=by their "
    "stamps}[; without that {joint} is off the most][; {alike:choice yes=no joint is off}]."
    "[ {compared:number} s of the {whole:number} s of {planned} are in both; the rest is not "
    "compared.]",
    severity=INFO,
)
