"""Units as files spell them: the quantity that they measure and their factor to SI units."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache

ANGLES, LENGTHS, TIMES = "angles", "lengths", "times"
TURN = 2 * math.pi
DEGREE = math.pi / 180

# quantity: (name, factor to the SI unit, spellings); `,` between spellings
TABLE: dict[str, tuple[tuple[str, float, str], ...]] = {
    ANGLES: (
        (
            "rad",
            1.0,
            "rad,rads,radian,radians,radiant,radianten,radianes,radiani,radianos,bogenmass,"
            "bogenmaß,радиан,радианы,рад,弧度,ラジアン,라디안,radyan,radianen,radianti,radiany,hudu",
        ),
        (
            "deg",
            DEGREE,
            "deg,degs,degree,degrees,°,grad,grade,degre,degres,grado,grados,gradi,grau,graus,graden,"
            "graad,stopien,stopnie,stopni,derece,градус,градусы,град,度,도,altgrad,winkelgrad,"
            "gradmass,degr,stupne,grados sexagesimales,du",
        ),
        ("mrad", 1e-3, "mrad,mrads,milliradian,milliradians,milliradiant,miliradianes"),
        ("urad", 1e-6, "urad,µrad,microradian,microradians"),
        ("gon", math.pi / 200, "gon,gons,gradian,gradians,gradiant,neugrad,grads"),
        (
            "turn",
            TURN,
            "turn,turns,rev,revs,revolution,revolutions,u,umdr,umdrehung,umdrehungen,tour,tours,"
            "vuelta,vueltas,giro,giri,volta,voltas,omwenteling,obr,obrot,obroty,tur,r,cycles,quan,圈,回転,회전",
        ),
        (
            "halfturn",
            math.pi,
            "half turn,half turns,halfturn,halfturns,pi,*pi,pi rad,xpi,π,π rad,rad/pi,rad/π",
        ),
        ("ddeg", DEGREE / 10, "ddeg,decidegree,decidegrees"),
        (
            "cdeg",
            DEGREE / 100,
            "cdeg,centideg,centidegree,centidegrees",
        ),
        (
            "mdeg",
            DEGREE / 1000,
            "mdeg,millideg,millidegree,millidegrees",
        ),
        ("arcmin", DEGREE / 60, "arcmin,arcminute,arcminutes,winkelminuten"),
        ("arcsec", DEGREE / 3600, "arcsec,arcsecond,arcseconds,winkelsekunden"),
        (
            "counts",
            0.0,
            "count,counts,cnt,cnts,inc,incs,increments,inkremente,impulse,pulses,ticks,"
            "encoder counts,lsb,digits",
        ),
    ),
    "velocities": (
        (
            "rad/s",
            1.0,
            "rad/s,rads/s,radian/s,radians/s,rad/sec,rads/sec,radps,1/s,s-1,rad*s-1,rad s-1,"
            "radians per second",
        ),
        (
            "deg/s",
            DEGREE,
            "deg/s,degs/s,°/s,grad/s,degree/s,degrees/s,deg/sec,grad/sec,degps,dps,"
            "degrees per second,gradi/s,grados/s",
        ),
        ("rpm", TURN / 60, "rpm,u/min,1/min,min-1,rev/min,tr/min,r/min,giri/min,umin"),
        ("rev/s", TURN, "rev/s,turns/s,u/s,turn/s,tr/s"),
        ("mrad/s", 1e-3, "mrad/s"),
        ("m/s", 1.0, "m/s,mm/s,cm/s,m/sec,mm/sec,km/h,m/min"),
        ("counts/s", 0.0, "counts/s,ticks/s,inc/s"),
    ),
    "accelerations": (
        (
            "rad/s^2",
            1.0,
            "rad/s2,rad/s/s,rad/sec2,rad*s-2,deg/s2,deg/s/s,°/s2,grad/s2,deg/sec2,m/s2,mm/s2,"
            "m/s/s,1/s2",
        ),
    ),
    "jerks": (("rad/s^3", 1.0, "rad/s3,deg/s3,°/s3,m/s3,grad/s3"),),
    "torques": (
        (
            "Nm",
            1.0,
            "nm,n*m,n m,n-m,ncm,mnm,knm,kn,n,newton,newtonmeter,newton meter,newton-meter,"
            "ft lb,lbf ft,kgf cm",
        ),
    ),
    "currents": (("A", 1.0, "a,ma,amp,amps,ampere,amperes,milliampere"),),
    "voltages": (("V", 1.0, "v,mv,volt,volts"),),
    "temperatures": (("C", 1.0, "°c,degc,k,celsius,kelvin,°f"),),
    LENGTHS: (
        ("m", 1.0, "m,meter,meters,metre,metres,metros,metri"),
        ("mm", 1e-3, "mm,millimeter,millimeters,millimetre,millimetres,milimetros,millimetri"),
        ("cm", 1e-2, "cm,centimeter,centimeters"),
        ("inch", 0.0254, "inch,inches,in"),
    ),
    TIMES: (
        (
            "s",
            1.0,
            "s,sec,secs,second,seconds,sek,sekunde,sekunden,seconde,secondes,segundo,segundos,"
            "secondo,secondi,seg,miao,byou,秒",
        ),
        (
            "ms",
            1e-3,
            "ms,msec,msecs,millis,millisec,millisecond,milliseconds,millisekunde,millisekunden,"
            "milliseconde,millisecondes,milisegundo,milisegundos,milissegundo,milissegundos,"
            "millisecondo,millisecondi,haomiao,毫秒",
        ),
        ("us", 1e-6, "us,µs,usec,usecs,micros,microsec,microsecond,microseconds,mikrosekunden"),
        ("ns", 1e-9, "ns,nsec,nsecs,nanos,nanosec,nanosecond,nanoseconds,nanosekunden"),
        ("min", 60.0, "min,mins,minute,minutes,minuten,minuto,minutos,minuti,fenzhong,分,分钟"),
        ("h", 3600.0, "h,hr,hrs,hour,hours,std,stunden,heures,horas,ore"),
        ("days", 86_400.0, "day,days,tage,datenum,jours,dias,giorni"),
    ),
    "rates": (
        ("Hz", 1.0, "hz,hertz,赫兹,fps,sps,samples/s,frames/s,1/sec"),
        ("kHz", 1e3, "khz,kilohertz"),
    ),
    "shares": (
        ("%", 0.01, "%,percent,prozent,pourcent,por ciento"),
        ("normalized", 0.0, "normalized,normalised,normiert,norm,0..1,-1..1"),
    ),
    "none": (("", 0.0, "-,1,none,unitless,ohne,dimensionless,bool"),),
}
REPLACED = (
    ("²", "2"), ("³", "3"), ("^", ""), ("**", ""), ("·", "*"), ("⋅", "*"), ("º", "°"), ("\\", ""),
    ("\u03bc", "\u00b5"), ("⁻¹", "-1"), ("é", "e"), ("è", "e"), ("ê", "e"), (" per ", "/"),
)  # fmt: skip
# words of a tenth, a hundredth and a thousandth begin so, in seven languages
PARTS = {
    "tenth": 0.1, "zehntel": 0.1, "dixieme": 0.1, "decim": 0.1,
    "hundredth": 0.01, "hundertstel": 0.01, "centie": 0.01, "centes": 0.01,
    "thousandth": 0.001, "tausendstel": 0.001, "millie": 0.001, "miles": 0.001, "milles": 0.001,
}  # fmt: skip
UNIT = r"(?P<unit>[^\W\d_]+|°)"
PART = re.compile(
    rf"(?P<part>{'|'.join(PARTS)})[a-z]{{0,4}}?\s*(?:of an? |de |di |d'|degli |dei )?{UNIT}"
)
MULTIPLE = re.compile(rf"(?:1/(?P<divisor>10+)|(?P<number>0[.,]0*1|10+))\s*\*?{UNIT}")
BRACKETS = re.compile(r"[\[(<{]\s*([^\[\](){}<>]{1,24}?)\s*[\])>}]")


@dataclass(frozen=True)
class Unit:
    """A unit. quantity: a key of TABLE; factor: to rad, m, s and so on; 0 where it has none."""

    name: str
    quantity: str
    factor: float

    @property
    def is_angle(self) -> bool:
        return self.quantity == ANGLES


RADIANS = Unit("rad", ANGLES, 1.0)
DEGREES = Unit("deg", ANGLES, DEGREE)


@cache
def _spellings() -> dict[str, Unit]:
    return {
        spelling: Unit(name, quantity, factor)
        for quantity, units in TABLE.items()
        for name, factor, spellings in units
        for spelling in spellings.split(",")
    }


def spellings(quantity: str) -> dict[str, frozenset[str]]:
    """Return how the units of a quantity are spelled, by their names."""
    return {name: frozenset(texts.split(",")) for name, _, texts in TABLE[quantity]}


def plain(text: str) -> str:
    """Return a unit as the table spells it: small letters, no brackets, powers as digits."""
    found = text.strip().strip("[](){}<>'\"").strip().lower()
    for old, new in REPLACED:
        found = found.replace(old, new)
    return re.sub(r"\s*([/*])\s*", r"\1", re.sub(r"\s+", " ", found)).rstrip(".")


def parse(text: str) -> Unit | None:
    """Return the unit that a text spells, None where it spells none that is known."""
    table = _spellings()
    spelled = plain(text)
    found = table.get(spelled)
    if found is None and text.strip() == "Grads":
        return DEGREES
    spelled = spelled.removeprefix("in ").strip()
    return found or table.get(spelled) or _multiple(spelled)


@cache
def _multiple(spelled: str) -> Unit | None:
    """Return the unit of angles that is a tenth of a degree, 0.01 deg and the like."""
    if match := MULTIPLE.fullmatch(spelled):
        number = match["number"]
        factor = float(number.replace(",", ".")) if number else 1 / float(match["divisor"])
    elif match := PART.fullmatch(spelled):
        factor = PARTS[match["part"]]
    else:
        return None
    of = _spellings().get(match["unit"])
    wanted = factor * of.factor if of is not None and of.is_angle else 0.0
    known = (u for u in _spellings().values() if u.is_angle and u.factor)
    return next((u for u in known if wanted and abs(u.factor / wanted - 1) < 1e-9), None)


def named(name: str) -> Unit | None:
    """Return the unit with a name of the table."""
    return next((u for u in _spellings().values() if u.name == name), None)


def in_brackets(text: str) -> Unit | None:
    """Return the unit that stands in brackets in a text, such as that of `q (deg)`."""
    for match in reversed(list(BRACKETS.finditer(text))):
        found = parse(match[1])
        if found is not None and not match[1].isdigit():
            return found
    return None


def foreign(text: str) -> str:
    """Return the quantity of a unit that joint positions do not have, or empty."""
    found = parse(text)
    if found is None or found.quantity in (ANGLES, TIMES, "rates", "shares", "none"):
        return "turns" if found is not None and found.name == "turn" else ""
    return "poses" if found.quantity == LENGTHS else found.quantity
