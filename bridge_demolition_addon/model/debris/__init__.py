"""Where debris goes: throws, pile, footprint, zones and the exclusion zone."""
