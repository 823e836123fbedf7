"""Importing a bridge from an IFC file."""
