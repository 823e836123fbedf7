"""Sidebar of the scenario: bridge, fracture, ball and the rest."""
