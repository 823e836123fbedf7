"""The section on how the ground moved, and how foundations settled."""

from __future__ import annotations

from functools import partial

from ...charts.ground_motion import ground_motion_history, moving_directions, response_spectra
from ...engineering.ground_motion.record import GroundRecord
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...model.ground_motion.record_files import read_record
from ...model.ground_motion.settings import DIRECTIONS, GroundMotion
from ...model.results.arrays import Results
from ...model.run_folder.files import GROUND_MOTION_FILE
from ...model.scenario import Scenario
from ...model.structure.settlement import settlements
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from ..run_folder import ReportedRun


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
        return [Paragraph(f"The ground moved, but its record is not there: {error}.", is_notice=True)]
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
        source = (
            f"a record made from the spectrum of EN 1998-1, type {spectrum.type}, ground {spectrum.ground_type}, "
            f"with {spectrum.acceleration_m_s2:g} m/s² on rock: sines with random phases under an envelope"
        )
    elif motion.sweep:
        source = f"a sine from {motion.sweep.from_hz:g} to {motion.sweep.to_hz:g} Hz"
    else:
        source = f"the accelerogram {motion.file}"
    baselines = {
        "linear": "a straight line was subtracted, so that the ground ends at rest where it began",
        "parabola": "a parabola was subtracted, so that the ground ends at rest where it began",
        "none": "nothing was subtracted",
    }
    return (
        f"The ground and all that is fixed to it moved by {source}, times {motion.factor:g}. Baseline: "
        f"{baselines[motion.baseline]}. Throws, rest and collapse in this report are as seen from the ground."
    )


def _peak_table(record: GroundRecord) -> DataTable:
    peaks = record.peaks()
    accelerations, velocities = peaks["accelerations_m_s2"], peaks["velocities_m_s"]
    columns = (
        Column("direction", "direction", "", lambda axis: DIRECTIONS[axis]),
        Column("acceleration (m/s²)", "peak_acceleration_m_s2", ".2f", lambda axis: accelerations[axis]),
        Column(
            "acceleration (g)", "peak_acceleration_g", ".3f", lambda axis: accelerations[axis] / STANDARD_GRAVITY_M_S2
        ),
        Column("velocity (m/s)", "peak_velocity_m_s", ".3f", lambda axis: velocities[axis]),
        Column("displacement (m)", "peak_displacement_m", ".3f", lambda axis: peaks["displacements_m"][axis]),
    )
    title = "Largest of the ground's motion"
    return DataTable.of("ground_motion_peaks", title, columns, moving_directions(record))


def _settlement_blocks(results: Results, scenario: Scenario) -> list[Block]:
    columns = (
        Column("member", "member", "", lambda footing: footing["member"]),
        Column("settled (mm)", "settled_mm", ".2f", lambda footing: 1e3 * footing["settled_m"]),
        Column("at most (mm)", "most_settled_mm", ".2f", lambda footing: 1e3 * footing["most_settled_m"]),
        Column("slid (mm)", "slid_mm", ".2f", lambda footing: 1e3 * footing["slid_m"]),
        Column("leans (mrad)", "tilt_mrad", ".2f", lambda footing: 1e3 * footing["tilt_rad"]),
    )
    footings = settlements(results, scenario.foundations)
    return [
        Paragraph(
            "Footings stand on springs that press and never pull, settle for good where the soil carries no more, and "
            "slide where friction ends. Settlement is from the bridge as it was built, without any load."
        ),
        DataTable.of("settlements", "Foundations at the end of the run", columns, footings),
    ]
