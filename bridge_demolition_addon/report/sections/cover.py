"""What a report of any run has: main findings, settings, where its numbers come from, and how far to trust them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from ...engineering.units import mass_text
from ...exports.gltf import animated_glb
from ...model.debris.throws import Debris
from ...model.reinforcement.concrete_members import plain_concrete_text
from ...model.results.arrays import Results
from ...model.run_folder.summary import RunSummary
from ...model.scenario import Scenario
from ...model.scenario.contact_facts import contact_facts
from ...model.scenario.scenario import rules_of_bars
from ...model.scenario.time import TimeSettings
from ...texts import Quantity, Text, joined
from ..document.blocks import AnimatedModel, Block, Column, DataTable, Listing, Paragraph, Photo, Section, facts
from ..findings import IMPACT, findings
from ..run_folder import ReportedRun
from ..wording.checks import CHECKS, measured_cases
from ..wording.verdict import Flyrock, fragment_rows

RUN_TITLE = Text("The run")
TRUST_TITLE = Text("What is modelled, and how far to trust it")

_SOURCES = (
    (
        Text("Motion, contacts and connections"),
        Text("Bullet, the rigid-body engine in Blender, stepped as this report says"),
    ),
    (
        Text("Loads on bodies and connections"),
        Text("read from Bullet after its steps; in the tests they agree with statics"),
    ),
    (Text("Stresses"), Text("mean over each shard, from the forces on it; equivalent stress after von Mises")),
)
_OF_BALL = (
    Text("Estimated forces of the ball's hits"),
    Text("impulse and contact time after Hertz: Johnson, Contact Mechanics (1985)"),
)
_OF_BARS = (
    Text("Cracks and bars"),
    Text("EN 1992-1-1 and fib Model Code 2010; rupture by the tension chord model, Marti et al. (1998)"),
)
_OF_RULES = (
    Text("Bars by rule"),
    Text("EN 1992-1-1 and EN 1991-2: a guess at what was built, where drawings do not say"),
)
_OF_BEARINGS = (Text("Bearings"), Text("springs that open and slide, as the scenario gives them"))
_OF_ZONES = (
    (
        Text("Drilled charges"),
        Text("thresholds of the specific charge, of blasting manuals and recorded jobs: within a factor of 2"),
    ),
    (
        Text("Bars bared by a charge"),
        Text("curve c of EN 1993-1-1, and plastic hinges after Jones, Structural Impact (2011)"),
    ),
    (
        Text("Fragments (flyrock)"),
        Text(
            "sizes by Kuz-Ram, Cunningham (1987); rules of Lundborg et al. (1975) and McKenzie (2009): not "
            "calibrated on concrete"
        ),
    ),
)
_OF_CHARGES = (
    (
        Text("Blast waves"),
        Text("Kingery and Bulmash, or Kinney and Graham; explosives in TNT after Swisdak and Baker et al."),
    ),
    (Text("Thresholds of damage"), Text("Clancey (1972), Richmond et al. (1989)")),
    (Text("Ground vibration"), Text("Nicholls, Johnson and Duvall, USBM Bulletin 656 (1971), with handbook constants")),
)

_RIGID = Text("Bodies are rigid: nothing bends, and stiffness comes from the solver, its steps and iterations.")
_ELASTIC = Text("Shards are rigid; connections deform by their material, and members as finely as they are cut.")
_SPLINTERS = Text(
    "No piece is smaller than a shard. Splinters and what flies off at an impact are not modelled; they fly "
    "farther than any throw given here, and only the buffer of the exclusion zone accounts for them."
)
_FLYROCK = Text(
    "No piece is smaller than a shard. Fragments of blast zones are sampled beside the run, within a factor of 2. "
    "What flies off at an impact is not modelled, and only the buffer of the exclusion zone accounts for it."
)
_PEAKS = Text("Peak forces of impacts depend on the time step, their impulses do not.")
_ONE_FORCE = Text("One breaking force for all connections makes the result depend on how finely the bridge is cut.")
_BY_CUT = Text("Where and how a bridge breaks depends on its connections, and so on how it is cut.")
_NO_BARS = Text("No bars hold what cracks: cracked concrete falls apart, as concrete with reinforcement does not.")
_NO_SOIL = Text("The ground does not settle: soil counts only where the scenario has [[foundations]].")
_NO_FRICTION = Text("Friction of bearings counts only where connections are elastic and a bearing slides.")
_BEHIND = Text("Pressures of blast behind or inside members are not modelled.")
_NOT_CALIBRATED = Text("Nothing here has been calibrated against a measured demolition.")


def limits_of(scenario: Scenario | None) -> list[str]:
    """Return what the model of a scenario leaves out; where it is not known, of rigid bodies that break by a force."""
    connections = scenario.connections if scenario else None
    is_elastic = connections is not None and connections.is_elastic
    has_bars = scenario is not None and scenario.is_reinforced
    blasts = scenario is None or bool((scenario.charges or scenario.blast_zones) and scenario.blast.explosion)
    splinters = _FLYROCK if scenario and scenario.blast_zones else _SPLINTERS
    limits = [_ELASTIC if is_elastic else _RIGID, splinters, _PEAKS]
    limits.append(_BY_CUT if connections is not None and connections.material else _ONE_FORCE)
    limits += [] if has_bars else [_NO_BARS]
    limits += [] if scenario and scenario.foundations else [_NO_SOIL]
    limits += [] if is_elastic else [_NO_FRICTION]
    limits += [_BEHIND] if blasts else []
    return [*limits, _NOT_CALIBRATED]


ONE_RUN = Text(
    "One run is one possible course of events. Another seed, another number of shards or another strength shows "
    "how much of it is chance: run a study before relying on a distance."
)


def run_section(run: ReportedRun, version: str) -> Section:
    """Return what was run, and with which settings."""
    return Section(RUN_TITLE, (facts("Settings of the run", list(_run_facts(run, version)), "run"),))


def first_doubts_notice(run: ReportedRun) -> list[Paragraph]:
    """Return what has to be said before any result of a run, as a notice; nothing where there is nothing to say."""
    text = joined("{} {}", [Text("{}.", doubt) for doubt in run.first_doubts])
    return [Paragraph(text, is_notice=True)] if text else []


def findings_section(
    run: ReportedRun, debris: Debris, photos: Mapping[str, Path], flyrock: Flyrock | str | None = None
) -> Section:
    """Return the main findings, and photos that the first page does not show, by name."""
    rows = [*_findings(run, debris), *fragment_rows(run.scenario, flyrock)]
    table = facts("Main findings", rows, "findings")
    return Section(
        "Findings",
        (*first_doubts_notice(run), table, *(Photo(path, photo_caption(run, name)) for name, path in photos.items())),
    )


def trust_section(scenario: Scenario | None, *more: str) -> Section:
    """Return where the numbers come from, and how far to trust them, with more words on their limits."""
    checks = [(Text(check.what).capital, Text("{}: {}", check.against, check.within)) for check in CHECKS]
    blocks: list[Block] = [
        Paragraph(Text("What is modelled: {}.", joined("{}; {}", modelled(scenario)))),
        facts("Where the numbers come from", list(sources(scenario))),
        facts("What has been checked, against what and how closely it agrees", checks),
        _held_against_measurements(),
        *(Paragraph(text) for text in (*limits_of(scenario), *more)),
    ]
    return Section(TRUST_TITLE, tuple(blocks))


def modelled(scenario: Scenario | None) -> Iterator[str]:
    """Yield what the model of a scenario has; where it is not known, what every model has."""
    yield Text("a bridge of rigid shards that connections hold together until they break")
    yield Text("contact with friction")
    yield Text("gravity")
    if scenario is None:
        return
    zones = bool(scenario.blast_zones and scenario.blast.explosion)
    parts = (
        (scenario.connections.is_elastic, Text("elastic connections that crack by their strength")),
        (scenario.is_reinforced, Text("reinforcing bars across cracks, until they rupture")),
        (scenario.bearings, Text("bearings")),
        (scenario.tendons, Text("tendons")),
        (scenario.foundations, Text("soil below foundations, as springs")),
        (scenario.steelwork, Text("members of steel")),
        (scenario.ball, Text("a wrecking ball")),
        (zones, Text("charges in drill holes, whose specific charge decides what stays of their zones")),
        (zones, Text("fragments of blast zones, sampled beside the run")),
        (scenario.charges and scenario.blast.explosion, Text("the air blast of charges on the outsides of the shards")),
    )
    yield from (text for applies, text in parts if applies)


def sources(scenario: Scenario | None) -> Iterator[tuple[str, str]]:
    """Yield where the numbers of a scenario come from; where it is not known, sources of every model and of charges."""
    yield from _SOURCES[:3]
    if scenario is None or scenario.ball:
        yield _OF_BALL
    if scenario is not None and scenario.is_reinforced:
        yield _OF_BARS
    if scenario is not None and rules_of_bars(scenario):
        yield _OF_RULES
    if scenario is not None and scenario.bearings:
        yield _OF_BEARINGS
    if scenario is not None and scenario.blast_zones:
        yield from _OF_ZONES
    if scenario is None or scenario.charges or scenario.cuts or scenario.blast_zones:
        yield from _OF_CHARGES


def _held_against_measurements() -> DataTable:
    """Return how the model agrees with what was measured, misses first."""
    cases = measured_cases()
    within, of = sum(case.within for case in cases), sum(case.of for case in cases)
    columns = (
        Column("case", "case", "", lambda case: Text(case.case)),
        Column("within their tolerance", "within", "d", lambda case: case.within),
        Column("numbers", "of", "d", lambda case: case.of),
        Column("found over measured", "ratios", "", lambda case: case.ratios_text),
    )
    title = Text("Held against what was measured: {} of {} numbers are within their tolerance", within, of)
    return DataTable.of("", title, columns, cases)


def scenario_section(run: ReportedRun, text: str) -> Section:
    """Return the whole scenario, so that the run can be repeated."""
    use = Text("With this file and the versions above the run can be repeated: the same scenario gives the same logs.")
    return Section("The scenario", (Paragraph(use), Listing(text)))


def _run_facts(run: ReportedRun, version: str) -> Iterator[tuple[str, str]]:
    yield Text("Scenario"), run.title
    yield Text("Folder"), run.name
    summary, results = run.summary or RunSummary(), run.results
    if results is not None:
        yield Text("Simulated"), Text("{} s in {} frames", f"{results.frames.time_s[-1]:.3f}", len(results.frames))
        steps = results.frames.substep_s[results.frames.substep_s > 0.0]
        if len(steps):
            yield Text("Physics step"), _range_text(1e3 * steps.min(), 1e3 * steps.max(), "ms")
        yield Text("Loads read"), Text(results.load_sampling)
    elif run.logged_forces is not None:
        yield Text("Simulated"), Text("{} s as far as logged", f"{run.logged_forces.times_s[-1]:.3f}")
    if run.scenario:
        yield Text("Frames, steps, iterations"), _steps_text(run.scenario.time)
    if results is not None:
        yield from _model_facts(results)
    if summary.density_kg_m3 is not None:
        yield Text("Density"), Quantity(summary.density_kg_m3, "kg/m³", ".0f")
    if run.scenario:
        yield Text("Connections break"), _breaking_text(run)
        if plain := plain_concrete_text(run.scenario):
            yield Text("Without bars"), plain
        contacts = [Text("{}: {}", Text(name), text) for name, text in contact_facts(run.scenario)]
        yield Text("Contacts"), joined("{}; {}", contacts)
        yield Text("Seed"), str(run.scenario.seed)
    if summary.blender:
        yield "Blender", summary.blender
    yield "Bridge Demolition Add-on", version


def _steps_text(time: TimeSettings) -> Text:
    rate = f"{time.frames_per_second / time.frames_per_second_base:g}"
    if time.farthest_per_substep_m is None:
        return Text(
            "{} frames a second, {} steps a frame, {} iterations a step",
            rate,
            time.substeps_per_frame,
            time.solver_iterations,
        )
    return Text(
        "{} frames a second, {} steps a frame or more, so that no body moves more than {} in one, {} iterations a step",
        rate,
        time.substeps_per_frame,
        Quantity(time.farthest_per_substep_m, "m", "g"),
        time.solver_iterations,
    )


def _model_facts(results: Results) -> Iterator[tuple[str, str]]:
    shards, balls = results.inventory.of_kind("shard"), results.inventory.of_kind("ball")
    yield Text("Shards"), Text("{}, together {}", len(shards), mass_text(results.inventory.masses_kg[shards].sum(), 1))
    for ball in balls:
        yield str(results.inventory.body_names[ball]), mass_text(results.inventory.masses_kg[ball], 1)
    yield Text("Connections"), str(len(results.inventory.connection_names))


def _breaking_text(run: ReportedRun) -> str:
    settings, joint = run.planned.connections, run.planned.joints[0]
    material = Text(str(settings.material))
    if joint.breaking_force_n is not None:
        text = Text("at one force, {}", Quantity(joint.breaking_force_n / 1e3, "kN", ".1f"))
    elif settings.strength_factor != 1.0:
        text = Text("by {} times the strength of {}", f"{settings.strength_factor:g}", material)
    else:
        text = Text("by the strength of {}", material)
    return Text("{}; differently between some members, see the scenario", text) if settings.between else text


def _range_text(low: float, high: float, unit: str) -> str:
    return (
        Text("{} {}", f"{low:.3g}", unit)
        if high - low < 1e-3 * high
        else Text("{} to {} {}", f"{low:.3g}", f"{high:.3g}", unit)
    )


def _findings(run: ReportedRun, debris: Debris) -> Iterator[tuple[str, str]]:
    has_ball = len(run.recorded.inventory.of_kind("ball")) > 0
    yield from (
        (finding.label, finding.text) for finding in findings(run, debris) if has_ball or finding.label != IMPACT
    )


def photo_caption(run: ReportedRun, picture: str) -> str:
    """Return what a picture shows; in summaries of earlier versions there is no key frame."""
    reason = (run.summary and run.summary.key_frame.reason) or "In the course of the run"
    return Text({"before": "Before", "after": "At the end"}.get(picture, reason))


MOST_BYTES = 20_000_000
"""Of a model as it stands in a page: beyond that, browsers take seconds to open it."""


def model_section(results: Results) -> Section:
    """Return the section."""
    model = AnimatedModel.of(
        animated_glb(results), "The run: drag to turn, drag with Shift to move, wheel to come closer."
    )
    megabytes = len(model.packed) / 1e6
    how = Text("bda export --to gltf writes it as a file for other programs.")
    blocks: tuple[Block, ...]
    if len(model.packed) > MOST_BYTES:
        blocks = (
            Paragraph(
                Text("As a model the run would take {} MB of this page, so it is left out. {}", f"{megabytes:.0f}", how)
            ),
        )
    else:
        text = Text(
            "The page report.html has the run here as a model that can be turned and played. It takes {} MB of "
            "that page, and loads nothing from elsewhere. Bodies have the shapes that collide, their hulls. {}",
            f"{megabytes:.2g}",
            how,
        )
        blocks = (Paragraph(text), model)
    return Section("The run as a model", blocks)
