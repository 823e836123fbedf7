"""``bda charge``: the smallest charge for a wanted load, the effects of a charge around it, or of drill holes."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager

from ..engineering.arrays import FloatArray
from ..engineering.blast.charge_sizing import (
    smallest_charge_for_impulse,
    smallest_charge_for_overpressure,
    stand_off_for_overpressure,
)
from ..engineering.blast.pulses import blast_wave
from ..engineering.blast.vibration import (
    DAMAGE_LIMIT_M_S,
    GROUNDS,
    charge_per_delay,
    distance_for_velocity,
    peak_particle_velocity,
)
from ..engineering.blast.wave import scaled_distance
from ..errors import BlastError
from ..model.blast.blast_zones import DRILLED_EXPLOSIVES, DrilledExplosive
from ..model.blast.charges import EXPLOSIVES, Explosive, explosive_named
from ..model.blast.receptors import THRESHOLDS
from . import drilled_charge
from .arguments import add_blast_options, quantity
from .drilled_charge import drilled_explosive, zone_lines

VIBRATION_DISTANCES_M = (10.0, 20.0, 50.0, 100.0, 200.0)


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "charge",
        description="With --distance-m and a wanted load: the smallest charge that gives it there. "
        "With --mass-kg: how far the thresholds of damage reach, and how much the ground shakes. "
        "With --zone-m: what charges in drill holes do to a part of a member, see docs/drilled_charges.md.",
        allow_abbrev=False,
    )
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--distance-m", type=quantity, metavar="R", help="distance at which a load is wanted")
    task.add_argument("--mass-kg", type=quantity, metavar="W", help="mass of the charge")
    load = parser.add_mutually_exclusive_group()
    load.add_argument("--overpressure-kpa", type=quantity, metavar="P", help="wanted peak incident overpressure")
    load.add_argument("--impulse-kpa-ms", type=quantity, metavar="I", help="wanted incident impulse per area")
    names = ", ".join(EXPLOSIVES).replace("%", "%%")  # help texts are formats
    in_holes = ", ".join(DRILLED_EXPLOSIVES)
    help_text = f"one of {names} (TNT); with --zone-m one of {in_holes} (gelatine)"
    parser.add_argument("--explosive", type=_explosive, default=None, metavar="NAME", help=help_text)
    parser.add_argument("--ground", choices=list(GROUNDS), default="average", help="rock that shakes (average)")
    add_blast_options(parser)
    drilled_charge.add_to(parser, task)
    parser.set_defaults(execute=charge)


def charge(arguments: argparse.Namespace) -> None:
    """Print the charge for a wanted load, or the effects of a charge."""
    _check_together(arguments)
    if arguments.zone_m:
        lines = zone_lines(arguments, _explosive_in_holes(arguments.explosive))
    else:
        arguments.explosive = _explosive_in_the_open(arguments.explosive)
        lines = _effects(arguments) if arguments.mass_kg else _smallest_charge(arguments)
    for line in lines:
        print(line)


def _explosive(name: str) -> str:
    """Return a name of an explosive, for holes or the open."""
    if drilled_explosive(name) is None:
        try:
            explosive_named(name)
        except BlastError as error:
            raise argparse.ArgumentTypeError(
                f"{error}; with --zone-m one of {', '.join(DRILLED_EXPLOSIVES)}"
            ) from error
    return name


def _explosive_in_the_open(name: str | None) -> Explosive:
    try:
        return explosive_named(name or "TNT")
    except BlastError as error:
        raise BlastError(f"--explosive: {error}") from error


def _explosive_in_holes(name: str | None) -> DrilledExplosive:
    explosive = drilled_explosive(name or "gelatine")
    if explosive is None:
        raise BlastError(f"--explosive is {name}: expected one of {', '.join(DRILLED_EXPLOSIVES)} with --zone-m")
    return explosive


def _check_together(arguments: argparse.Namespace) -> None:
    loads = {"--overpressure-kpa": arguments.overpressure_kpa, "--impulse-kpa-ms": arguments.impulse_kpa_ms}
    wanted = {option: value for option, value in loads.items() if value}
    if arguments.distance_m and not wanted:
        raise BlastError(f"--distance-m is {arguments.distance_m:g}: expected one of {', '.join(loads)} with it")
    of_holes = [name for name in drilled_charge.OPTIONS if getattr(arguments, name)]
    if of_holes and not arguments.zone_m:
        raise BlastError(f"--{of_holes[0].replace('_', '-')} is given: expected --zone-m with it")
    if arguments.zone_m and not (arguments.specific_kg_m3 or arguments.charge_g):
        raise BlastError("--zone-m is given: expected --specific-kg-m3 or --charge-g with it")
    if arguments.bars and not arguments.bar_diameter_mm:
        raise BlastError(f"--bars is {arguments.bars}: expected --bar-diameter-mm with it")
    for option, value in wanted.items():
        if arguments.zone_m:
            raise BlastError(f"{option} is {value:g}: expected --distance-m with it, not --zone-m")
        if arguments.mass_kg:
            raise BlastError(f"{option} is {value:g}: expected --distance-m with it, not --mass-kg")


def _smallest_charge(arguments: argparse.Namespace) -> Iterator[str]:
    distance, explosive = arguments.distance_m, arguments.explosive
    tnt, worth, basis = _tnt_needed(arguments)
    wave = blast_wave(distance, tnt, arguments.burst, arguments.model)
    yield _fact("smallest charge", f"{_digits(tnt / worth)} kg of {explosive.name}")
    if worth != 1.0:
        yield _fact("in TNT", f"{_digits(tnt)} kg, {worth:g} times as much by {basis} ({explosive.source})")
    yield from _origin(arguments)
    yield ""
    yield f"At {distance:g} m, from that much TNT"
    yield _fact("scaled distance", f"{_digits(scaled_distance(distance, tnt))} m/kg^(1/3)")
    yield _fact("peak overpressure", f"{_digits(wave.peak_overpressure_pa / 1e3)} kPa")
    yield _fact("  on a wall, head-on", f"{_digits(wave.reflected_overpressure_pa / 1e3)} kPa")
    yield _fact("impulse", f"{_digits(wave.incident_impulse_pa_s)} kPa·ms")
    yield _fact("  on a wall, head-on", f"{_digits(wave.reflected_impulse_pa_s)} kPa·ms")
    yield _fact("arrival", f"{_digits(1e3 * wave.arrival_time_s)} ms")
    yield _fact("positive phase", f"{_digits(1e3 * wave.positive_phase_duration_s)} ms")


def _tnt_needed(arguments: argparse.Namespace) -> tuple[float, float, str]:
    """Return the TNT needed in kg, the TNT equivalent of the explosive, and whether by pressure or impulse."""
    explosive, position = arguments.explosive, (arguments.distance_m, arguments.burst, arguments.model)
    if wanted_kpa := arguments.overpressure_kpa:
        with _naming("--overpressure-kpa", wanted_kpa):
            return smallest_charge_for_overpressure(1e3 * wanted_kpa, *position), explosive.tnt_by_pressure, "pressure"
    with _naming("--impulse-kpa-ms", arguments.impulse_kpa_ms):
        wanted_pa_s = arguments.impulse_kpa_ms  # a kPa·ms is a Pa·s
        return smallest_charge_for_impulse(wanted_pa_s, *position), explosive.tnt_by_impulse, "impulse"


@contextmanager
def _naming(option: str, value: float) -> Iterator[None]:
    try:
        yield
    except BlastError as error:
        raise BlastError(f"{option} is {value:g}: {error}") from error


def _effects(arguments: argparse.Namespace) -> Iterator[str]:
    explosive = arguments.explosive
    tnt = arguments.mass_kg * explosive.tnt_by_pressure
    yield _fact("charge", f"{arguments.mass_kg:g} kg of {explosive.name}")
    if explosive.tnt_by_pressure != 1.0:
        yield _fact("in TNT", f"{_digits(tnt)} kg by pressure ({explosive.source})")
    yield from _origin(arguments)
    yield ""
    yield f"{'Damage':<46}{'kPa':>8}{'stand-off':>14}"
    for threshold in THRESHOLDS:
        reach = stand_off_for_overpressure(threshold.overpressure_pa, tnt, arguments.burst, arguments.model)
        yield f"  {threshold.damage:<44}{threshold.overpressure_pa / 1e3:>8g}{_digits(reach):>12} m"
    yield ""
    yield from _vibration(arguments)


def _vibration(arguments: argparse.Namespace) -> Iterator[str]:
    ground = GROUNDS[arguments.ground]
    limit = f"{1e3 * DAMAGE_LIMIT_M_S:g} mm/s"
    yield f"Ground vibration: {ground.name}, v = {1e3 * ground.velocity_m_s:g} mm/s (R/√Q)^-{ground.exponent:g}"
    yield f"  {'distance':<12}{'peak velocity':>16}{f'charge per delay for {limit}':>36}"
    for distance in VIBRATION_DISTANCES_M:
        velocity = 1e3 * peak_particle_velocity(distance, arguments.mass_kg, ground)
        allowed = charge_per_delay(distance, ground=ground)
        yield f"  {f'{distance:g} m':<12}{f'{_digits(velocity)} mm/s':>16}{f'{_digits(allowed)} kg':>36}"
    yield f"  {limit} is kept from {_digits(distance_for_velocity(arguments.mass_kg, ground=ground))} m on"


def _origin(arguments: argparse.Namespace) -> Iterator[str]:
    yield _fact("wave", f"{arguments.model}, {arguments.burst} burst")


def _fact(name: str, value: str) -> str:
    return f"{name:<24}{value}"


def _digits(value: float | FloatArray) -> str:
    """A number in four digits, without a power of ten where it can be."""
    return f"{float(f'{float(value):.4g}'):g}"
