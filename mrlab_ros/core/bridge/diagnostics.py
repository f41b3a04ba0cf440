"""Diagnostics of the bridge: of its allow-list and endpoints, and refusals of queries."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

# the allow-list and the parameters

RULE_GOES_OUT = Code(
    "rule_goes_out",
    "The rule for {topic} has a role but goes out; everybody who may connect receives it.",
    "Leave the role out, or set direction: in.",
    meaning="Only what comes in needs a role.",
)
RULE_WITHOUT_NAME = Code(
    "rule_without_name",
    "{place} holds {found}; expected an entry with a name, such as {example}.",
    meaning="An entry of the allow-list without a name.",
)
ALLOW_LIST_NOT_READ = Code(
    "allow_list_not_read",
    "The bridge cannot read its allow-list {path}: {why:problem}.",
    "Name a YAML file with the parameter allow_list.",
    meaning="The file of the bridge's rules cannot be read.",
)
ROUTER_NEEDS_CLIENT = Code(
    "router_needs_client",
    "The bridge has keys and connects to {endpoints:list}, with mode {mode}[ and listen "
    "{listen:list}]; people then connect to that router alone.",
    "Leave listen empty and set mode to client.",
    meaning="A lab with keys that connects to a router does not listen itself.",
)
ROUTER_WITHOUT_TLS = Code(
    "router_without_tls",
    "The bridge has keys and is to connect to {endpoint}, where it can show none; expected a "
    "router's endpoint such as tls/router.example.org:7447.",
    meaning="A lab with keys connects by tls or quic only.",
)
BAD_ENDPOINT = Code(
    "bad_endpoint",
    "The bridge is to listen on '{endpoint}'; expected protocol/address:port, such as "
    "tcp/127.0.0.1:7447.",
    meaning="An endpoint of zenoh that is none.",
)
QUIC_UNBOUNDED = Code(
    "quic_unbounded",
    "The bridge is to listen on {endpoint}; of QUIC links it can bound neither the number nor the "
    "bytes of one person, who could take the lab from all others.",
    "Listen on {better}.",
    meaning="A lab does not listen with QUIC.",
)
KEYS_NEED_TLS = Code(
    "keys_need_tls",
    "The lab has keys, and the bridge is to listen on {endpoint}, where nobody can show one.",
    "Listen on {better}, or leave the keys out.",
    meaning="A lab with keys listens with TLS only.",
)
TLS_NEEDS_KEYS = Code(
    "tls_needs_keys",
    "The bridge is to listen on {endpoint}, and for {protocol} it needs keys.",
    "Make them and name their folder (the parameter keys).",
    meaning="TLS needs a certificate.",
    commands=("mrlab keys init", "mrlab up --keys FOLDER"),
)
OPEN_ENDPOINT = Code(
    "open_endpoint",
    "The bridge is to listen on {endpoint}, where anybody in the network could watch and move the "
    "robots.",
    "Give the lab keys, listen on tcp/127.0.0.1, or accept it with the parameter insecure.",
    meaning="An endpoint that other machines reach without encryption.",
    commands=("mrlab keys init", "mrlab up --keys FOLDER", "mrlab up --insecure"),
)
CONFIG_AND_KEYS = Code(
    "config_and_keys",
    "The bridge has both zenoh_config ({file}) and keys ({folder}); expected one, as each decides "
    "who may connect.",
    meaning="Two parameters of the bridge contradict each other.",
)
CLIENT_WITHOUT_ROUTER = Code(
    "client_without_router",
    "The bridge has keys ({folder}) and mode client, and no router.",
    "Name the router to connect to with the parameter connect, or leave mode out.",
    meaning="A client of zenoh needs a router.",
)

# queries of clients

ASSETS_BUSY = Code(
    "assets_busy",
    "{waiting:integer} queries for assets wait already.",
    "Ask again later.",
    meaning="The bridge answers so many queries for assets at a time.",
)
NOT_A_PACKAGE_URI = Code(
    "not_a_package_uri",
    "The URI is '{uri}'; expected one that begins with {begin}.",
    meaning="A mesh is named by a package:// URI.",
)
SEVERAL_ASSETS = Code(
    "several_assets",
    "'{key}' stands for several assets.",
    "Get each by its own key, as in {robots} and {objects}.",
    meaning="A query for assets names one.",
)
NO_ASSET_NAME = Code(
    "no_asset_name",
    "'{path}' names no asset; expected a path such as mrlab_ros/robots/ur5e/meshes/base_link.glb, "
    "without '..' and hidden names.",
    meaning="The path of an asset has empty, hidden or relative parts.",
)
ASSET_OFFSET_BEYOND = Code(
    "asset_offset_beyond",
    "{key} has {size:integer} bytes; the offset is {offset:integer}.",
    "Ask for an offset of at most its size.",
    meaning="A piece of an asset was asked for that begins behind its end.",
)
ASSET_IN_PIECES = Code(
    "asset_in_pieces",
    "{key} has {size:integer} bytes, and one reply holds {largest:integer} at most.",
    "Get it in pieces: {key}?offset=0;length={largest:integer}, then the next offset.",
    meaning="An asset is too large for one reply.",
)
BAD_ASSET_PARAMETER = Code(
    "bad_asset_parameter",
    "The parameter {parameter} is '{found}'; expected a number of bytes, as in "
    "?offset=0;length=65536.",
    meaning="A parameter of a query for an asset.",
)
BAD_ASSET_ATTACHMENT = Code(
    "bad_asset_attachment",
    "The attachment {found} is not that of an asset; expected JSON with size, sha256, media_type "
    "and offset.",
    meaning="What comes with a piece of an asset cannot be read.",
)
SERVICE_GONE = Code(
    "service_gone",
    "The service {service} has gone.",
    "Check which nodes run, then call again.",
    meaning="The server of a service left the graph.",
)
CALLED_BY_ANOTHER_KEY = Code(
    "called_by_another_key",
    "The service {service} is called by its key {key}, not as {found}.",
    meaning="A query for several keys calls no service.",
)
PATH_FROM_AFAR = Code(
    "path_from_afar",
    "{service}: '{path}' is a path on the lab's machine.",
    "Expected a name without a folder; programs on that machine call the service over ROS.",
)
REQUEST_TOO_LARGE = Code(
    "request_too_large",
    "A request of {service} has {size:integer} bytes; expected {largest:integer} at most "
    "(max_size in the allow-list).",
    meaning="The request of a service is larger than its rule allows.",
)
REQUEST_MISSING = Code(
    "request_missing",
    "The service {service} was called without a request.",
    "Send the CDR of {type}'s request as the query's payload.",
    meaning="A query without payload, for a service that has a request.",
)
REQUEST_NOT_CDR = Code(
    "request_not_cdr",
    "The service {service} got {size:integer} bytes that are not a request of {type}.",
    "Send its CDR, with the 4-byte header.",
    meaning="The payload of a query cannot be decoded.",
)
CALLS_WAIT = Code(
    "calls_wait",
    "The service {service} has {waiting:integer} calls waiting and accepts no more.",
    "Wait for a response, then call again.",
    meaning="More calls wait for a service than its rule allows.",
)
SERVER_SILENT = Code(
    "server_silent",
    "The service {service} did not answer within {timeout:time}.",
    "Check whether its node runs, then call again.",
    meaning="The server of a service did not answer in the time of its rule.",
)
