# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of runs, studies and the like of many kinds, so that nearly every text of a report is in one of them."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from support.bridges_by_rule import bridge
from support.bridges_by_rule import scenario as scenario_by_rule
from support.checkout import EXAMPLES
from support.optimised_folders import optimised
from support.run_folders import TOLD, flying_shards, keep_run, killed_run
from support.search_folders import search_folder
from support.stage_folders import with_stages
from support.study_folders import told_runs

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.scenario import Equipment, Exclusion, MemberCut, Removal, Scenario, Weakening
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.schema import given
from bridge_demolition_addon.report.comparison import comparison
from bridge_demolition_addon.report.document.blocks import Document, Report, Section
from bridge_demolition_addon.report.ensemble.optimise import optimise_report, read_candidates
from bridge_demolition_addon.report.ensemble.search import read_answer, search_report
from bridge_demolition_addon.report.ensemble.study import study_report
from bridge_demolition_addon.report.run import run_report
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.charge_plan import planned_section
from bridge_demolition_addon.report.sections.reinforcement import reinforcement_section
from bridge_demolition_addon.report.sections.stages import stages_report

_CRACKED = {"cracked": 5, "held_at_end": 3, "yielded": 4, "ruptured_in_part": 1, "ruptured": 2} | {
    "largest_use_share": 0.8,
    "largest_use_s": 0.3,
}

SUMMARY = {
    "pulls": [
        {"name": "left", "largest_force_N": 8e4, "largest_force_s": 4.5, "paid_out_s": 3.25, "ended": "broke"}
        | {"ended_s": 4.5, "let_go_J": 2500.0, "work_J": 61e3},
        {"name": "right", "largest_force_N": 2e4, "largest_force_s": 2.0, "paid_out_s": None, "ended": None}
        | {"ended_s": None, "let_go_J": None, "work_J": 1e3},
    ],
    "tendons": [
        {"name": "lower", "member": "deck", "force_N": 63e4, "stored_J": 34e3}
        | {"released": [{"time_s": 0.5, "how": "cut", "energy_J": 10e3}]}
    ],
    "lifts": [
        {"name": "panel", "largest_hook_N": 4e5, "largest_hook_s": 2.1, "weight_N": 3e5, "volume_weight_N": 3.2e5}
    ],
    "reinforcement": {
        **_CRACKED,
        "with_bars": 9,
        "largest_use": {"share": 0.8, "time_s": 0.3, "connection": "Connection.001"}
        | {"first_member": "deck", "second_member": "pier 1"},
        "by_kind": [{"kind": "deck", **_CRACKED}],
    },
    "bearings": [
        {"name": "deck on abutment 1", "at_rest_up_N": 1e6, "largest_up_N": 2e6, "largest_up_s": 0.7, "least_up_N": 8e5}
        | {"least_up_s": 0.6, "largest_horizontal_N": 5e5, "largest_horizontal_s": 0.9, "largest_moment_y_Nm": 7e2}
        | {"largest_moment_y_s": 0.8, "opened": False, "opened_s": None, "largest_open_share": 0.5, "slid": True}
        | {"slip_m": 0.02, "largest_displacement_m": 0.02, "left_share": 0.0, "gone_s": 0.9}
    ],
}
"""What the summaries of runs with cables, tendons, cranes, bars and bearings have besides."""

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")


def reports(folder: Path) -> Iterator[Report]:
    """Yield reports of many kinds, made in a folder."""
    yield from _of_runs(folder)
    yield _of_section(planned_section(DRILLED), DRILLED)
    cut = MemberCut(name="Cut 1", member=DRILLED.blast_zones[0].member, position_m=0.5, mass_kg=2.0)
    severed = replace(DRILLED, blast_zones=(), cuts=(cut,))
    yield _of_section(planned_section(severed), severed)
    for by_rule in (scenario_by_rule(bridge()), scenario_by_rule(bridge(None))):
        yield _of_section(reinforcement_section(by_rule), by_rule)
    yield stages_report(with_stages(folder / "stages"), folder, Silence())
    for number, options in enumerate(({}, {"there": 60}, {"ends": {17: "crashed", 60: "timed_out"}})):
        (target := folder / f"study {number}").mkdir()
        yield study_report(told_runs(**options), target, Silence())
    yield search_report(read_answer(search_folder(folder / "search")[0]), folder, Silence())
    for number, options in enumerate(({}, {"fails_at_last": True}, {"most": 12})):
        (target := folder / f"optimise {number}").mkdir()
        yield optimise_report(read_candidates(optimised(target, **options)[0]), target, Silence())


def _of_runs(folder: Path) -> Iterator[Report]:
    """Yield reports of single runs, and of two side by side."""
    done = replace(
        TOLD,
        removals=(Removal(time_s=0.3, members=("pier 1",)),),
        weakenings=(Weakening(time_s=0.1, members=("deck",), factor=0.5),),
        equipment=(Equipment(name="Digger", mass_kg=2e4, position_m=(3.0, 0.0), footprint_m=(4.0, 2.0)),),
        exclusion=Exclusion(buffer_m=5, designed_drop_m=1, cordon_m=300),
    )
    folders = [_run(folder / "with everything", done), _run(folder / "bare", replace(TOLD, zones=(), neighbours=()))]
    folders.append(killed_run(folder / "killed"))
    folders.append(keep_run(folder / "by hand", flying_shards(), None, completed=False))
    runs = [read_run(path) for path in folders]
    for run in runs:
        yield run_report(run, run.folder, Silence(), trajectories=True)
    side_by_side = runs[:2]
    yield Report(comparison(side_by_side, "0"))


def _run(folder: Path, scenario: Scenario) -> Path:
    keep_run(folder, flying_shards(), scenario)
    path = folder / "summary.json"
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | SUMMARY), encoding="utf-8")
    return folder


def _of_section(section: Section | None, scenario: Scenario) -> Report:
    return Report(Document(scenario.title, "", (given(section),)))
