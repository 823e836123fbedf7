"""Standard gravity, and units at the end of names."""

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard acceleration of free fall, exact; 1 kgf is the weight of 1 kg under it."""

_ENDINGS = {
    "m_kg13": "m/kg^(1/3)",
    "n_mm2": "N/mm²",
    "kg_m3": "kg/m³",
    "rad_s": "rad/s",
    "mm_s": "mm/s",
    "m_s2": "m/s²",
    "m_s": "m/s",
    "newton": "N",
    "kgf": "kgf",
    "degrees": "°",
    "deg": "°",
    "knm": "kN·m",
    "kn": "kN",
    "mpa": "MPa",
    "kpa": "kPa",
    "pa": "Pa",
    "ns": "N·s",
    "nm": "N·m",
    "mj": "MJ",
    "kj": "kJ",
    "hz": "Hz",
    "m2": "m²",
    "m3": "m³",
    "m4": "m⁴",
    "mm": "mm",
    "kg": "kg",
    "ms": "ms",
    "n": "N",
    "j": "J",
    "m": "m",
    "s": "s",
    "t": "t",
}
"""Units by the ends of names after a low line, longer ones before those that end like them."""


def name_and_unit(name: str) -> tuple[str, str]:
    """Return a name without its unit, and the unit; empty for texts and plain numbers."""
    for ending, unit in _ENDINGS.items():
        if name.lower().endswith(f"_{ending}"):
            return name[: -len(ending) - 1], unit
    return name, ""
