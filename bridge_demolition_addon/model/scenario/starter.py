"""A scenario to start from: commented, by six answers, with a bridge that has bars and bearings, and stands."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass

from ...engineering.arithmetic import cosine, sine
from ...errors import ScenarioError

_THICKNESS_OVER_SPAN = 1.0 / 16.0
"""Of slabs without prestress: about 1/15 to 1/20."""

_LEAST_THICKNESS_M = 0.5
_SHARDS_OF_A_SPAN = 80
_HAUNCH_OVER_SPAN = 0.25


@dataclass(frozen=True, slots=True, kw_only=True)
class Answers:
    """What `bda new` asks: the bridge in five answers, and what is done to it; and what options add to it."""

    title: str = "My bridge"
    spans_m: tuple[float, ...] = (15.0, 15.0)
    width_m: float = 8.0
    thickness_m: float | None = None  # None for one that suits the longest span
    height_m: float = 5.0  # of the piers
    by: str = "removal"
    grade_percent: float | None = None
    crossfall_percent: float | None = None
    radius_m: float | None = None
    haunch_m: float | None = None
    section: str = "slab"
    piers: str = "wall"

    @property
    def slab_m(self) -> float:
        """Thickness of the slab, m, on whole centimetres."""
        if self.thickness_m is not None:
            return self.thickness_m
        if self.section in _BELOW_SLAB:
            return _SLAB_ON_WEBS_M
        return max(_LEAST_THICKNESS_M, round(_THICKNESS_OVER_SPAN * max(self.spans_m), 2))

    def place_m(self, along_m: float) -> tuple[float, float]:
        """Return where the middle of the road is in plan, at a position along it."""
        if self.radius_m is None:
            return along_m, 0.0
        turn = along_m / self.radius_m
        return self.radius_m * float(sine(turn)), self.radius_m * (1.0 - float(cosine(turn)))


def starter_text(answers: Answers) -> str:
    """Return a scenario file, with comments that say what to change."""
    if answers.by not in METHODS:
        raise ScenarioError(f"--by is {json.dumps(answers.by)}: expected one of {', '.join(METHODS)}")
    for name, known in (("section", SECTIONS), ("piers", PIERS)):
        if (value := getattr(answers, name)) not in known:
            raise ScenarioError(f"--{name} is {json.dumps(value)}: expected one of {', '.join(known)}")
    spans = ", ".join(map(_number, answers.spans_m))
    return _TEXT.format(
        title=json.dumps(answers.title, ensure_ascii=False),
        spans=spans,
        width=_number(answers.width_m),
        section=SECTIONS[answers.section](answers),
        piers=PIERS[answers.piers](answers),
        caps=_caps(answers) if answers.piers == "hammerhead" else "",
        thickness=_number(answers.slab_m),
        height=_number(answers.height_m),
        line=_line(answers),
        shards=_SHARDS_OF_A_SPAN * len(answers.spans_m),
        action=METHODS[answers.by](answers),
    )


def _line(answers: Answers) -> str:
    """Return the tables of a road that is not level and straight, and of haunches."""
    keys = [
        f"{name} = {_number(value)}\n"
        for name in ("grade_percent", "crossfall_percent", "radius_m")
        if (value := getattr(answers, name)) is not None
    ]
    text = "".join(["[bridge.alignment]\n", *keys, "\n"]) if keys else ""
    if answers.haunch_m is not None:
        length = _number(round(_HAUNCH_OVER_SPAN * min(answers.spans_m), 2))
        text += f'[bridge.haunches]\nlength_m = {length}\ndepth_m = {_number(answers.haunch_m)}\nshape = "parabola"\n\n'
    return text


def _number(value: float) -> str:
    return repr(float(value))


def _removal(answers: Answers) -> str:
    return f"""\
# What is done: an excavator takes away a pier. Names of members are those that bda check lists.
[[removals]]
time_s = 0.5
members = [{_names_of_pier(answers, 1 + len(answers.spans_m) // 2)}]
"""


def _names_of_pier(answers: Answers, number: int) -> str:
    columns = _round_columns(answers) if answers.piers == "round" else 1
    names = [f"pier {number}"] if columns == 1 else [f"pier {number} column {one + 1}" for one in range(columns)]
    return ", ".join(map(json.dumps, names))


def _ball(answers: Answers) -> str:
    middle = math.fsum(answers.spans_m[: len(answers.spans_m) // 2]) + answers.spans_m[len(answers.spans_m) // 2] / 2.0
    x, y = (_number(round(value, 3)) for value in answers.place_m(middle))
    return f"""\
# What is done: a crane drops a steel ball. A slab with bars may carry that: a search, as in docs/search.md, says how
# heavy it has to be.
[ball]
mass_kg = 8000
diameter_m = 1.25                # a ball of steel of this mass
target_m = [{x}, {y}]          # along the road from the first pier, across it from its middle
drop_height_m = 10.0             # clear height above the deck
release_time_s = 0.1
"""


def _charges(answers: Answers) -> str:
    number = len(answers.spans_m) // 2
    along = math.fsum(answers.spans_m[:number]) - 0.8
    x, y = (_number(round(value, 3)) for value in answers.place_m(along))
    return f"""\
# What is done: a charge detonates beside a pier. It is bare and in air, so that it takes far more than charges in
# drill holes, which [[blast_zones]] have: see docs/drilled_charges.md.
[blast]
start_s = 0.5
apply = "direct"

[[charges]]
position_m = [{x}, {y}, {_number(answers.height_m / 2.0)}]  # along the road, across it, above the ground
mass_kg = 300                    # of TNT
"""


METHODS: dict[str, Callable[[Answers], str]] = {"removal": _removal, "ball": _ball, "charge": _charges}
"""What can be done to the bridge, by the words of `bda new`."""


def _girders(answers: Answers) -> str:
    depth = round(max(answers.spans_m) / 15.0, 2)
    number = max(2, round(answers.width_m / 2.6))
    return f"""\
[bridge.girders]                 # below the slab
number = {number}
width_m = 0.5
depth_m = {_number(depth)}

"""


def _box(answers: Answers) -> str:
    depth = max(1.2, round(max(answers.spans_m) / 18.0, 2))
    return f"""\
[bridge.box_girder]              # below the slab, open at its ends
width_m = {_number(round(0.55 * answers.width_m, 2))}
depth_m = {_number(depth)}
web_thickness_m = 0.4
bottom_thickness_m = 0.25

"""


def _voids(answers: Answers) -> str:
    diameter = round(0.55 * answers.slab_m, 2)
    return f"""\
[bridge.voids]                   # tubes in the slab
number = {max(1, int(0.8 * answers.width_m / (1.5 * diameter)))}
diameter_m = {_number(diameter)}

"""


def _wall(answers: Answers) -> str:
    wide = answers.width_m if answers.section == "t-beam" else 0.55 * answers.width_m
    wall = wide if answers.section in _BELOW_SLAB else 0.75 * answers.width_m
    return f"""\
kind = "wall"                    # or "columns", with columns = 2
column_length_m = 0.8            # along the road
column_width_m = {_number(wall)}             # across the road
"""


def _round_columns(answers: Answers) -> int:
    return max(2, round(answers.width_m / 2.6)) if answers.section == "t-beam" else 2


def _round(answers: Answers) -> str:
    number = _round_columns(answers)
    return f"""\
kind = "round columns"
columns = {number}
column_length_m = 1.0            # their diameter
column_width_m = 1.0             # the same
"""


def _hammerhead(answers: Answers) -> str:
    return f"""\
columns = 1
column_length_m = 1.2            # along the road
column_width_m = {_number(round(0.35 * answers.width_m, 2))}             # across the road
"""


def _caps(answers: Answers) -> str:
    wide = _number(round((0.55 if answers.section == "box" else 0.9) * answers.width_m, 2))
    return f"""\
[bridge.pier_caps]               # hammerheads: lower at their ends
length_m = 1.4
width_m = {wide}
height_m = 1.4
end_height_m = 0.7

"""


_SLAB_ON_WEBS_M = 0.25
_BELOW_SLAB = ("t-beam", "box")

SECTIONS: dict[str, Callable[[Answers], str]] = {
    "slab": lambda _: "",
    "hollow": _voids,
    "t-beam": _girders,
    "box": _box,
}
"""Sections of the deck, by the words of `bda new`."""

PIERS: dict[str, Callable[[Answers], str]] = {"wall": _wall, "round": _round, "hammerhead": _hammerhead}
"""Piers, by the words of `bda new`."""

_TEXT = """\
# Written by bda new. Change what you know better: lengths are in m, masses in kg, as the name of each key says.
# bda explain KEY says what a key means, such as bda explain bridge.deck.width_m; docs/scenario.md lists all keys.

[scenario]
title = {title}
seed = 1                         # another seed cuts the bridge into other shards: another run

[time]
duration_s = 4.0                 # longer, until everything rests

# The bridge: x runs along the road with 0 at the axis of the first pier, y across it, z up with 0 at the ground.
[bridge]
density_kg_m3 = 2500             # reinforced concrete
span_lengths_m = [{spans}]

{line}[bridge.deck]
width_m = {width}
thickness_m = {thickness}
overhang_m = 0.5                 # of the deck beyond the axes of the first and the last pier

{section}[bridge.piers]
{piers}height_m = {height}

{caps}[bridge.bearings]  # what carries the deck on the piers; without this table it is one piece with them
pinned_at = 1                    # the others let it slide along the road

# Bars as such a bridge would be designed with; bda check prints them. With drawings, give layers of [[reinforcement]].
[bridge.reinforcement]
designed_for = "LM1"             # own weight and load model 1 of EN 1991-2; or "HL-93", "own weight"

# How finely it is cut: more shards cost more time, and show more. 24 along a span give forces within some 7 %.
[fracture]
shards = {shards}

# Strength and stiffness come from the material: bda check says how the bridge carries its own weight, and bda stages
# what it carries of the traffic that its bars are designed for.
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"

[shards]
start_deactivated = false        # awake: if the bridge cannot carry itself, the run shows it

{action}"""
