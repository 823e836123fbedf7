# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that other programs wrote: imported as they are, with the volumes and masses of those programs.

Those that may be passed on are in `files`. Others, which may not, lie beside some checkouts; where they do they are
imported, too.
"""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import ROOT

from bridge_demolition_addon.engineering.elasticity.equations import connected_parts
from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.ifc.import_process import import_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.model.scenario import Ground
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.terrain.files import TERRAIN_FILES, read_terrain

HERE = ROOT / "tests" / "foreign" / "files"
BESIDE = ROOT.parent / "shared" / "samples"

SHARDS = 120
"""Of each bridge, fewer than by default: `scripts/foreign_files.py` has those."""

LARGEST = 500_000
"""Bytes up to which files beside the checkout are imported here; `scripts/foreign_files.py` imports all."""

IFC = [HERE / "infra-bridge.ifc", HERE / "v440_tekla_modell.ifc"] + [
    path
    for path in sorted((BESIDE / "ifc").glob("*.ifc"))
    if path.stat().st_size < LARGEST and not (HERE / path.name).exists()
]
TERRAIN = [HERE / "ifc_tin_1.ifc", *(path for path in sorted((BESIDE / "terrain").glob("*")) if path.is_file())]


@pytest.fixture(scope="module")
def imported(tmp_path_factory):
    """Import each file once, into a folder that is given by the file."""
    made = {}

    def folder_of(path):
        if path not in made:
            made[path] = tmp_path_factory.mktemp("foreign") / path.stem
            import_bridge(path, made[path], ImportSettings(shards=SHARDS))
        return made[path]

    return folder_of


def elements(folder):
    with (folder / "elements.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.long
@pytest.mark.parametrize("path", IFC, ids=lambda path: path.stem)
def test_all_that_is_imported_is_held(path, imported):
    """Every shard is connected, over others, to one that never moves or to the ground."""
    folder = imported(path)
    model = build_model(read_scenario(folder / "scenario.toml"))
    moves = np.append(~model.fixed, False)
    first, second = (model.connections.pairs % len(moves)).T
    part = connected_parts(moves, first, second)
    held = {int(part[body]) for pair in zip(first, second, strict=True) for body in pair if not moves[list(pair)].all()}
    loose = [shard for shard in np.flatnonzero(~model.fixed).tolist() if int(part[shard]) not in held]
    names = {model.members[model.member_of_shard[shard]].name for shard in loose}
    assert not loose, names


@pytest.mark.long
def test_volumes_and_masses_are_those_of_tekla(imported):
    """The quantities that Tekla wrote (BaseQuantities): 242.334 m³ and 581.7 t of deck, and so for all others."""
    folder = imported(HERE / "v440_tekla_modell.ifc")
    rows = [row for row in elements(folder) if row["became"] == "member"]
    deck = next(row for row in rows if row["name"] == "DECK")
    assert float(deck["volume_m3"]) == pytest.approx(242.334, rel=0.001)
    assert float(deck["mass_kg"]) == pytest.approx(581_602.5, rel=0.01)
    said = (folder / "import.txt").read_text(encoding="utf-8")
    volume, mass = (line for line in said.splitlines() if " by the file for " in line)
    for line in (volume, mass):
        assert abs(float(line.rsplit(", ", 1)[1].removesuffix(" %"))) < 1.0
    assert "994.411 t by the file for 18 elements" in mass  # 1032.828 t less two approach slabs of 38.417 t


@pytest.mark.long
def test_a_norwegian_slab_bridge_is_what_it_is(imported):
    """28 elements: 3 columns, 8 bearings of which the file says no material, 4 wings; approach slabs are out."""
    rows = elements(imported(HERE / "v440_tekla_modell.ifc"))
    kinds = {kind: sum(row["kind"] == kind for row in rows if row["became"] == "member") for kind in KINDS}
    assert kinds == KINDS
    assert sum(row["became"] == "connection" for row in rows) == 8
    assert [row["element"] for row in rows if row["became"] == "left out"] == ["OVERGANGSPLATE"] * 2


KINDS = {"deck": 2, "pier": 3, "abutment": 3, "footing": 3, "wing wall": 4, "parapet": 2, "wall": 1}


@pytest.mark.long
def test_the_example_is_that_bridge_with_a_valley_under_it():
    """Its mass is by Tekla's weights, without approach slabs; the valley is dug away under its footings alone."""
    scenario = read_scenario(ROOT / "examples" / "imported" / "lillebruen.toml")
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=60))
    model = build_model(scenario)
    masses = sum(member.mass_kg for member in model.members)
    assert masses == pytest.approx(994_411.0, rel=0.01)
    assert {name for removal in scenario.removals for name in removal.members} == {"SØYLE", "SØYLE 2", "SØYLE 3"}
    dug = {row.name for row in model.ground.facts.levelled}
    assert {"FUNDAMENT", "FUNDAMENT 2", "FUNDAMENT 3"} <= dug
    assert "DECK" not in dug


@pytest.mark.long
def test_of_three_bridges_in_a_file_each_can_be_had(imported, tmp_path):
    """Of the PCERT sample scene: 78 elements of a road bridge and two arches of granite of 4 segments."""
    road = elements(imported(HERE / "infra-bridge.ifc"))
    assert sum(row["became"] == "member" for row in road) == 17
    assert {row["material"] for row in road if row["kind"] == "girder"} == {"wood-generic"}
    # Main girders lie between cross girders and deck: there is no room for a haunch.
    assert "haunch" not in (imported(HERE / "infra-bridge.ifc") / "import.txt").read_text(encoding="utf-8")
    import_bridge(HERE / "infra-bridge.ifc", tmp_path / "arch", ImportSettings(only="rail bridge"))
    arch = [row for row in elements(tmp_path / "arch") if row["became"] == "member"]
    assert sorted({row["kind"] for row in arch}) == ["arch", "fill", "footing", "pier", "wall"]
    piers = [float(row["volume_m3"]) for row in arch if row["kind"] == "pier"]
    assert piers == pytest.approx([24.950281] * 2, rel=0.01)  # Qto_ColumnBaseQuantities.NetVolume


@pytest.mark.parametrize("path", TERRAIN, ids=lambda path: path.name)
def test_terrain_is_read_or_refused_in_a_sentence(path):
    if path.suffix.lower() not in TERRAIN_FILES:
        return
    try:
        read = read_terrain(str(path), Ground(file=str(path)))
    except DemolitionError as error:
        assert path.name in str(error) and "\n" not in str(error)
        return
    assert np.isfinite(read.source.points).all()


def test_a_network_of_12d_has_its_triangles():
    """2357 points from 51.84 m to 78.00 m, as the file lists them."""
    path = HERE / "ifc_tin_1.ifc"
    heights = read_terrain(str(path), Ground(file=str(path))).source.points[:, 2]
    assert len(heights) == 2357
    assert (heights.min(), heights.max()) == pytest.approx((51.84, 78.0), abs=0.01)


@pytest.mark.long
def test_damaged_files_are_read_or_refused(tmp_path):
    """Some of each kind of those that `scripts/fuzz_foreign.py` reads by hundreds."""
    from fuzz_foreign import read_damaged_ifc, read_damaged_terrain, read_mutated_ifc

    none = tmp_path / "none"  # no files of other programs beside those of the tests
    said = [read_damaged_terrain(tmp_path, seed, none) for seed in range(22)]
    said += [read_damaged_ifc(tmp_path, seed, none) for seed in range(2)]
    said += [read_mutated_ifc(tmp_path, seed, none) for seed in range(6)]
    assert set(said) <= {"read", "refused"}
