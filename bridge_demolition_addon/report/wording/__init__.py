"""Wording of results: sentences that reports, the command line and the sidebar show, from typed numbers."""
