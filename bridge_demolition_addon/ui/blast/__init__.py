"""Sidebar of charges and explosions."""
