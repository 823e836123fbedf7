"""What a planner wants to know of a bridge and its members before a run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..actions import Fact
from ..scenario import Bridge
from . import deck_top
from .member import Member, mean_density


def bridge_facts(bridge: Bridge, *, is_flat: bool) -> Iterator[Fact]:
    yield "length", f"{bridge.length_m:.2f} m"
    yield "spans", " + ".join(f"{span:.2f}" for span in bridge.span_lengths_m) + " m"
    yield "deck top above ground" if is_flat else "height of deck top", f"{deck_top(bridge):.2f} m"


def member_facts(members: Sequence[Member]) -> Iterator[Fact]:
    alike = len({member.density_kg_m3 for member in members}) == 1
    for member in members:
        own = "" if alike else f", {member.density_kg_m3:.0f} kg/m³"
        yield member.name, _volume_and_mass(member.volume_m3, member.mass_kg) + own
    volume, mass = (sum(getattr(member, what) for member in members) for what in ("volume_m3", "mass_kg"))
    yield "all", _volume_and_mass(volume, mass)
    yield "density" if alike else "mean density", f"{mean_density(members):.0f} kg/m³"


def _volume_and_mass(volume_m3: float, mass_kg: float) -> str:
    return f"{volume_m3:9.3f} m³ {mass_kg / 1000.0:10.3f} t"
