"""Steel: sections of bars, grades, and what bars resist by EN 1993-1-1."""
