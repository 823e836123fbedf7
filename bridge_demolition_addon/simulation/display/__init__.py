"""Contours that follow the timeline, and films."""
