"""Ground that shakes: accelerograms, sweeps and records made from a spectrum, and where they move the ground to."""
