"""Sidebar of contours, and their drawings in the viewport."""
