"""Standard gravity."""

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard acceleration of free fall, exact; 1 kgf is the weight of 1 kg under it."""
