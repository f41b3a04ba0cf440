"""Colours of pictures and terminals, the same as on the pages.

Generated from config/design.json by `make docs`.
"""

STATES = {
    "IDLE": "#667085",
    "READY": "#0047B3",
    "ADJUSTING": "#00805A",
    "PLAYING": "#00805A",
    "PAUSED": "#AD6200",
    "COLLISION_HALT": "#7A0C1C",
    "COMPLETE": "#0047B3",
}
# Of the joints 1 to 7, and over again.
JOINTS = (
    "#00507B",
    "#B44809",
    "#007F7F",
    "#8A39D3",
    "#E27900",
    "#2C9ED9",
    "#173900",
)
SEVERITIES = {
    "error": "#7A0C1C",
    "warning": "#AD6200",
    "info": "#0047B3",
}
COLOURS = {
    "page": "#F7F8FA",
    "card": "#FFFFFF",
    "ink": "#16202B",
    "second": "#4A5766",
    "border": "#7B8896",
    "hairline": "#DCE1E7",
    "accent": "#0B5CAD",
    "on_accent": "#FFFFFF",
    "on_halt": "#FFFFFF",
}
# Of terminals, whose background is not known: names that each terminal's theme makes readable.
OUTCOME_STYLES = {
    "accepted": "green",
    "rejected": "bold red",
    "ambiguous": "yellow",
}
SEVERITY_STYLES = {
    "error": "bold red",
    "warning": "yellow",
    "info": "blue",
}
STATE_STYLES = {
    "IDLE": "dim",
    "READY": "blue",
    "ADJUSTING": "green",
    "PLAYING": "green",
    "PAUSED": "yellow",
    "COLLISION_HALT": "bold red",
    "COMPLETE": "blue",
}
