"""Concrete with bars: bending, shear, least areas, columns, moving loads, by EN 1992-1-1 and EN 1991-2."""
