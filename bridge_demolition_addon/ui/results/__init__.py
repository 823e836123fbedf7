"""Sidebar of results and reports."""
