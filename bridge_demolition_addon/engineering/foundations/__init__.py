"""Soil under footings."""
