"""Command line: ``bda`` and ``python -m bridge_demolition_addon``."""
