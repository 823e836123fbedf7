"""Statements of IFC4X1, IFC4X2 and release candidates of IFC4X3, written as IFC4X3 has them.

Until IFC4X2 alignments had classes of their own, and what stands along them a distance in place of a placement. They
are translated statement by statement in the text of the file, so that all that reads IFC4X3 reads them, too.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

_OF_CURVES = (
    *("IFCALIGNMENT2DHORIZONTAL", "IFCALIGNMENT2DHORIZONTALSEGMENT", "IFCALIGNMENT2DVERTICAL"),
    *("IFCLINESEGMENT2D", "IFCCIRCULARARCSEGMENT2D", "IFCTRANSITIONCURVESEGMENT2D"),
    *("IFCALIGNMENT2DVERSEGLINE", "IFCALIGNMENT2DVERSEGCIRCULARARC", "IFCALIGNMENT2DVERSEGPARABOLICARC"),
)
"""Classes of which IfcAlignmentCurve is made, and which go with it."""

_NAMES = (
    *_OF_CURVES,
    *(
        "IFCALIGNMENTCURVE",
        "IFCDISTANCEEXPRESSION",
        "IFCSECTIONEDSOLIDHORIZONTAL",
        "IFCLINEARPLACEMENT",
        "IFCPROXY",
        "IFCALIGNMENT",
    ),
    *("IFCREFERENT", "IFCBRIDGEPART", "IFCFACILITYPART", "IFCDIRECTION", "IFCCARTESIANPOINT"),
)

_STATEMENT = re.compile(
    rb"#(\d+)\s*=\s*(" + "|".join(_NAMES).encode() + rb")\s*\(((?:'[^']*'|[^';])*)\)\s*;", flags=re.IGNORECASE
)
_NUMBER = re.compile(rb"#(\d+)\s*=")
_BRIDGE_PART = re.compile(r"IFCBRIDGEPARTTYPEENUM\s*\((.*)\)", flags=re.IGNORECASE)
_STRATUM = re.compile(rb"IFC(?:SOLID|VOID|WATER)STRATUM\s*\((.*?)\)\s*;", flags=re.IGNORECASE | re.DOTALL)
"""Strata as release candidates have them, of classes of their own and without a predefined type."""

_DEGREES = re.compile(rb"\.PLANEANGLEUNIT\.\s*,\s*'DEG", flags=re.IGNORECASE)
"""A unit of angles that is no radian."""

_END = b"ENDSEC;"
_NONE = "$"
_STRAIGHT = 1e-12

_COUNTS = {"IFCALIGNMENT": 8, "IFCREFERENT": 8}
"""How many attributes a class has in IFC4X3, of which it had one more before, behind or before the last."""


@dataclass(slots=True)
class _Statements:
    """Statements of a file by their numbers, as class and attributes, and those that are written in their place."""

    read: Mapping[int, tuple[str, list[str]]]
    highest: int
    angle_rad: float
    written: dict[int, str] = field(default_factory=dict)
    added: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def add(self, text: str) -> str:
        """Add a statement, and return the reference to it."""
        self.highest += 1
        self.added.append(f"#{self.highest}={text};")
        return f"#{self.highest}"

    def of(self, reference: str, *names: str) -> tuple[str, list[str]]:
        """Return what a reference leads to, one of some classes; a `LookupError` where it does not."""
        name, values = self.read[int(reference.removeprefix("#"))]
        if names and name not in names:
            raise LookupError(f"{reference} is no {names[0]}")
        return name, values


def translated(content: bytes) -> tuple[bytes, tuple[str, ...]]:
    """Return a file of a schema between IFC4 and IFC4X3 with the statements of IFC4X3, and what was assumed.

    What contradicts its own schema is left as it is.
    """
    content = _STRATUM.sub(rb"IFCGEOTECHNICALSTRATUM(\1,$);", content)
    read = {
        int(number): (name.decode().upper(), _attributes(values.decode("latin-1")))
        for number, name, values in _STATEMENT.findall(content)
    }
    end = content.rfind(_END)
    if not read or end < 0:
        return content, ()
    angle_rad = math.radians(1.0) if _DEGREES.search(content) else 1.0
    statements = _Statements(read, max(int(number) for number in _NUMBER.findall(content)), angle_rad)
    for number, (name, values) in read.items():
        if write := _TRANSLATIONS.get(name):
            try:
                text = write(statements, values)
            except (LookupError, ValueError):  # what it needs is not there; the class is said to be lost
                continue
            statements.written[number] = text
    curves = {number for number, (name, _) in read.items() if name == "IFCALIGNMENTCURVE"}

    def replaced(match: re.Match[bytes]) -> bytes:
        if match.group(2).decode().upper() in _OF_CURVES and curves <= statements.written.keys():
            return b""
        text = statements.written.get(int(match.group(1)))
        return match.group() if text is None else b"#%s=%s;" % (match.group(1), text.encode("latin-1"))

    head, tail = _STATEMENT.sub(replaced, content[:end]), content[end:]
    added = "\n".join([*statements.added, ""]).encode("latin-1")
    return head + added + tail, tuple(dict.fromkeys(statements.notes))


def _attributes(text: str) -> list[str]:
    """Return the attributes of a statement as they are written."""
    values, start, depth, in_text = [], 0, 0, False
    for at, sign in enumerate(text):
        if sign == "'":
            in_text = not in_text
        elif not in_text and sign in "()":
            depth += 1 if sign == "(" else -1
        elif not in_text and not depth and sign == ",":
            values.append(text[start:at].strip())
            start = at + 1
    return [*values, text[start:].strip()]


def _listed(text: str) -> list[str]:
    """Return the members of a list."""
    if not (text.startswith("(") and text.endswith(")")):
        raise ValueError(f"{text} is no list")
    return _attributes(text[1:-1])


def _number(text: str) -> float:
    inner = text[text.find("(") + 1 : -1] if text.endswith(")") else text
    return float(inner)


def _pair(statements: _Statements, reference: str) -> tuple[float, float]:
    """Return the first two coordinates of a point."""
    x, y = _listed(statements.of(reference, "IFCCARTESIANPOINT")[1][0])[:2]
    return _number(x), _number(y)


def _is_true(text: str) -> bool:
    return text.upper() == ".T."


def _curve(statements: _Statements, values: list[str]) -> str:
    plan, heights = values[:2]
    parts = _plan_segments(statements, plan)
    composite = f"IFCCOMPOSITECURVE(({','.join(parts)}),.F.)"
    if heights == _NONE:
        return composite
    profile = _vertical_segments(statements, heights)
    return f"IFCGRADIENTCURVE(({','.join(profile)}),.F.,{statements.add(composite)},$)"


def _plan_segments(statements: _Statements, plan: str) -> list[str]:
    start, segments = statements.of(plan, "IFCALIGNMENT2DHORIZONTAL")[1][:2]
    if start != _NONE and _number(start):
        raise ValueError("distances along it do not begin at 0")
    made = []
    for reference in _listed(segments):
        name, values = statements.of(statements.of(reference, "IFCALIGNMENT2DHORIZONTALSEGMENT")[1][3])
        (x, y), way, long = _pair(statements, values[0]), _number(values[1]) * statements.angle_rad, _number(values[2])
        first, signed, parent = _parent(statements, name, values[3:], long)
        made.append(_segment(statements, (x, y), (math.cos(way), math.sin(way)), first, signed, parent))
    return made


def _parent(statements: _Statements, name: str, more: list[str], long: float) -> tuple[float, float, str]:
    """Return where a segment begins on its parent curve, its signed length, and that curve, as written."""
    if name == "IFCLINESEGMENT2D":
        return 0.0, long, _line(statements)
    if name == "IFCCIRCULARARCSEGMENT2D":
        return 0.0, long if _is_true(more[1]) else -long, f"IFCCIRCLE({_origin(statements)},{more[0]})"
    if name != "IFCTRANSITIONCURVESEGMENT2D":
        raise LookupError(f"{name} is no segment of a plan")
    if "CLOTHOID" not in more[4].upper():
        statements.notes.append("transition curves of its alignments are taken for clothoids")
    bends = [
        0.0 if radius == _NONE or not _number(radius) else math.copysign(1.0 / _number(radius), _is_true(is_left) - 0.5)
        for radius, is_left in ((more[0], more[2]), (more[1], more[3]))
    ]
    rate = (bends[1] - bends[0]) / long
    if abs(rate) * long * long < _STRAIGHT:
        return 0.0, long, _line(statements)
    constant = math.copysign(1.0 / math.sqrt(abs(rate)), rate)
    return bends[0] / rate, long, f"IFCCLOTHOID({_origin(statements)},{constant!r})"


def _vertical_segments(statements: _Statements, heights: str) -> list[str]:
    rows = [statements.of(part) for part in _listed(statements.of(heights, "IFCALIGNMENT2DVERTICAL")[1][0])]
    ends: list[float | None] = [_number(after[5]) for _, (_, after) in pairwise(rows)]
    made = []
    for (name, values), end in zip(rows, [*ends, None], strict=True):
        start, long, height, gradient = (_number(value) for value in values[3:7])
        way = _way(gradient)
        if name == "IFCALIGNMENT2DVERSEGLINE":
            signed, parent = long, _line(statements)
        elif name == "IFCALIGNMENT2DVERSEGCIRCULARARC":
            up = _turns_up(values[8], height + gradient * long, end)
            signed, parent = up * long, f"IFCCIRCLE({_origin(statements)},{values[7]})"
        elif name == "IFCALIGNMENT2DVERSEGPARABOLICARC":
            up = _turns_up(values[8], height + gradient * long, end)
            bend = up / (2.0 * _number(values[7]))
            parent = f"IFCPOLYNOMIALCURVE({_origin(statements)},(0.,1.),(0.,0.,{bend!r}),$)"
            signed = long
        else:
            raise LookupError(f"{name} is no segment of heights")
        made.append(_segment(statements, (start, height), way, 0.0, signed, parent))
    return made


def _way(gradient: float) -> tuple[float, float]:
    """Return the direction of a gradient, of length 1."""
    size = math.sqrt(1.0 + gradient * gradient)
    return 1.0 / size, gradient / size


def _turns_up(is_convex: str, straight: float, end: float | None) -> float:
    """Return 1 where a curve of heights ends above its first tangent, and -1 where below.

    Where the next segment begins says it best: programs differ in what they call convex. By the schema it is a crest.
    """
    if end is None or end == straight:
        return -1.0 if _is_true(is_convex) else 1.0
    return math.copysign(1.0, end - straight)


def _segment(
    statements: _Statements,
    point: tuple[float, float],
    way: tuple[float, float],
    first: float,
    signed: float,
    parent: str,
) -> str:
    location = statements.add(f"IFCCARTESIANPOINT(({point[0]!r},{point[1]!r}))")
    direction = statements.add(f"IFCDIRECTION(({way[0]!r},{way[1]!r}))")
    placement = statements.add(f"IFCAXIS2PLACEMENT2D({location},{direction})")
    curve = statements.add(parent)
    lengths = f"IFCLENGTHMEASURE({first!r}),IFCLENGTHMEASURE({signed!r})"
    return statements.add(f"IFCCURVESEGMENT(.CONTINUOUS.,{placement},{lengths},{curve})")


def _origin(statements: _Statements) -> str:
    point = statements.add("IFCCARTESIANPOINT((0.,0.))")
    return statements.add(f"IFCAXIS2PLACEMENT2D({point},$)")


def _line(statements: _Statements) -> str:
    point = statements.add("IFCCARTESIANPOINT((0.,0.))")
    direction = statements.add("IFCDIRECTION((1.,0.))")
    vector = statements.add(f"IFCVECTOR({direction},1.)")
    return f"IFCLINE({point},{vector})"


def _distance(_: _Statements, values: list[str]) -> str:
    along, *offsets = values[:4]
    return f"IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE({_number(along)!r}),{','.join(offsets)},$)"


def _along(statements: _Statements, reference: str) -> str:
    """Return the placement at a distance, which an IFC4X3 file has in place of the distance."""
    statements.of(reference, "IFCDISTANCEEXPRESSION")
    return statements.add(f"IFCAXIS2PLACEMENTLINEAR({reference},$,$)")


def _solid(statements: _Statements, values: list[str]) -> str:
    curve, sections, places = values[:3]
    at = ",".join(_along(statements, place) for place in _listed(places))
    return f"IFCSECTIONEDSOLIDHORIZONTAL({curve},{sections},({at}))"


def _placement(statements: _Statements, values: list[str]) -> str:
    within, (curve, place, turned, plain) = (_NONE, values) if len(values) == 4 else (values[0], values[1:])
    distance = statements.of(place, "IFCDISTANCEEXPRESSION")[1]
    point = _distance(statements, distance).removesuffix("$)") + f"{curve})"
    if turned != _NONE:
        statements.notes.append("what stands along an alignment is upright and along it, whatever its own orientation")
    at = statements.add(f"IFCAXIS2PLACEMENTLINEAR({statements.add(point)},$,$)")
    return f"IFCLINEARPLACEMENT({within},{at},{plain})"


def _proxy(_: _Statements, values: list[str]) -> str:
    return f"IFCBUILDINGELEMENTPROXY({','.join(values[:7])},{values[8]},$)"


def _shortened(name: str) -> Callable[[_Statements, list[str]], str]:
    def write(_: _Statements, values: list[str]) -> str:
        most = _COUNTS[name]
        last = values[-1:] if name == "IFCALIGNMENT" else values[7:8]
        return f"{name}({','.join([*values[:7], *last] if len(values) > most else values)})"

    return write


def _bridge_part(_: _Statements, values: list[str]) -> str:
    if len(values) == 10:  # IFC4X2 has no usage
        values = [*values[:9], _NONE, values[9]]
    return f"IFCBRIDGEPART({','.join(values)})"


def _facility_part(_: _Statements, values: list[str]) -> str:
    """Write a part of a release candidate as a part of any facility, with its type in one of its attributes."""
    kind = _BRIDGE_PART.fullmatch(values[9]) if len(values) == 11 else None
    if kind is None:
        return f"IFCFACILITYPART({','.join(values)})"
    return f"IFCBRIDGEPART({','.join([*values[:9], values[10], kind.group(1)])})"


_TRANSLATIONS: dict[str, Callable[[_Statements, list[str]], str]] = {
    "IFCALIGNMENTCURVE": _curve,
    "IFCDISTANCEEXPRESSION": _distance,
    "IFCSECTIONEDSOLIDHORIZONTAL": _solid,
    "IFCLINEARPLACEMENT": _placement,
    "IFCPROXY": _proxy,
    "IFCALIGNMENT": _shortened("IFCALIGNMENT"),
    "IFCREFERENT": _shortened("IFCREFERENT"),
    "IFCBRIDGEPART": _bridge_part,
    "IFCFACILITYPART": _facility_part,
}
