"""The visual language of config/design.json as CSS, TypeScript and Python."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

CONFIG = "config/design.json"
NOTE = f"Generated from {CONFIG} by `make docs`."
THEMES = ("light", "dark")
# The nearest of a terminal's own colours to a state's.
STYLES = {
    "IDLE": "dim",
    "READY": "blue",
    "ADJUSTING": "green",
    "PLAYING": "green",
    "PAUSED": "yellow",
    "COLLISION_HALT": "bold red",
    "COMPLETE": "blue",
}


def _read(root: Path) -> dict[str, Any]:
    design: dict[str, Any] = json.loads((root / CONFIG).read_text())
    return design


def _hyphened(name: str) -> str:
    return name.lower().replace("_", "-")


def _colours(design: dict[str, Any], theme: str) -> Iterator[tuple[str, str]]:
    for name, pair in design["colours"].items():
        yield _hyphened(name), pair[theme]
    for number, colour in enumerate(design["joints"][theme], start=1):
        yield f"joint-{number}", colour
    for name, state in design["states"].items():
        yield f"state-{_hyphened(name)}", state[theme]
    for name, state in design["severities"].items():
        yield _hyphened(name), design["states"][state][theme]


def css(root: Path) -> str:
    """Return the custom properties; `data-theme` on the root element overrides the system's."""
    design = _read(root)
    fixed = [
        ("font", design["type"]["family"].replace("'", '"')),
        ("font-mono", design["type"]["mono"].replace("'", '"')),
        *((f"text-{px}", f"{px / 16:g}rem") for px in design["type"]["sizes_px"]),
        *((f"space-{px}", f"{px}px") for px in design["space_px"]),
        *((f"radius-{px}", f"{px}px") for px in design["radius_px"]),
        ("target", f"{design['target_px']}px"),
        *((name, f"{ms}ms") for name, ms in design["motion_ms"].items()),
    ]

    def block(indent: str, pairs: list[tuple[str, str]]) -> str:
        return "\n".join(f"{indent}--{name}: {value};" for name, value in pairs)

    light, dark = ([(n, c.lower()) for n, c in _colours(design, theme)] for theme in THEMES)
    return f"""/* {NOTE} */
:root {{
  color-scheme: light dark;
{block("  ", fixed)}
}}
:root,
:root[data-theme="light"] {{
{block("  ", light)}
}}
@media (prefers-color-scheme: dark) {{
  :root:not([data-theme="light"]) {{
{block("    ", dark)}
  }}
}}
:root[data-theme="dark"] {{
{block("  ", dark)}
}}
:root[data-theme="light"] {{
  color-scheme: light;
}}
:root[data-theme="dark"] {{
  color-scheme: dark;
}}
"""


def typescript(root: Path) -> str:
    """Return the constants of the pages: colours by theme for canvas and 3D."""
    design = _read(root)

    def record(pairs: dict[str, str], indent: str) -> str:
        lines = "".join(f"{indent}  {name}: '{value}',\n" for name, value in pairs.items())
        return f"{{\n{lines}{indent}}}"

    def theme(name: str) -> str:
        colours = {key: pair[name] for key, pair in design["colours"].items()}
        states = {key: state[name] for key, state in design["states"].items()}
        joints = ", ".join(f"'{colour}'" for colour in design["joints"][name])
        return (
            f"  {name}: {{\n"
            f"    colours: {record(colours, '    ')},\n"
            f"    states: {record(states, '    ')},\n"
            f"    joints: [{joints}],\n"
            "  },\n"
        )

    names = "".join(f"  '{name}',\n" for name in design["states"])
    icons = {name: state["icon"] for name, state in design["states"].items()}
    return f"""// {NOTE}
export type ThemeName = 'light' | 'dark'

export const STATE_NAMES = [
{names}] as const
/** A state of a playback, as in mrlab_msgs/msg/PlaybackState: its number is its place. */
export type StateName = (typeof STATE_NAMES)[number]

export const THEMES = {{
{theme("light")}{theme("dark")}}} as const

export const STATE_ICONS = {record(icons, "")} as const
"""


def python(root: Path) -> str:
    """Return the constants of matplotlib and rich: pictures are light, terminals of either."""
    design = _read(root)
    states = {name: state["light"] for name, state in design["states"].items()}

    def record(pairs: dict[str, str]) -> str:
        return "".join(f'    "{name}": "{value}",\n' for name, value in pairs.items())

    def of(names: dict[str, str]) -> str:
        return record({name: states[state] for name, state in names.items()})

    joints = "".join(f'    "{colour}",\n' for colour in design["joints"]["light"])
    colours = {name: pair["light"] for name, pair in design["colours"].items()}
    return f'''"""Colours of pictures and terminals, the same as on the pages.

{NOTE}
"""

STATES = {{
{record(states)}}}
# Of the joints 1 to 7, and over again.
JOINTS = (
{joints})
SEVERITIES = {{
{of(design["severities"])}}}
COLOURS = {{
{record(colours)}}}
# Of terminals, whose background is not known: names that each terminal's theme makes readable.
OUTCOME_STYLES = {{
{record({name: STYLES[state] for name, state in design["outcomes"].items()})}}}
SEVERITY_STYLES = {{
{record({name: STYLES[state] for name, state in design["severities"].items()})}}}
STATE_STYLES = {{
{record({name: STYLES[name] for name in states})}}}
'''
