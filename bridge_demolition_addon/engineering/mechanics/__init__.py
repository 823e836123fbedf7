"""Forces, stress, sections, strength and impact: formulas on arrays."""
