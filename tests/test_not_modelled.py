# SPDX-License-Identifier: GPL-3.0-or-later
"""No page says of something that it is not modelled which a scenario has a table for, without naming that table."""

import re

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.schema import subtable_class, subtable_fields

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
SAYS = re.compile(r"\bnot (?:modelled|simulated|covered|in the model)\b|\bknows? no\b", re.IGNORECASE)

FEATURES = {
    "ball": ("wrecking balls?", "sequences"),
    "bearings": ("bearings?", "connections"),
    "blast_zones": (r"drill(?:ed)? (?:holes?|charges?)|blast zones?", "drilled_charges"),
    "charges": ("bare charges?|charges? in the open", "blast"),
    "cuts": ("severed members?", "drilled_charges"),
    "dead_loads": ("dead loads?|surfacing|parapets?", "scenario"),
    "equipment": ("excavators?|machines? on the deck", "stages"),
    "fall_beds": ("fall beds?|cushions?", "ground"),
    "foundations": ("footings?|foundations?|soil springs?", "foundations"),
    "ground_motion": ("earthquakes?|ground motion", "ground_motion"),
    "jackhammers": ("jackhammers?", "sequences"),
    "lifts": ("lifts?|picks? of a crane", "stages"),
    "pressures": ("wind|flood", "sequences"),
    "pulls": ("winch(?:es)?|cables? that pulls?", "sequences"),
    "reinforcement": (r"reinforc\w+|rebars?|stirrups?", "reinforcement"),
    "removals": ("removals?", "sequences"),
    "saw_cuts": ("saw cuts?", "sequences"),
    "steelwork": ("steelwork|truss(?:es)?", "steel"),
    "tendon_cuts": ("tendons? that (?:is|are) cut", "tendons"),
    "tendons": (r"prestress\w*|tendons?", "tendons"),
    "weakenings": ("weakenings?", "sequences"),
}
"""What pages call that which a table of a scenario has, and the page that says how it is modelled."""

ELSEWHERE = {"bridge", "geometry", "ground", "fracture", "materials", "geometry_reinforcement", "connections"} | {
    "supports", "shards", "contacts", "blast", "loads", "recording", "pictures", "report", "zones", "exclusion",
    "site", "neighbours", "vibration_laws", "time", "machines", "programme",
}  # fmt: skip
"""Tables that no page would call left out."""


def statements(text):
    """Sentences that say of something that it is not modelled, and the heads of points under such a heading."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    for heading, section in re.findall(r"^#+ (.*)\n((?:(?!#+ ).*\n?)*)", text, flags=re.M):
        if SAYS.search(heading):
            for point in re.findall(r"^- (.*(?:\n  .*)*)", section, flags=re.M):
                yield first_sentence(" ".join(point.split()))
        else:
            yield from (sentence for sentence in sentences(section) if SAYS.search(sentence))


def sentences(text):
    return [sentence for block in re.split(r"\n\n|\n(?=[-|] )", text) for sentence in split(" ".join(block.split()))]


def split(text):
    return re.split(r"(?<=[.:;])(?<!e\.g\.) (?=[A-Z*`\[])", text)


def first_sentence(point):
    bold = re.match(r"\*\*(.+?)\*\*", point)
    return bold[1] if bold else split(point)[0]


def contradicted(text, page):
    """Statements that name what has a table, without the table or the page on it; a page knows its own limits."""
    for statement in statements(text):
        for table, (words, own) in FEATURES.items():
            named = re.search(rf"\b(?:{words})\b", statement, re.IGNORECASE)
            if named and own != page and not re.search(rf"\b{table}\b|{own}\.md", statement):
                yield f"{named[0]!r} has [[{table}]]: {statement}"


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_no_page_says_that_what_has_a_table_is_not_modelled(page):
    assert [*contradicted(page.read_text(encoding="utf-8"), page.stem)] == []


def test_every_table_of_a_scenario_has_its_words():
    tables = {subtable_class(item).table for item in subtable_fields(Scenario)}
    assert tables == set(FEATURES) | ELSEWHERE


def test_statements_that_were_wrong_are_found():
    """Two that pages had, one with the table named, one of a page on its own limits, and points under a heading."""
    text = """# Limits

- **Charges are bare.** What a charge in a drill hole does to concrete is not modelled, so more is needed here.
- Prestress is not modelled.
- Tendons are not modelled unless [[tendons]] give them.

## What is not modelled

- Wind on what hangs.
- **Local buckling**: a truss is judged by plastic sections.
"""
    assert [found.split(":")[0] for found in contradicted(text, "accuracy")] == [
        "'drill hole' has [[blast_zones]]",
        "'Prestress' has [[tendons]]",
        "'Wind' has [[pressures]]",
    ]
    assert [found.split("'")[1] for found in contradicted(text, "tendons")] == ["drill hole", "Wind"]
