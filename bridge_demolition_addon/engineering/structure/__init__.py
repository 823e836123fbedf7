"""Connections between shards, and the sections of their faces."""
