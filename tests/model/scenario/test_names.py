# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of a list that are referred to by name, in the scenario and in studies, have names that tell them apart."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.optimise.settings import OptimiseSettings
from bridge_demolition_addon.model.scenario import Equipment, Geometry, Scenario, Zone
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.schema import Table, holds_many, named_tables, subtable_class, subtable_fields
from bridge_demolition_addon.model.search.settings import SearchSettings
from bridge_demolition_addon.model.study.criteria import Criterion, zone_output
from bridge_demolition_addon.model.study.settings import StudySettings

CORNERS_M = ((20.0, 0.0), (30.0, 0.0), (30.0, 10.0))
ZONE = Zone(name="road", corners_m=CORNERS_M)


def lists_of(table_class: type[Table]) -> Iterator[tuple[type[Table], str, type[Table]]]:
    """Yield each table, its list and the class of what the list holds, where that has a name."""
    for item in subtable_fields(table_class):
        inner = subtable_class(item)
        if holds_many(item) and "name" in inner.__dataclass_fields__:
            yield table_class, item.name, inner
        yield from lists_of(inner)


def bare(table_class: type[Table], **values):
    """Return a table that was not checked: names are looked at before what tables say together."""
    table = object.__new__(table_class)
    for name, value in values.items():
        object.__setattr__(table, name, value)
    return table


def test_no_list_takes_a_name_twice_but_those_that_nothing_refers_to():
    taken = []
    for owner, name, inner in [
        found for root in (Scenario, StudySettings, SearchSettings, OptimiseSettings) for found in lists_of(root)
    ]:
        lists = {item.name: () for item in subtable_fields(owner) if holds_many(item)}
        named = [bare(inner, name=text) for text in ("other", "road", "side road", "road")]
        try:
            named_tables(bare(owner, **lists | {name: named}))
        except ScenarioError as error:
            assert str(error) == (
                f'[[{inner.table}]] number 2 and [[{inner.table}]] number 4 have one name, "road": '
                "expected a name of its own for each"
            )
            continue
        taken.append(inner.table)
    assert taken == ["geometry", "equipment"]


def test_all_names_that_are_taken_are_named_at_once():
    with pytest.raises(ScenarioError, match=r"number 1 and .* number 3 and .* number 4 have one") as refused:
        replace(I235, zones=(ZONE, replace(ZONE, name="b"), ZONE, ZONE, replace(ZONE, name="b")))
    assert len(refused.value.faults) == 2


@pytest.mark.parametrize("same", ["road ", " road", "Fußweg é", "road  2"])
def test_names_that_look_the_same_are_the_same(same):
    other = {"Fußweg é": "Fußweg é", "road  2": "road 2"}.get(same, "road")
    with pytest.raises(ScenarioError, match="have one name"):
        replace(I235, zones=(replace(ZONE, name=same), replace(ZONE, name=other)))
    replace(I235, zones=(replace(ZONE, name="Road"), ZONE))


def test_names_that_differ_after_many_letters_are_told_apart_in_outputs():
    first, second = ("motorway " * 10 + direction for direction in ("north", "south"))
    assert zone_output(first, "entered") != zone_output(second, "entered")
    assert (
        Criterion(name=first, kind="collapsed").output
        == 'criteria."motorway motorway motorway motorway motorway motorway motorway motorway motorway motorway north"'
    )


def test_a_study_of_a_scenario_with_one_name_twice_is_refused(tmp_path: Path):
    # 14 pieces lay in the first zone, none in the second; judged by the last alone, the run was a success
    text = scenario_text(replace(I235, zones=()))
    zone = '\n[[zones]]\nname = "lane"\ncorners_m = [[{0}, 0], [{0}, 9], [{0}.5, 9]]\n'
    (tmp_path / "twice.toml").write_text(text + zone.format(20) + zone.format(500), encoding="utf-8")
    with pytest.raises(ScenarioError, match=r'number \d and \[\[zones\]\] number \d have one name, "lane"'):
        read_scenario(tmp_path / "twice.toml")


def test_no_member_of_ones_own_is_called_the_ground():
    own = Geometry(name="ground", file="a.stl", density_kg_m3=2500.0)
    with pytest.raises(ScenarioError, match=r'geometry\.name is "ground": expected another name'):
        replace(I235, geometry=(own,))
    replace(I235, geometry=(replace(own, name="ground slab"),))


def test_a_machine_stands_once_at_a_time():
    first = Equipment(name="excavator", mass_kg=24_000, position_m=(3.0, 0.0), footprint_m=(4.0, 3.0), until_s=0.5)
    after, beside = replace(first, from_s=0.5, until_s=None), replace(first, name="second excavator")
    replace(I235, equipment=(first, after, beside))
    for twice in (first, replace(first, position_m=(9.0, 0.0)), replace(after, from_s=0.4)):
        with pytest.raises(ScenarioError, match=r'number 1 and \[\[equipment\]\] number 2 are both "excavator" at 0'):
            replace(I235, equipment=(first, twice))
