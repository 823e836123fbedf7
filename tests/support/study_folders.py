# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies as `bda study` leaves them, made from given numbers in no time."""

from dataclasses import replace

import numpy as np
from manifold3d import CrossSection
from support.checkout import REPORT_2019

from bridge_demolition_addon.engineering.geometry.plan_areas import outlines, united
from bridge_demolition_addon.model.ensemble.folder import EnsembleFolder
from bridge_demolition_addon.model.scenario import Exclusion, Neighbour, Site, Zone
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.model.study.file import OUTLINES_FILE, RUNS_FILE, study_of
from bridge_demolition_addon.model.study.outcome import Outlines
from bridge_demolition_addon.model.study.runs_table import RunOutcome, RunRow, RunsTable, write_runs
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.model.study.settings import StudySettings, Vary
from bridge_demolition_addon.report.ensemble.reported_ensemble import StudyRuns
from bridge_demolition_addon.system.array_files.archive import write_archive

_EXPLOSIVES = read_scenario(REPORT_2019 / "two_spans_13m_explosives.toml")

TOLD_SCENARIO = replace(
    _EXPLOSIVES,
    connections=replace(_EXPLOSIVES.connections, stiffness="rigid"),
    title='Two spans <b>& $5$ "Co"</b>',
    zones=(
        Zone(name="Road <1> $2$", kind="road", corners_m=((-12, 12), (40, 12), (40, 20), (-12, 20))),
        Zone(name="yard", kind="other", corners_m=((32, -30), (32, -12), (45, -12), (45, -30))),
    ),
    exclusion=Exclusion(buffer_m=5, designed_drop_m=1),
    site=Site(latitude_deg=41.6, longitude_deg=-93.6),
    neighbours=(
        Neighbour(name="House & $home$", position_m=(20, 24, 2)),
        Neighbour(name="School", position_m=(-20, -18, 2)),
    ),
)
"""A scenario with everything that a plan shows, and names that want escaping."""

VARIED = (
    Vary(key="charges.mass_kg", distribution="lognormal", median=1.0, variation=0.15, factor=True),
    Vary(key='charges."mid pier".delay_ms', distribution="normal", mean=50.0, deviation=5.0, lowest=0.0),
    Vary(key="shards.friction", distribution="triangular", lowest=0.4, most_likely=0.6, highest=0.8),
    Vary(key="connections.type", distribution="choice", values=["FIXED", "POINT"]),
)
CRITERIA = (
    Criterion(name="mid span down", kind="span down", span=1, share=0.5),
    Criterion(name="road stays free", kind="zone not entered", zone="Road <1> $2$"),
    Criterion(name="house <5 kPa", kind="pressure below", neighbour="House & $home$", limit_kpa=5.0),
)
VERSIONS = {"blender": "of tests", "numpy": "2"}
BRIDGE = CrossSection.square((28.0, 8.0)).translate((-1.0, -4.0))
"""From (-1, -4) m to (27, 4) m."""


def told_study(runs=93, *, scenario=TOLD_SCENARIO, vary=VARIED, criteria=CRITERIA, **settings):
    """A study of a bridge of two spans."""
    asked = StudySettings(scenario="scenario.toml", runs=runs, vary=vary, criteria=criteria, seed=5, **settings)
    return study_of(asked, scenario)


def told_row(study, number, status="done"):
    """A draw: it reaches the farther, the more the charge of the first span weighs, and scatters by chance."""
    inputs = sampled_run(study, number).inputs
    if status != "done":
        return RunRow(number, status, inputs, {})
    generator = np.random.default_rng([study.settings.seed, number])
    heavy = inputs.get('charges."span 1".mass_kg', 20.0) / 20.0
    reach_m = 6.0 * heavy**4 * generator.lognormal(0.0, 0.15)
    outputs = {
        "reach_m": reach_m,
        "largest_throw_m": reach_m + generator.random(),
        "debris_area_m2": 300.0 + 40.0 * generator.random(),
        "broken": int(400 + 100 * inputs.get("shards.friction", 0.6) + 10 * generator.normal()),
        "came_to_rest_s": None if number % 31 == 0 else 2.0 + generator.random(),
        "spans.1.lost_share": 0.8 + 0.1 * generator.random(),
    }
    met = {study.criteria[0].output: True, study.criteria[1].output: reach_m < 8.0} if study.criteria else {}
    if len(study.criteria) > 2:
        met |= {study.criteria[2].output: heavy < 1.2}
    return RunRow(number, "done", inputs, outputs | met | ({"success": all(met.values())} if met else {}))


def told_debris(row):
    """What the debris of a draw swept: much of the bridge, and some ways to all sides, the longest of its reach."""
    if row.status != "done":
        return None
    generator = np.random.default_rng(row.number)
    parts = [CrossSection.square((24.0, 6.0)).translate((1.0, -3.0))]
    for reach_m in row.outputs["reach_m"] * np.append(1.0, generator.random(7)):
        low = (generator.uniform(0.0, 24.0), 3.0)
        strip = CrossSection.square((generator.uniform(0.5, 2.0), 1.0 + reach_m)).translate(low)
        parts.append(strip if generator.random() < 0.5 else strip.scale((1.0, -1.0)))
    return tuple(outlines(united(parts)))


def told_runs(study=None, *, there=None, ends=None):
    """A study with its runs, of which some ended otherwise, by their numbers; only the first, if not all are there."""
    study = study or told_study()
    rows = [told_row(study, number, (ends or {}).get(number, "done")) for number in range(1, study.settings.runs + 1)]
    rows = tuple(rows[:there])
    swept = [told_debris(row) for row in rows]
    return StudyRuns("told", study, RunsTable(rows), VERSIONS, swept, BRIDGE, {})


def keep_study(path, runs):
    """The folder of a study with its runs, kept by what keeps them."""
    with EnsembleFolder(path, runs.ensemble, runs.versions) as folder:
        for row, swept in zip(runs.table.rows, runs.swept, strict=True):
            key = sampled_run(runs.ensemble, row.number).cache_key(runs.versions)
            part = folder.work_folder(key)
            part.mkdir(parents=True)
            if swept is not None:
                kept = Outlines(tuple(outlines(runs.bridge)), (), tuple(swept))
                write_archive(part / OUTLINES_FILE, kept.arrays())
            folder.keep(key, row.inputs, RunOutcome(row.status, "", row.outputs))
        write_runs(runs.table, path / RUNS_FILE)
    return path
