"""Searches: the smallest charge, ball or drop that brings the bridge down as often as it has to."""
