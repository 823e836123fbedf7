"""Bars of the members of `[[geometry]]` by a rule."""

from __future__ import annotations

from collections.abc import Sequence

from ...engineering.reinforced_concrete.materials import Concrete
from ..bridge.member import Member
from ..scenario.reinforcement import GeometryReinforcement
from .design_basis import BarDesign
from .file_decks import file_deck_bars, file_deck_line
from .file_members import FileDesign
from .file_substructure import file_substructure_bars, loads_of_carriers
from .load_paths import Seat, superstructures
from .schedule import ScheduledBars, ScheduledLinks


def file_bars(
    rule: GeometryReinforcement,
    concrete: Concrete,
    members: Sequence[Member],
    contacts: Sequence[Seat],
    of_concrete: frozenset[int],
) -> tuple[list[ScheduledBars | ScheduledLinks], list[str]]:
    """Return the bars of members from files, and notes.

    Decks and girders are beams over what they rest on; what carries them has bars for the loads that come down to it;
    all else has the least that EN 1992-1-1 asks for.
    """
    basis = FileDesign(BarDesign(rule, concrete), tuple(members), tuple(contacts), of_concrete)
    parts = superstructures(basis.members, contacts)
    widest = max((part.axes.width_m for part in parts), default=None)
    if rule.carriageway_m is not None and widest is not None and rule.carriageway_m > widest:
        raise rule.unexpected("carriageway_m", f"at most the width of the widest deck, {widest:.4g} (m)")
    lines = [line for part in parts if (line := file_deck_line(basis, part))]
    rows: list[ScheduledBars | ScheduledLinks] = []
    for line in lines:
        rows += file_deck_bars(basis, line)
    for part in parts:
        if not part.supports:
            for index in (*part.decks, *part.girders):
                basis.note(basis.members[index].name, "rests on no other member, and has least bars")
    with_bars = {name for row in rows for name in row.members}
    rest = [index for index in sorted(of_concrete) if basis.members[index].name not in with_bars]
    rows += file_substructure_bars(basis, rest, loads_of_carriers(basis, lines))
    return rows, basis.sentences
