"""What a unit that a file names says of the numbers beside it."""

from __future__ import annotations

from mrlab_ros.core.conversion.variable_names import (
    ACCELERATIONS,
    CURRENTS,
    POSES,
    TEMPERATURES,
    TORQUES,
    TURNS,
    VELOCITIES,
    Hint,
    Name,
    words,
)

VOLTAGES = "voltages"
UNITS_AGAINST = {
    VELOCITIES: words(
        "rad/s deg/s °/s grad/s rad/sec deg/sec degree/s degrees/s grad/sec m/s mm/s cm/s rpm "
        "u/min 1/min min-1 min^-1 1/s s^-1 rev/s rad*s^-1 turns/s mrad/s"
    ),
    ACCELERATIONS: words(
        "rad/s^2 rad/s2 deg/s^2 deg/s2 °/s^2 °/s2 grad/s^2 grad/s2 m/s^2 m/s2 mm/s^2 mm/s2 "
        "rad/sec^2 deg/sec^2 rad/s/s deg/s/s rad/s**2 deg/s**2"
    ),
    TORQUES: frozenset(("nm", "n*m", "n m", "n", "n-m", "ncm", "mnm", "kn", "knm")),
    CURRENTS: words("a ma amp amps ampere"),
    VOLTAGES: words("v mv volt volts"),
    POSES: words("m mm cm"),
    TEMPERATURES: words("°c degc k celsius"),
    TURNS: words("u rev revs turn turns umdrehungen"),
}
DEGREES = words("deg degree degrees grad °")


def plain_unit(unit: str) -> str:
    """Return a unit as the tables here write it: small letters, no brackets, ^2 and *."""
    text = unit.strip().lower().strip("[](){}").strip()
    return text.replace("²", "^2").replace("·", "*").replace("⋅", "*").replace("º", "°")


def against(unit: str) -> str:
    """Return the quantity of a unit that joint positions do not have, or empty."""
    plain = plain_unit(unit)
    return next((what for what, names in UNITS_AGAINST.items() if plain in names), "")


def said_by_units(given: tuple[str, ...]) -> Name:
    """Return what the units of all columns say together; nothing where they differ."""
    plain = {plain_unit(u) for u in given if u.strip()}
    if len(plain) != 1:
        return Name(Hint.NEUTRAL)
    unit = plain.pop()
    what = against(unit)
    if what:
        return Name(Hint.AGAINST, what)
    return Name(Hint.NEUTRAL, "", "deg" if unit in DEGREES else "")
