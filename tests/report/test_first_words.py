# SPDX-License-Identifier: GPL-3.0-or-later
"""What every page says first, and beside each debris distance, for all that a run or a study can have.

Distances of fragments are worked out by hand from Lundborg's rule, the rest is given.
"""

import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from support.reports_of_many_kinds import DRILLED
from support.run_folders import TOLD, flying_shards, keep_run
from support.study_folders import told_runs, told_study

from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.records import MomentOfRun
from bridge_demolition_addon.model.scenario import Exclusion
from bridge_demolition_addon.report.document.blocks import DataTable, Document, Paragraph
from bridge_demolition_addon.report.ensemble.document import doubts_of
from bridge_demolition_addon.report.ensemble.study import study_summary
from bridge_demolition_addon.report.languages.translated_report import translated_document
from bridge_demolition_addon.report.languages.translation import Translation
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.charge_plan import charge_plan_section, flyrock_of, known_plan
from bridge_demolition_addon.report.sections.cover import findings_section
from bridge_demolition_addon.report.sections.summary import run_summary
from bridge_demolition_addon.report.single_pages import single_pages

END_S = 1.0
"""Of the recording."""

ENDINGS = {  # of a run that was stopped or not, from when on its charges fire: what is said first
    (False, 0.2): "",
    (False, 4.0): "Ended at 1.00 s, before {}: says nothing of the outcome.",
    (True, 0.2): "Stopped at 1.00 s, before its end: what follows is no outcome.",
    (True, 4.0): "Stopped at 1.00 s, before {}: says nothing of the outcome.",
}
LUNDBORG_M = {38.0: 340.1, 76.0: 539.9}
"""260 m (d / 25.4 mm)^(2/3) by hand, of holes of d mm."""

NEAR = DRILLED.blast_zones[0]
DRILLED_ZONES = replace(
    DRILLED,
    blast_zones=(NEAR, replace(DRILLED.blast_zones[-1], hole_diameter_mm=76.0, charge_g=200.0)),
    exclusion=None,
)
BALL = replace(TOLD, charges=(), zones=(), neighbours=(), exclusion=None)


MUCH_J = 1e9
"""More than a fall of all shards by 1 cm gives: what the solver made counts by what was dissipated."""


def recorded(*, moves, made):
    """A recording whose shards rest or move at its end; the solver made a part of what was dissipated."""
    results = flying_shards(8, 25)
    frames = results.frames
    speeds = frames.velocities_m_s.copy()
    if not moves:
        speeds[20:] = 0.0
    work = replace(
        frames.work,
        gravity_j=np.zeros_like(frames.work.gravity_j),
        dissipated_j=np.full_like(frames.work.dissipated_j, MUCH_J),
        made_j=np.full_like(frames.work.made_j, MUCH_J * made / frames.work.made_j.shape[1]),
    )
    return replace(results, frames=replace(frames, velocities_m_s=speeds, work=work))


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Runs as they were read, by whether shards move at the end, and which part of energy the solver made."""
    folder = tmp_path_factory.mktemp("runs")
    return {
        (moves, made): read_run(keep_run(folder / f"{moves} {made}", recorded(moves=moves, made=made), TOLD))
        for moves, made in product((False, True), (0.04, 0.06))
    }


@pytest.fixture(scope="module")
def flyrock():
    """How far fragments of the drilled charges fly."""
    return flyrock_of(known_plan(DRILLED_ZONES))


def scenario_of(drilled, start_s, cordon_m):
    """The scenario of a run with drilled charges, or a ball that is let go then."""
    exclusion = None if cordon_m is None else Exclusion(buffer_m=5.0, cordon_m=cordon_m)
    if drilled:
        return replace(DRILLED_ZONES, blast=replace(DRILLED.blast, start_s=start_s), exclusion=exclusion)
    ball = replace(TOLD.ball, release_time_s=start_s, drop_height_m=0.1)
    return replace(BALL, ball=ball, exclusion=exclusion)


def texts(page):
    """All texts of a page, and the first of all."""
    found = []
    for block in page.summary:
        if isinstance(block, Paragraph):
            found.append(block.text)
        elif isinstance(block, DataTable):
            found += [" ".join(row) for row in block.shown_rows()]
    return found


def plan_of(page):
    """The plan of a page, its texts by their names."""
    (plan,) = (block for block in page.summary if isinstance(block, DataTable) and block.name == "plan")
    return dict(plan.rows)


@pytest.mark.parametrize("drilled, cordon_m", list(product((False, True), (None, 250.0, 900.0))))
def test_every_page_of_a_run_begins_with_its_doubts_and_sets_the_cordon_against_fragments(
    kept, flyrock, drilled, cordon_m
):
    debris = {moves: debris_of(kept[moves, 0.04].recorded) for moves in (False, True)}
    for (moves, made), ((stopped, start_s), ending) in product(kept, ENDINGS.items()):
        scenario = scenario_of(drilled, start_s, cordon_m)
        read = kept[moves, made]
        hit = MomentOfRun(0.5, 14) if start_s < END_S else None
        summary = replace(read.summary, completed=not stopped, impact=hit)
        run = replace(read, scenario=scenario, summary=summary, ball=summary)
        findings = findings_section(run, debris[moves], {}, flyrock if drilled else None)
        document = Document(run.title, "", (findings,), run_summary(run, debris[moves], flyrock if drilled else None))
        pages = {"first": document, **single_pages(document, scenario)}
        undone = "anything was done to the bridge" if drilled else "the ball hit"
        ending = ending.format(undone)
        if not (drilled or stopped):
            ending = ending.replace("before the ball hit", "without a hit of the ball")
        advice = "" if stopped else "Let the run last longer"
        for audience, page in pages.items():
            said, name = texts(page), (audience, moves, made, stopped, start_s)
            doubt = said[0] if ending or moves or made > 0.05 else ""
            assert ending in doubt, name
            assert ("shards still move at the end" in doubt) == moves, name
            assert ("the solver made 6.0 % of what was dissipated" in doubt) == (made > 0.05), name
            assert ("Let the run last longer" in " ".join(said)) == bool(moves and advice), name
            everything = " ".join(said)
            if ending or moves:
                assert not re.search(r"\bstood,|nothing moved|Stays", everything), name
            assert not {"Limit", "Exclusion zone", "Exclusion zone of one run"} & set(plan_of(page)), name
            assert (plan_of(page).get("Debris distance") is None) == (start_s > END_S), name
            distance = plan_of(page).get("Debris distance")
            assert distance is None or "one run gives no limit" in distance, name
            if audience != "crew" or cordon_m is None:
                check_clearance(page, drilled, cordon_m)
        if cordon_m is not None:
            assert f"Clear of people within {plan_of(document)['Cordon']}" in texts(pages["crew"])
        first = findings.blocks[0]
        assert isinstance(first, Paragraph) == bool(ending or moves or made > 0.05)
        assert not isinstance(first, Paragraph) or first == document.summary[0]
        german = Translation.into("de")
        translated_document(document, german)
        assert german.missing == []


def check_clearance(page, drilled, cordon_m):
    """Check how far fragments of the worst zone fly, and what is said of the cordon."""
    flown, cordon = plan_of(page).get("Fragments (flyrock)"), plan_of(page).get("Cordon")
    assert (flown is not None) == drilled
    if drilled:
        assert f"{LUNDBORG_M[76.0]:.0f} m by Lundborg" in flown and "no safety distance" in flown
    if cordon_m is None:
        assert (cordon is not None) == drilled
        assert not drilled or ("none in the scenario" in cordon and "540 m by Lundborg" in cordon)
    elif drilled and cordon_m < LUNDBORG_M[76.0]:
        assert "250 m around the bridge's plan, by the scenario: shorter than 540 m by Lundborg" in cordon
    else:
        assert cordon.startswith(f"{cordon_m:g} m") and "shorter than 5" not in cordon


def test_the_authority_sees_the_worst_zone_first_and_all_of_them(kept):
    low = [replace(zone, holes_a_row=1, height_m=0.5, middle_m=zone.middle_m - 0.25) for zone in DRILLED.blast_zones]
    high = [replace(zone, middle_m=zone.middle_m + 0.5) for zone in low]
    apart = [
        replace(zone, name=f"Zone {number}", charge_g=40.0 + 5.0 * number) for number, zone in enumerate([*low, *high])
    ]
    scenario = replace(DRILLED, blast_zones=tuple(apart))
    run = replace(kept[False, 0.04], scenario=scenario)
    plan = known_plan(scenario)
    charges = charge_plan_section(scenario, plan)
    document = Document("", "", (charges,), run_summary(run, debris_of(run.recorded), flyrock_of(plan)))
    page = single_pages(document, scenario)["authority"]
    (fragments,) = (block for block in page.summary if isinstance(block, DataTable) and block.name == "fragments")
    farthest = [row[5] for row in fragments.rows]
    assert len(farthest) == 12 and farthest == sorted(farthest, reverse=True)
    assert f"{farthest[0]:.0f} m ({fragments.rows[0][0]})" in plan_of(page).get("Fragments (flyrock)")


def test_every_page_of_a_study_sets_the_cordon_against_fragments(flyrock):
    scenario = scenario_of(True, 0.2, 250.0)
    runs = told_runs(told_study(scenario=scenario, vary=(), criteria=()))
    document = Document(scenario.title, "", (), study_summary(runs, flyrock))
    for page in (document, *single_pages(document, scenario).values()):
        assert "In 3 of 93 runs not everything had rested" in texts(page)[0]
        assert "Debris stays within" in texts(page)[1]
        if "Cordon" in plan_of(page):
            check_clearance(page, True, 250.0)
    assert f"Clear of people within {plan_of(document)['Cordon']}" in texts(single_pages(document, scenario)["crew"])


def test_a_study_says_in_how_many_runs_the_solver_made_much_energy():
    runs = told_runs()
    rows = [
        replace(run, outputs=run.outputs | {"made_by_solver_share": 0.2 if run.number < 3 else 0.01})
        for run in runs.table.rows
    ]
    doubts = list(doubts_of(replace(runs, table=replace(runs.table, rows=tuple(rows)))))
    assert "In 2 of 93 runs the solver made more than 5 % of what was dissipated, up to 20.0 %" in doubts[1]
