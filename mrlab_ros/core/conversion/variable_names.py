"""What a name says about the numbers under it: names of variables, headings of tables.

A name is evidence beside the numbers and never decides alone. The words were collected from
workspaces in public repositories, from the logs of robot controllers and from lecture notes, in
English and German.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import NAME_SAYS


class Hint(Enum):
    """What a name says of joint positions."""

    POSITIONS = "positions"
    NEUTRAL = "neutral"
    TWO_FACED = "two_faced"
    DOUBTFUL = "doubtful"
    AGAINST = "against"


@dataclass(frozen=True)
class Name:
    """What a name says. what: the quantity it names, or empty; unit: deg or empty."""

    hint: Hint
    what: str = ""
    unit: str = ""

    @property
    def why(self) -> Diagnostic:
        """Return what is said of the hint, with the quantity where the name says one."""
        if self.hint is Hint.AGAINST and self.what:
            return NAME_SAYS(quantity=self.what)
        if self.hint is Hint.DOUBTFUL and self.what:
            return NAME_SAYS(often=self.what)
        return NAME_SAYS(hint=self.hint.value)


def words(text: str) -> frozenset[str]:
    """Return the words of a text, in lower case."""
    return frozenset(text.lower().split())


# quantities, as diagnostics.QUANTITY has them
VELOCITIES, ACCELERATIONS, JERKS = "velocities", "accelerations", "jerks"
TORQUES, CURRENTS, ERRORS = "torques", "currents", "errors"
POSES, TIMES, PARAMETERS = "poses", "times", "parameters"
TURNS, OBSTACLES, TEMPERATURES = "turns", "obstacles", "temperatures"

# Whole names, without case, separators and trailing digits.
POSITIONS = words(
    "q qmatrix qmat qcombined qtraj qraw qfilt qfilter qds qlist qj qc qt qpath qs qhistory "
    "qactual qact qtarget qdes qref qmeas qsim qout qall qinterp qsol qik qlog qcmd qcurrent "
    "currentq qsoll qist "
    "jointtraj jointtrajectory jointangles jointangle joints jointstates "
    "jointpositions jointposition jointpos angleexport angles jointvalues theta thetas thetalist "
    "thetares thl thr refjoint pointrecord configs robotconfigs configurations phi "
    "gelenke achsen gelenkwinkel achswinkel winkel gelenkstellung gelenkstellungen stellungen "
    "gelenkpositionen achspositionen gelenkkoordinaten"
)
TWO_FACED = words(
    "traj trajectory trajectories trj path paths pfad bahn bahndaten pos position positions "
    "positionen waypoints waypoint wp wps wegpunkte stuetzpunkte points punkte route plan motion "
    "bewegung trajektorie movement ref reference desired target actual measured soll ist "
    "pathpoints viapoints keyframes"
)
WHOLE_DOUBTFUL = {
    "qd": "joint_velocities",
    "qobs": OBSTACLES,
    "qerr": ERRORS,
    "qerror": ERRORS,
    "u": "inputs",
    "v": "pixels",
    "x": "tool_or_states",
    "p": "points",
    "s": "states_or_path",
    "w": "angular_velocities",
    "state": "states",
    "states": "states",
    "b": PARAMETERS,
}
WHOLE_AGAINST = {
    VELOCITIES: words("qp qv qdot omega omegas dq vel thetad thetadot thetap phid phip"),
    ACCELERATIONS: words("qdd qpp qa ddq acc thetadd thetapp phidd phipp"),
    TORQUES: words("tau f ft wrench torque torques trq mom moment momente kraft kraefte"),
    CURRENTS: words("i current currents amps ampere strom stroeme"),
    ERRORS: words("e err error errors fehler residuals residuum diff delta"),
    POSES: words(
        "pose poses xyz xyzrpy xyzabc xd xdd xe ee eef tcp tool toolpath toolvector rpy cart "
        "cartesian kartesisch cpath ctraj tpose tcppos cpol xc xr xref xdes xact"
    ),
    TIMES: words("time tout times zeit timestamp timestamps tspan"),
    PARAMETERS: words(
        "kp kd ki k j jac jacobian m dh g qlim limits limit inertia gravity gains gain mask cov "
        "weights bounds dhparams dhtable"
    ),
}
# Where one of these words is in a name, whatever else is in it.
AGAINST_PARTS = {
    VELOCITIES: words(
        "vel vels velocity velocities speed speeds dot d1 qd dq qp qv qdot rate rates geschw "
        "omega w rpm drehrate velocidad velocidades vitesse velocita"
    ),
    ACCELERATIONS: words("acc accel accels acceleration accelerations ddot d2 qdd ddq qpp"),
    JERKS: words("jerk jerks d3 d4 ruck"),
    TORQUES: words(
        "torque torques force forces tau wrench moment moments load loads effort efforts ft trq"
    ),
    CURRENTS: words("currents amps voltage voltages pwm"),
    ERRORS: words("error errors err errs deviation deviations residual residuals diff delta"),
    POSES: words(
        "tcp pose poses cartesian cart xyz rpy quat quaternion eef ee endeffector tool workspace"
    ),
    PARAMETERS: words("limit limits inertia gains gain jacobian covariance coefficients noise"),
    TEMPERATURES: words("temp temps temperature temperatures temperatur"),
}
# German writes such words together: they count anywhere in a name.
AGAINST_STEMS = {
    VELOCITIES: ("geschwindigkeit", "drehzahl", "velocit", "speeds", "winkelgeschw"),
    ACCELERATIONS: ("beschleunigung", "accelerat"),
    TORQUES: ("drehmoment", "gelenkmoment", "achsmoment", "kraefte", "torque"),
    CURRENTS: ("motorstrom", "motorstroeme", "gelenkstrom", "achsstrom"),
    ERRORS: ("fehler", "abweichung", "differenz"),
    POSES: ("werkzeug", "kartesisch", "cartesian", "endeffekt", "endeffector", "quaternion"),
    PARAMETERS: ("jacobi", "verstaerkung", "grenzwert"),
    TEMPERATURES: ("temperatur",),
}
AGAINST_PREFIXES = (
    ("qdd", ACCELERATIONS),
    ("ddq", ACCELERATIONS),
    ("ddtheta", ACCELERATIONS),
    ("dq", VELOCITIES),
    ("ddphi", ACCELERATIONS),
    ("dphi", VELOCITIES),
    ("ddth", ACCELERATIONS),
    ("dth", VELOCITIES),
    ("dtheta", VELOCITIES),
    ("thetadd", ACCELERATIONS),
    ("thetad", VELOCITIES),
    ("tcp", POSES),
    ("toolvector", POSES),
    ("tau", TORQUES),
    ("torque", TORQUES),
)
POSITION_PARTS = words(
    "q th theta thetas thl thr joint joints jointpos angle angles configs config configuration "
    "configurations jpos jangles gelenk gelenke achse achsen winkel axis axes phi joints"
)
POSITION_STEMS = ("winkel", "gelenkpos", "achspos", "gelenkstellung", "jointangle", "jointpos")
TWO_FACED_PARTS = words(
    "traj trajectory trajectories trj path waypoints waypoint pos position positions points bahn "
    "trajektorie punkte pfad"
)
# a unit that a name ends in, as its words; '/' and 'per' are left out
UNIT_ENDINGS = (
    (
        VELOCITIES,
        ("rad s", "deg s", "grad s", "m s", "mm s", "rads", "degs", "rad sec", "deg sec"),
    ),
    (ACCELERATIONS, ("rad s2", "deg s2", "grad s2", "m s2", "rad s 2", "deg s 2", "rad sec2")),
    (TORQUES, ("nm", "n m")),
    (TURNS, ("turns", "umdrehungen", "umdr", "revs")),
)
DEGREE_PARTS = words("deg degs degree degrees grad")
DEGREE_ENDINGS = ("deg", "degrees", "indeg", "ingrad", "grad")
# what joints have beside positions: a struct of that name holds no positions
OF_JOINTS = (VELOCITIES, ACCELERATIONS, TORQUES, CURRENTS, ERRORS)
# what joints are called where each has a variable or a column of its own: A1 to A6, q1 to q6
NUMBERED_JOINTS = words("q th theta j joint a axis achse gelenk winkel phi angle")
# the symbols that a letter before or behind turns into another quantity
SYMBOLS = words("q th theta phi joint joints gelenk achse winkel angle angles")
BEFORE_SYMBOL = {
    "v": (Hint.AGAINST, VELOCITIES),
    "e": (Hint.AGAINST, ERRORS),
    "a": (Hint.DOUBTFUL, ACCELERATIONS),
    "t": (Hint.DOUBTFUL, TORQUES),
}
# q_punkt and q_p are how German lectures write a derivative; q_2p is the second one
DOTTED = re.compile(r"(q|th|theta|phi|gelenk|winkel)(?P<two>2|zwei|doppel)?(punkt|p|pkt)$")
UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"})
SUBSCRIPTS = re.compile(r"([({])[\d,]+([)}])")
# fields that only say "the values are in here"
CONTAINER_TAIL = re.compile(
    r"(\.(signals|values|data|Data|Values|Value|q_?data)(\(\d+\))?)+(\([\d:, end]+\))?$"
)


def leaf(path: str) -> str:
    """Return the name that speaks for `path`: `out.q` of `out.q.signals(1).values`."""
    inner = CONTAINER_TAIL.sub("", path)
    return re.split(r"[.{(]", inner if inner else path)[-1] if "." in inner else inner


def parts(name: str) -> list[str]:
    """Return the lower-case words of a name: joint_Angles2 is joint, angles, 2."""
    spaced = re.sub(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])", "_", name)
    spaced = re.sub(r"(?<=[A-Za-z]{2})(?=\d)", "_", spaced)
    found = re.split(r"[^0-9a-zäöüß]+", spaced.lower())
    return [p.translate(UMLAUTS) for p in found if p]


def without_numbers(path: str) -> str:
    """Return a path with 1 for every subscript: all elements of an array are named alike."""
    return SUBSCRIPTS.sub(r"\g<1>1\2", path)


def describe(path: str) -> Name:
    """Return what the name of the variable at `path` says.

    Of a series such as q1..q6, or a list, the first name speaks.
    """
    return _describe(without_numbers(path))


@lru_cache(maxsize=4096)
def _describe(path: str) -> Name:
    first = re.split(r"\.\.|,(?![^(]*\))", path)[0].strip("[] ")
    series = first != path
    path = first
    name = re.sub(r"[({][^.]*$", "", leaf(path))
    said = parts(name)
    of_unit = _said_by_unit(said)
    if of_unit:
        return Name(Hint.AGAINST, of_unit)
    unit = ""
    if said and (DEGREE_PARTS.intersection(said) or said[-1].endswith(DEGREE_ENDINGS)):
        unit = "deg"
        stripped = [p for p in said if p not in DEGREE_PARTS]
        said = stripped or said
    whole = "".join(said)
    bare = whole.rstrip("0123456789") or whole
    if series and bare in NUMBERED_JOINTS:
        return Name(Hint.POSITIONS, "", unit)
    found = Name(*_said_by(bare, whole, [p.rstrip("0123456789") or p for p in said], said), unit)
    if found.hint is Hint.POSITIONS and len(said) > 1 and said[-1] == "rev":
        return Name(Hint.DOUBTFUL, "turns_or_reversed")
    if found.hint is Hint.POSITIONS:
        of_struct = _said_by_struct(path)
        if of_struct is not None and of_struct.what in OF_JOINTS:
            return Name(Hint.DOUBTFUL, of_struct.what)
    if found.hint in (Hint.NEUTRAL, Hint.TWO_FACED):
        of_struct = _said_by_struct(path)
        return found if of_struct is None else Name(of_struct.hint, of_struct.what, unit)
    return found


def _said_by_unit(said: list[str]) -> str:
    """Return the quantity of the unit that a name, as its words, ends in, or nothing."""
    rest = [p for p in said if p != "per"]
    for what, endings in UNIT_ENDINGS:
        for ending in map(str.split, endings):
            if len(rest) > len(ending) and rest[-len(ending) :] == ending:
                return what
    return ""


def _said_by_struct(path: str) -> Name | None:
    """Return what the struct says that a field such as pos or data lies in, or None.

    joints.pos are joint positions and tcp.pos is none. A letter alone says nothing.
    """
    outer = CONTAINER_TAIL.sub("", path).rpartition(".")[0]
    name = re.split(r"[.]", re.sub(r"[({][^.]*$", "", outer))[-1]
    if len(name) < 2 or name == path:
        return None
    said = describe(name)
    return said if said.hint in (Hint.POSITIONS, Hint.AGAINST) else None


def hint(path: str) -> Hint:
    """Return what the name of the variable at `path` says of joint positions."""
    return describe(path).hint


def _said_by(bare: str, whole: str, said: list[str], numbered: list[str]) -> tuple[Hint, str]:
    """Return the hint and the quantity of a name, given whole and as its words."""
    if bare in WHOLE_DOUBTFUL and len(said) == 1:
        return Hint.DOUBTFUL, WHOLE_DOUBTFUL[bare]
    if said[:1] == ["qd"]:
        return Hint.DOUBTFUL, "joint_velocities"
    if bare in POSITIONS:
        return Hint.POSITIONS, ""
    if len(bare) == 1 and bare != whole and bare in WHOLE_AGAINST[PARAMETERS]:
        return Hint.NEUTRAL, ""
    of_whole = next((what for what, names in WHOLE_AGAINST.items() if bare in names), "")
    if of_whole:
        return Hint.AGAINST, of_whole
    if whole == "t":
        return Hint.AGAINST, TIMES
    if said[:1] == ["i"] and len(said) > 1:
        return Hint.AGAINST, CURRENTS
    for prefix, what in AGAINST_PREFIXES:
        if whole.startswith(prefix):
            return Hint.AGAINST, what
    if whole.endswith("dot"):
        return Hint.AGAINST, VELOCITIES
    of_letter = _said_by_letter(bare, said)
    if of_letter is not None:
        return of_letter
    is_joint = bool(POSITION_PARTS.intersection(said))
    for what, names in AGAINST_PARTS.items():
        if names.intersection(said) or names.intersection(numbered[1:]):
            return Hint.AGAINST, what
    counted = [p for p in said if not p.isdigit()]
    if counted[-1:] == ["current"] and len(counted) > 1 and counted[0] not in ("q", "config"):
        # motor currents end in it, the present positions begin with it
        return Hint.AGAINST, CURRENTS
    for what, stems in AGAINST_STEMS.items():
        if any(stem in whole for stem in stems):
            return Hint.AGAINST, what
    if is_joint or any(stem in whole for stem in POSITION_STEMS):
        return Hint.POSITIONS, ""
    if bare in TWO_FACED or TWO_FACED_PARTS.intersection(said):
        return Hint.TWO_FACED, ""
    return Hint.NEUTRAL, ""


def _said_by_letter(bare: str, said: list[str]) -> tuple[Hint, str] | None:
    """Return what a letter or a dot beside a joint's symbol says: v_q, e_theta, thetaPunkt."""
    dotted = DOTTED.match(bare)
    if dotted is not None:
        return Hint.AGAINST, ACCELERATIONS if dotted["two"] else VELOCITIES
    said = [p for p in said if not p.isdigit()]
    if len(said) != 2:
        return None
    first, last = said
    if last == "tilde" or first == "tilde":
        return Hint.AGAINST, ERRORS
    if last in SYMBOLS and first in BEFORE_SYMBOL:
        return BEFORE_SYMBOL[first]
    if first in SYMBOLS and last == "v":
        return Hint.AGAINST, VELOCITIES
    return None
