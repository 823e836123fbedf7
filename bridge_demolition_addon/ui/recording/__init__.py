"""Sidebar of recording and running a simulation."""
