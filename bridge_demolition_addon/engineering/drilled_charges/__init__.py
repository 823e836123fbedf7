"""Charges in drill holes: specific charge, holes, bars that they bare, neighbours, and fragments that fly."""
