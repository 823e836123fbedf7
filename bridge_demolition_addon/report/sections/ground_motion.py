"""Sections on the ground: how it moved, how foundations settled, and how the fall of the bridge shakes it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ...charts.histories import ground_motion_history, moving_directions, response_spectra
from ...engineering.ground_motion import GroundRecord
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...model.blast.vibration_laws import OF_FALL
from ...model.debris.touchdown import EXPONENT, NEAREST_M, TOGETHER_S, VELOCITY_M_S, Shaking, landings, shaking_at
from ...model.debris.vibration_limits import FALL_HZ
from ...model.ground_motion.record_files import read_record
from ...model.ground_motion.settings import DIRECTIONS, GroundMotion
from ...model.results.arrays import Results
from ...model.run_folder.files import GROUND_MOTION_FILE
from ...model.scenario import Scenario
from ...model.structure.settlement import settlements
from ...texts import Quantity, Text
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from ..run_folder import ReportedRun
from ..wording.vibration import extrapolated_text, limit_table, limits_text, site_law_text

_SHAKING = Text(
    "Largest velocity of the ground by v = {} cm/s (R / (E / 10 kJ)^(1/3))^-{} (Zhou), with the distance R in m "
    "and the kinetic energy E in kJ of what lands within {} s. It is an estimate: a factor of two to either side "
    "is usual, and soil, ditches and banks change it. One run is one possible outcome: a study gives the range.",
    f"{100.0 * VELOCITY_M_S:.3g}",
    f"{EXPONENT:g}",
    f"{TOGETHER_S:g}",
)


def motion_section(run: ReportedRun) -> Section | None:
    """Return how the ground moved and foundations settled; None for a run with neither."""
    if run.scenario is None:
        return None
    blocks: list[Block] = []
    if run.scenario.ground_motion:
        blocks += _motion_blocks(run, run.scenario.ground_motion)
    if run.scenario.foundations and run.results is not None:
        blocks += _settlement_blocks(run.results, run.scenario)
    return Section("Motion of the ground, and foundations", tuple(blocks)) if blocks else None


def _motion_blocks(run: ReportedRun, motion: GroundMotion) -> list[Block]:
    try:
        record, start_s = read_record(run.folder / GROUND_MOTION_FILE)
    except ScenarioError as error:
        return [Paragraph(Text("The ground moved, but its record is not there: {}.", error), is_notice=True)]
    return [
        Paragraph(_motion_text(motion)),
        _peak_table(record),
        Picture(
            partial(ground_motion_history, record=record, start_s=start_s), "Motion of the ground", height_mm=110.0
        ),
        Picture(
            partial(response_spectra, record=record, wanted=motion.spectrum, factor=motion.factor),
            "Largest acceleration of an oscillator on it with 5 % damping, by its period",
            height_mm=70.0,
        ),
    ]


def _motion_text(motion: GroundMotion) -> str:
    if motion.spectrum:
        spectrum = motion.spectrum
        source = Text(
            "a record made from the spectrum of EN 1998-1, type {}, ground {}, with {} on rock: sines with random "
            "phases under an envelope",
            spectrum.type,
            spectrum.ground_type,
            Quantity(spectrum.acceleration_m_s2, "m/s²", "g"),
        )
    elif motion.sweep:
        source = Text("a sine from {} to {} Hz", f"{motion.sweep.from_hz:g}", f"{motion.sweep.to_hz:g}")
    else:
        source = Text("the accelerogram {}", motion.file)
    baselines = {
        "linear": Text("a straight line was subtracted, so that the ground ends at rest where it began"),
        "parabola": Text("a parabola was subtracted, so that the ground ends at rest where it began"),
        "none": Text("nothing was subtracted"),
    }
    return Text(
        "The ground and all that is fixed to it moved by {}, times {}. Baseline: {}. Throws, rest and collapse in "
        "this report are as seen from the ground.",
        source,
        f"{motion.factor:g}",
        baselines[motion.baseline],
    )


def _peak_table(record: GroundRecord) -> DataTable:
    peaks = record.peaks()
    accelerations, velocities = peaks["accelerations_m_s2"], peaks["velocities_m_s"]
    columns = (
        Column("direction", "direction", "", lambda axis: Text(DIRECTIONS[axis])),
        Column("acceleration", "peak_acceleration_m_s2", ".2f", lambda axis: accelerations[axis]),
        Column(
            "acceleration",
            "peak_acceleration_g",
            ".3f",
            lambda axis: accelerations[axis] / STANDARD_GRAVITY_M_S2,
            unit="share of g",
        ),
        Column("velocity", "peak_velocity_m_s", ".3f", lambda axis: velocities[axis]),
        Column("displacement", "peak_displacement_m", ".3f", lambda axis: peaks["displacements_m"][axis]),
    )
    title = Text("Largest of the ground's motion")
    return DataTable.of("ground_motion_peaks", title, columns, moving_directions(record))


def _settlement_blocks(results: Results, scenario: Scenario) -> list[Block]:
    columns = (
        Column("member", "member", "", lambda footing: footing["member"]),
        Column("settled", "settled_mm", ".2f", lambda footing: 1e3 * footing["settled_m"]),
        Column("at most", "most_settled_mm", ".2f", lambda footing: 1e3 * footing["most_settled_m"]),
        Column("slid", "slid_mm", ".2f", lambda footing: 1e3 * footing["slid_m"]),
        Column("leans", "tilt_mrad", ".2f", lambda footing: 1e3 * footing["tilt_rad"], unit="mrad"),
    )
    footings = settlements(results, scenario.foundations)
    return [
        Paragraph(
            "Footings stand on springs that press and never pull, settle for good where the soil carries no more, and "
            "slide where friction ends. Settlement is from the bridge as it was built, without any load."
        ),
        DataTable.of("settlements", "Foundations at the end of the run", columns, footings),
    ]


_IN_BED = "{}: a part of {} is left of the shaking by what lands on it, as the scenario says."


def touchdown_section(results: Results, scenario: Scenario) -> Section | None:
    """Return how the fall shakes the ground at the neighbours, by the site's law; None where there are none."""
    if not scenario.neighbours:
        return None
    landed, law = landings(results, scenario.fall_beds), scenario.site_law(OF_FALL)
    blocks: list[Block] = [Paragraph(_SHAKING if law is None else site_law_text(law, OF_FALL))]
    known = [(neighbour.name, shaking_at(neighbour.position_m, landed, law)) for neighbour in scenario.neighbours]
    shaken = [(name, shaking) for name, shaking in known if shaking is not None]
    blocks += [Paragraph(_too_near_text(name), True) for name, shaking in shaken if shaking.at_most_m_s is None]
    blocks += [Paragraph(extrapolated_text(name), True) for name, shaking in shaken if shaking.is_extrapolated]
    beds = [bed for bed in scenario.fall_beds if bed.vibration_factor < 1.0]
    blocks += [Paragraph(Text(_IN_BED, bed.name, f"{bed.vibration_factor:g}")) for bed in beds]
    if len(landed):
        blocks.append(_shaking_table(shaken, has_law=law is not None))
    else:
        blocks.append(Paragraph("Nothing fell and was stopped in this run."))
    blocks.append(limit_table())
    return Section("Shaking of the ground by the fall", tuple(blocks))


def _shaking_table(shaken: Sequence[tuple[str, Shaking]], *, has_law: bool) -> DataTable:
    at_most = Column("at most", "at_most_mm_s", ".2f", lambda _, shaking: _mm_s(shaking.at_most_m_s))
    columns = (
        Column("neighbour", "neighbour", "", lambda name, _: name),
        Column(
            "ground velocity",
            "peak_particle_velocity_mm_s",
            ".2f",
            lambda _, shaking: _mm_s(shaking.velocity_m_s),
        ),
        *((at_most,) if has_law else ()),
        Column(Text("from", context="time"), "time_s", ".2f", lambda _, shaking: shaking.time_s),
        Column("mass", "mass_t", ".1f", significant=3, value=lambda _, shaking: 1e-3 * shaking.mass_kg),
        Column("energy", "energy_kJ", ".0f", lambda _, shaking: 1e-3 * shaking.energy_j),
        Column("distance", "distance_m", ".1f", lambda _, shaking: shaking.distance_m),
        Column("reaches the limit for", "limits", "", lambda _, shaking: _limits_reached(shaking)),
    )
    names, shakings = zip(*shaken, strict=True) if shaken else ((), ())
    return DataTable.of("touchdown", "Shaking at the neighbours by the fall", columns, names, shakings)


def _mm_s(velocity_m_s: float | None) -> float | None:
    return None if velocity_m_s is None else 1e3 * velocity_m_s


def _limits_reached(shaking: Shaking) -> str:
    return Text("not known") if shaking.at_most_m_s is None else limits_text(shaking.at_most_m_s, FALL_HZ)


def _too_near_text(neighbour: str) -> Text:
    return Text(
        "{}: what shakes it most lands nearer than {}, where no general formula holds and none is given. A drop test "
        "gives the law of the site: bda calibrate.",
        neighbour,
        Quantity(NEAREST_M, "m", "g"),
    )
