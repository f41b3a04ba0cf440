"""Numbers of a workspace that say how fast a matrix is: rates, steps and durations, by name."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.conversion.evidence import rate_sentences, statements
from mrlab_ros.core.conversion.evidence.glossary import FOREIGN, Class
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.names import (
    described,
    leaf,
    parts,
    vocabulary,
    word_of,
    words,
    words_in,
)
from mrlab_ros.core.conversion.evidence.time_vectors import (
    LEAST_RATE,
    MOST_RATE,
    UNIT_WORDS,
    snapped,
    unit_named,
)
from mrlab_ros.core.conversion.workspace import Workspace

RATE_NAMES = words(
    "fs framerate samplerate samplingrate samplefrequency samplingfrequency samplefreq hz fps "
    "fsample fsampling abtastrate abtastfrequenz bildrate controlrate controlfrequency looprate "
    "updaterate ratehz freqhz fshz samplespersecond abtastungen recordrate recordingrate "
    "recordingfrequency publishrate rosrate framespersecond"
)
STEP_NAMES = words(
    "dt ts deltat tstep timestep sampletime samplingtime sampleperiod samplingperiod steptime "
    "tsample tsampling abtastzeit abtastintervall abtastperiode zeitschritt dtime deltatime "
    "controlperiod cycletime zykluszeit sampleinterval tcycle takt takzeit taktzeit dts tabtast"
)
OF_RECORDS = (Class.SAMPLING, Class.KEPT, Class.ROLE)
# These are also frequencies of sines, heights, counts and durations: they need a likely value.
UNSURE_RATES = words("f freq frequency frequenz rate samples")
UNSURE_STEPS = words("h step stepsize schrittweite t tau period periode")
LIKELY_RATES = (20.0, 2000.0)  # Hz
LIKELY_STEPS = (5e-4, 0.05)  # s
DURATION_NAMES = words(
    "tf tfinal tend duration dauer totaltime ttotal ttot tmax movetime gesamtzeit endzeit simtime "
    "stoptime tstop tges motiontime t"
)
SPANS = words("tspan timespan tintervall zeitbereich")
LIKELY_OF_DURATION = (5.0, 1000.0)  # Hz
OF_RATES = (
    Class.CLOCK, Class.PERIOD, Class.RATE, Class.SAMPLING, Class.KEPT, Class.ROLE, Class.ARM,
    Class.SYMBOL, Class.JOINT,
)  # fmt: skip
SETTLED = (Class.TABLE, Class.GEAR, Class.GRIPPER, Class.UNIT_FLAG)
OF_TIMES = (Class.CLOCK, Class.PERIOD, Class.RATE, Class.SAMPLING, Class.DURATION)
THINNED = words(
    "skip downsample downsampled downsampling decimate decimation stride subsample subsampling "
    "unterabtastung sousechantillonnage submuestreo sottocampionamento subamostragem"
)
FOREIGN_ROWS = 20  # of data beside a rate that have their own number of rows
# an entry of a containers.Map or of a dictionary
KEY = re.compile(r"""\('([^']+)'\)$|\{"([^"]+)"\}$""")


@dataclass(frozen=True)
class Scalar:
    """A number of the file that may be the rate.

    sure: its name means nothing else. foreign: it lies beside other data.
    """

    path: str
    rate: float
    sure: bool
    foreign: bool = False


def scalars(workspace: Workspace, path: str, rows: int, coarse: bool) -> list[Scalar]:
    """Return the numbers that are named like a rate or a step, those beside the matrix first.

    coarse: the rows are waypoints, between which seconds may pass.
    """
    near = first_path(path).rpartition(".")[0]
    found: list[tuple[bool, bool, Scalar]] = []
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = scalar_name(v.path)
        if number is None or not np.isfinite(number) or number <= 0 or not name:
            continue
        said = parts(name)
        unit = unit_named(name)
        whole = re.sub(r"[^a-z]", "", "".join(said))
        stepped = whole[: -len(said[-1])] if unit and len(said) > 1 else whole
        step = number * {"ms": 1e-3, "us": 1e-6, "ns": 1e-9}.get(unit, 1.0)
        rate: float | None = 0.0
        sure = True
        if whole in RATE_NAMES:
            rate = number
        elif whole in STEP_NAMES or stepped in STEP_NAMES:
            rate = 1 / step
            if not unit and rate < 1 and not (coarse and rate >= LEAST_RATE):
                # 8 is 8 ms rather than 8 s
                rate, sure = (1e3 / step, False) if step <= 100 else (0.0, False)
        elif whole in UNSURE_RATES and number != rows:
            rate, sure = number, False
        elif whole in UNSURE_STEPS:
            likely = LIKELY_STEPS[0] <= step <= LIKELY_STEPS[1]
            rate, sure = (1 / step if likely else 0.0), False
        else:
            rate, sure = _by_words(name, number, unit, rows)
            if rate is None:
                continue
        if sure and not ((LEAST_RATE if coarse else 1.0) <= rate <= MOST_RATE):
            rate, sure = 0.0, False
        if rate and not LEAST_RATE <= rate <= MOST_RATE:
            rate = 0.0
        foreign = bool(FOREIGN & set(said))
        foreign = foreign or (sure and _is_foreign(workspace, v.path, near, rows))
        sure = sure and not foreign
        scalar = Scalar(v.path, snapped(rate) if rate else 0.0, sure, foreign)
        found.append((not sure, v.path.rpartition(".")[0] != near, scalar))
    if path:
        found += [(False, False, s) for s in in_texts(workspace, path) if s.sure]
    found.sort(key=lambda item: item[:2])
    return [scalar for _, _, scalar in found]


def sure_rates(workspace: Workspace) -> tuple[float, ...]:
    """Return the rates, Hz, that numbers at the top of a workspace say for certain."""
    found = scalars(workspace, "", 0, coarse=False)
    return tuple(s.rate for s in found if s.sure and s.rate and "." not in s.path)


def _by_words(name: str, number: float, unit: str, rows: int) -> tuple[float | None, bool]:
    """Return the rate that the words of a name make of a number, 0 for none, and if it is sure.

    None where the name says neither a rate nor a step. Words of sampling beside it make it sure,
    unread ones and those of something else do not.
    """
    if spoken := rate_sentences.rate_in(f"{number!r} {' '.join(parts(name))}"):
        return spoken.rate, spoken.sure
    whole = "".join(parts(name))
    said = [word_of(whole)] if whole in vocabulary() else described(name)
    if whole[:1] in ("f", "t") and all(w.can_be(Class.SAMPLING) for w in words_in(whole[1:])):
        said = [word_of({"f": "freq", "t": "dt"}[whole[0]])]  # f_ech, T_cycle
    times = words(" ".join(UNIT_WORDS["ms"] | UNIT_WORDS["us"] | UNIT_WORDS["ns"]))
    said = [w for w in said if w.text not in times or w is said[0]]
    if not said or number == rows:
        return None, False
    known = all(w.can_be(*OF_RATES) for w in said)
    stepped = any(w.can_be(Class.PERIOD) for w in said[:1]) and any(
        w.can_be(Class.CLOCK) and len(w.text) > 1 for w in said[1:]
    )
    sampled = any(w.can_be(Class.SAMPLING) for w in said)
    beside = known and len(said) > 1 and (sampled or stepped)
    if any(w.text in ("hz", "khz") for w in said):
        return number * (1e3 if said[-1].text == "khz" else 1.0), known
    if not known and any(w.quantity or w.can_be(*SETTLED) for w in said):
        return None, False
    # a name that says nothing but a rate or a step, with a number that such have
    alone = len(whole) > 1 and whole not in UNSURE_RATES | UNSURE_STEPS
    if any(w.can_be(Class.RATE) and (known or len(w.text) > 1) for w in said):
        known_words = all(w.can_be(Class.RATE, *OF_RECORDS) for w in said)
        alone = alone and known_words and _is_usual(number)
        return number, beside or alone
    step = number * {"ms": 1e-3, "us": 1e-6, "ns": 1e-9}.get(unit, 1.0)
    likely = LIKELY_STEPS[0] <= step <= LIKELY_STEPS[1]
    period = any(w.can_be(Class.PERIOD) and (known or len(w.text) > 1) for w in said)
    if period or (beside and any(w.can_be(Class.CLOCK) for w in said)):
        if known and (unit or beside):
            return 1 / step, beside
        alone = alone and all(w.can_be(Class.PERIOD) for w in said) and _is_usual(1 / step)
        return (1 / step if likely else 0.0), alone
    return (1 / step, False) if unit and likely and len(parts(name)) > 1 else (None, False)


def _is_usual(rate: float) -> bool:
    """Say whether a rate, Hz, is one that people choose: 50, 125, 200."""
    least, most = LIKELY_RATES
    return least <= rate <= most and abs(rate / 5 - round(rate / 5)) < 1e-6 * rate


@dataclass(frozen=True)
class Thinning:
    """A number that says which rows of a recording were kept. skipped: a step of a simulation."""

    path: str
    every: float
    skipped: bool


def thinning(workspace: Workspace, path: str) -> Thinning | None:
    """Return what the file says of rows that were left out, such as downsample_factor = 10."""
    for s in statements.about(workspace, first_path(path)):
        number = workspace.scalar(s.variable)
        said = THINNED & {w.text for w in s.words}
        if said and number is not None and 2 <= number <= MOST_RATE and number % 1 == 0:
            return Thinning(s.path, number, said <= {"skip"})
    return None


def in_texts(workspace: Workspace, path: str) -> list[Scalar]:
    """Return the rates that texts near the matrix say, such as 'recorded at 250 Hz'."""
    return [
        Scalar(s.path, snapped(stated.rate), stated.sure)
        for s in statements.about(workspace, first_path(path))
        if s.text and s.near <= 2 and (stated := rate_sentences.rate_in(s.text))
    ]


def of_duration(workspace: Workspace, path: str, rows: int) -> Scalar | None:
    """Return the rate that follows from a duration, where it comes out as a usual one."""
    near = first_path(path).rpartition(".")[0]
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = scalar_name(v.path)
        if number is None and name and v.values is not None and v.values.size == 2:
            # from the begin to the end, as ode45 takes it
            begin, end = (float(x) for x in v.values.reshape(-1))
            number = end - begin if "".join(parts(name)) in SPANS else None
        if number is None or not np.isfinite(number) or number <= 0 or not name:
            continue
        said = "".join(parts(name))
        words_of = described(name)
        by_words = any(w.can_be(Class.DURATION) and len(w.text) > 2 for w in words_of) and not any(
            w.quantity for w in words_of
        )
        if not (by_words or said in DURATION_NAMES | SPANS) or not _is_near(v.path, near):
            continue
        # T may be anything: it counts where it is the time of the last row, as in 0:dt:T
        for steps in (rows - 1,) if said == "t" else (rows - 1, rows):
            rate = steps / number
            if (
                LIKELY_OF_DURATION[0] <= rate <= LIKELY_OF_DURATION[1]
                and abs(rate - round(rate)) <= 1e-6 * rate
            ):
                return Scalar(v.path, float(round(rate)), sure=False)
    return None


def scalar_name(path: str) -> str:
    """Return the name of a number, such as fs of `m('fs')`; empty for an element of a list."""
    key = KEY.search(path)
    outer = path[: key.start()] if key else path
    if re.search(r"[({]", outer):
        return ""
    return key[1] or key[2] if key else leaf(path)


def _is_foreign(workspace: Workspace, path: str, near: str, rows: int) -> bool:
    """Say whether the number at `path` belongs to other data: those beside it, or a controller.

    near: the structure that holds the matrix. The data beside it have another number of rows.
    """
    container = path.rpartition(".")[0]
    if not container or f"{near}.".startswith(f"{container}."):
        return False
    if set(parts(leaf(container))) & FOREIGN:
        return True
    sizes = [
        max(v.shape)
        for v in workspace.variables
        if v.shape
        and not v.text
        and v.path.startswith(f"{container}.")
        and max(v.shape) >= FOREIGN_ROWS
    ]
    return bool(sizes) and rows not in sizes


def _is_near(path: str, container: str) -> bool:
    return path.rpartition(".")[0] in ("", container)
