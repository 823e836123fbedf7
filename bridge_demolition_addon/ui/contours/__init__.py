"""Sidebar of contours, and what they draw in the viewport."""
