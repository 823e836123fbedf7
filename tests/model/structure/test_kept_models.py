# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs share the model of a bridge that is cut alike, with the bits of one that is built anew, and no other."""

from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest
from support.checkout import EXAMPLES, TESTS

from bridge_demolition_addon.model.scenario import FractureSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.scenario.scenario import Scenario, action_fields
from bridge_demolition_addon.model.schema import Table, subtable_class
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.structure.model import Model, ModelBasis, build_model

EVERYTHING = read_scenario(TESTS / "simulation" / "everything.toml")
DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans_in_100_shards.toml")
BALL = read_scenario(EXAMPLES / "report_2019" / "i235_one_span.toml")
STEEL = read_scenario(EXAMPLES / "steel" / "composite_span_dropped.toml")

AROUND_SHARDS = tuple(replace(cut, along="faces") for cut in EVERYTHING.saw_cuts)
SMALL = replace(EVERYTHING, fracture=replace(EVERYTHING.fracture, shards=6), saw_cuts=AROUND_SHARDS)

OTHER_RUNS = {
    "charge": replace(SMALL, charges=(replace(SMALL.charges[0], mass_kg=30.0),)),
    "no charge": replace(SMALL, charges=()),
    "saw cut": replace(SMALL, saw_cuts=()),
    "blast": replace(SMALL, blast=replace(SMALL.blast, start_s=0.6)),
    "time": replace(SMALL, time=replace(SMALL.time, duration_s=2.0, substeps_per_frame=20)),
}


def parts_of(value, name="model"):
    """Yield the names and bits of all that a model is made of."""
    if isinstance(value, np.ndarray):
        yield name, (value.dtype.str, value.shape, value.tobytes())
    elif isinstance(value, tuple):
        for number, item in enumerate(value):
            yield from parts_of(item, f"{name}.{number}")
    elif is_dataclass(value):
        for field in fields(value):
            yield from parts_of(getattr(value, field.name), f"{name}.{field.name}")
    else:
        yield name, repr(value)


def test_a_model_of_the_same_basis_is_shared_and_has_the_bits_of_one_that_is_built_anew():
    models = KeptModels()
    kept = models.model_of(SMALL)
    anew = dict(parts_of(build_model(SMALL)))
    assert sum(isinstance(bits, tuple) for bits in anew.values()) > 30
    for name, scenario in OTHER_RUNS.items():
        assert models.model_of(scenario) is kept, name
        assert dict(parts_of(build_model(scenario))) == anew, name
    assert len(models) == 1


@pytest.mark.parametrize("changes", [{"charge_g": 20.0}, {"delay_ms": 50.0}, {"throw_kg_m3": 1.2}, {"fires": False}])
def test_zones_that_are_charged_otherwise_have_the_same_basis(changes):
    zones = (replace(DRILLED.blast_zones[0], **changes), *DRILLED.blast_zones[1:])
    assert ModelBasis.of(replace(DRILLED, blast_zones=zones)).digest == ModelBasis.of(DRILLED).digest


def test_zones_and_saw_cuts_elsewhere_cut_elsewhere():
    zone = DRILLED.blast_zones[0]
    zones = (replace(zone, middle_m=zone.middle_m + 0.125), *DRILLED.blast_zones[1:])
    moved = ModelBasis.of(replace(DRILLED, blast_zones=zones))
    assert moved.digest != ModelBasis.of(DRILLED).digest
    assert len(moved.planes) == 2 * len(zones)
    assert ModelBasis.of(SMALL).digest != ModelBasis.of(replace(SMALL, saw_cuts=EVERYTHING.saw_cuts)).digest


def test_a_basis_leaves_out_actions_blast_and_time_alone():
    left_out = set(action_fields(Scenario))
    for scenario in (BALL, DRILLED, EVERYTHING, STEEL):
        standing = ModelBasis.of(scenario).scenario
        assert not standing.actions
        left_out |= {
            item.name for item in fields(Scenario) if getattr(standing, item.name) != getattr(scenario, item.name)
        }
    assert left_out == {*action_fields(Scenario), "blast", "time"}


def tables_in(table):
    """Yield a table and all tables in it."""
    yield table
    for item in fields(table):
        value = getattr(table, item.name)
        for inner in value if isinstance(value, tuple) else (value,):
            if isinstance(inner, Table):
                yield from tables_in(inner)


@pytest.mark.parametrize("scenario", [BALL, DRILLED, EVERYTHING, STEEL], ids=["ball", "drilled", "everything", "steel"])
def test_each_key_of_a_basis_is_a_part_of_its_digest(scenario):
    basis = ModelBasis.of(scenario)
    digest, tried = basis.digest, 0
    for table in tables_in(basis.scenario):
        for item in fields(table):
            value = getattr(table, item.name)
            other = __file__ if subtable_class(item) is None else () if isinstance(value, tuple) else None
            if value == other:
                continue
            object.__setattr__(table, item.name, other)
            assert basis.digest != digest, f"{table.table}.{item.name}"
            object.__setattr__(table, item.name, value)
            tried += 1
    assert basis.digest == digest and tried > 100


def test_the_sign_of_a_zero_is_a_part_of_a_basis():
    rules = [replace(EVERYTHING, fracture=replace(EVERYTHING.fracture, noise=zero)) for zero in (0.0, -0.0)]
    assert rules[0] == rules[1] and len({ModelBasis.of(scenario).digest for scenario in rules}) == 2


def test_what_is_in_a_file_is_a_part_of_a_basis(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("4.0,0.0,3.2\n", encoding="utf-8")
    fracture = FractureSettings(shards=20, points_file=str(path))
    scenario = replace(EVERYTHING, fracture=fracture)
    first = ModelBasis.of(scenario).digest
    path.write_text("4.0,0.5,3.2\n", encoding="utf-8")
    assert ModelBasis.of(scenario).digest != first


def test_another_bridge_cut_or_connection_is_another_model():
    models = KeptModels()
    others = [
        SMALL,
        replace(SMALL, seed=8),
        replace(SMALL, bridge=replace(SMALL.bridge, density_kg_m3=2401.0)),
        replace(SMALL, fracture=replace(SMALL.fracture, shards=7)),
        replace(SMALL, connections=replace(SMALL.connections, strength_factor=0.9)),
    ]
    built = [models.model_of(scenario) for scenario in others]
    assert len(models) == len(others)
    assert len({tuple(map(repr, dict(parts_of(model)).items())) for model in built}) >= len(others) - 1
    assert all(models.model_of(scenario) is model for scenario, model in zip(others, built, strict=True))


def test_memory_is_bounded_and_the_oldest_go_first():
    first, second, third = (replace(SMALL, seed=seed) for seed in (1, 2, 3))
    size = bytes_of(build_model(first))
    models = KeptModels(most_bytes=round(2.5 * size))
    kept = [models.model_of(scenario) for scenario in (first, second)]
    assert models.model_of(first) is kept[0]  # so that the second is older
    models.model_of(third)
    assert len(models) == 2
    assert models.model_of(first) is kept[0] and models.model_of(second) is not kept[1]
    tiny = KeptModels(most_bytes=1)
    assert tiny.model_of(first) is tiny.model_of(first) and len(tiny) == 1


def bytes_of(model: Model) -> int:
    return sum(len(bits[2]) for _, bits in parts_of(model) if isinstance(bits, tuple))


def test_no_run_can_change_what_the_next_one_gets():
    model = KeptModels().model_of(SMALL)
    with pytest.raises(ValueError, match="read-only"):
        model.masses_kg[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        model.shards[0].vertices += 1.0
