"""Charges, and what other explosives are worth in TNT."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import BlastError
from .wave import Burst

SWISDAK = "air blast; Swisdak, NSWC/WOL/TR 75-116 (1975), as in TM 5-855-1 and UFC 3-340-02"
SWISDAK_PRESSURE = "air blast, pressure only; Swisdak, NSWC/WOL/TR 75-116 (1975), as in TM 5-855-1 and UFC 3-340-02"
BAKER = "heat of detonation over that of TNT, 4520 kJ/kg; Baker et al., Explosion Hazards and Evaluation (1983)"


@dataclass(frozen=True, slots=True)
class Explosive:
    """An explosive.

    Attributes
    ----------
    name
        What it is called.
    tnt_by_pressure, tnt_by_impulse
        Mass of TNT with the peak overpressure, and with the impulse, of a unit of mass. Where only one is known, or the
        heat of detonation, it stands for both.
    source
        What was measured, and who published it.
    """

    name: str
    tnt_by_pressure: float
    tnt_by_impulse: float
    source: str


EXPLOSIVES = {
    explosive.name: explosive
    for explosive in (
        Explosive("TNT", 1.0, 1.0, "the reference"),
        Explosive("ANFO", 0.82, 0.82, SWISDAK_PRESSURE),
        Explosive("C-4", 1.37, 1.19, SWISDAK),
        Explosive("Composition B", 1.11, 0.98, SWISDAK),
        Explosive("Pentolite", 1.42, 1.00, SWISDAK),
        Explosive("PETN", 1.27, 1.27, SWISDAK_PRESSURE),
        Explosive("RDX", 1.185, 1.185, BAKER),
        Explosive("HMX", 1.256, 1.256, BAKER),
        Explosive("Semtex", 1.250, 1.250, BAKER),
        Explosive("Nitroglycerin", 1.481, 1.481, BAKER),
        Explosive("Dynamite 60 %", 0.600, 0.600, BAKER),
    )
}
"""Explosives by name. One number stands for what varies by some 20 % with distance and confinement."""


def explosive_named(name: str) -> Explosive:
    """The explosive of a name, in capitals or not.

    Raises
    ------
    BlastError
        There is none of that name.
    """
    for known, explosive in EXPLOSIVES.items():
        if isinstance(name, str) and known.casefold() == name.strip().casefold():
            return explosive
    raise BlastError(f"explosive is {name!r}: expected one of {', '.join(EXPLOSIVES)}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Charge:
    """A bare charge. One of 0 kg does nothing.

    Attributes
    ----------
    name
        What it is called in logs.
    place_m
        Where it is: x, y, z in m.
    mass_kg
        Mass of the explosive itself, kg.
    explosive
        Name of the explosive.
    delay_s
        From the start of the blasting to its detonation, s.
    burst
        Whether it detonates in the air or on the ground.

    Raises
    ------
    BlastError
        Mass or delay is negative or not finite, the place is not one of three finite numbers, or explosive or burst is
        unknown.
    """

    name: str
    place_m: tuple[float, float, float]
    mass_kg: float
    explosive: str = "TNT"
    delay_s: float = 0.0
    burst: Burst = Burst.AIR

    def __post_init__(self) -> None:
        self._keep("mass_kg", _at_least_zero(self.mass_kg, f"{self.name}: mass", "kg"))
        self._keep("delay_s", _at_least_zero(self.delay_s, f"{self.name}: delay", "s"))
        self._keep("place_m", _place(self.place_m, self.name))
        try:
            self._keep("explosive", explosive_named(self.explosive).name)
            self._keep("burst", Burst(self.burst))
        except BlastError as error:
            raise BlastError(f"{self.name}: {error}") from error

    @property
    def tnt_kg(self) -> float:
        """Mass of TNT with the same impulse, kg: what moves bodies."""
        return self.mass_kg * EXPLOSIVES[self.explosive].tnt_by_impulse

    @property
    def tnt_for_pressure_kg(self) -> float:
        """Mass of TNT with the same peak overpressure, kg: what damage is told by."""
        return self.mass_kg * EXPLOSIVES[self.explosive].tnt_by_pressure

    def _keep(self, attribute: str, value: object) -> None:
        object.__setattr__(self, attribute, value)


@dataclass(frozen=True, eq=False, slots=True)
class ChargeArrays:
    """Several charges, structure of arrays.

    Attributes
    ----------
    places_m
        (c, 3) in m.
    tnt_kg, delays_s
        (c,) masses of TNT with the same impulse in kg, and delays in s.
    bursts
        (c,) where they detonate.
    """

    places_m: np.ndarray
    tnt_kg: np.ndarray
    delays_s: np.ndarray
    bursts: tuple[Burst, ...]

    @classmethod
    def of(cls, charges: Sequence[Charge]) -> "ChargeArrays":
        """The arrays of any number of charges."""
        return cls(
            np.array([charge.place_m for charge in charges], float).reshape(-1, 3),
            np.array([charge.tnt_kg for charge in charges], float),
            np.array([charge.delay_s for charge in charges], float),
            tuple(charge.burst for charge in charges),
        )


def _at_least_zero(value: float, name: str, unit: str) -> float:
    number = _number(value)
    if number is None or number < 0.0:
        raise BlastError(f"{name} is {value}: expected a finite number of at least 0 ({unit})")
    return number


def _place(values: Sequence[float], name: str) -> tuple[float, float, float]:
    numbers = [_number(value) for value in values] if np.iterable(values) else []
    if len(numbers) != 3 or None in numbers:
        raise BlastError(f"{name}: place is {values}: expected three finite numbers (m)")
    return tuple(numbers)


def _number(value: float) -> float | None:
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return number if np.isfinite(number) else None
